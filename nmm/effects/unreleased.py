"""Gradual release of the forces of excavated blocks.

A plane section at some distance behind the face of a tunnel is modelled by the share of the wall
forces that has been released (the convergence-confinement method: Panet and Guenot 1982). What the
blocks exerted is the residual once they are removed. It is balanced by forces at the faces that
they shared with the remaining ground, which decrease from stage to stage.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.places import on_edges
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.members.ends import elements_at
from nmm.effects.motion.reactions import Reactions
from nmm.errors import FormulationError

if TYPE_CHECKING:
    from nmm.effects.change import Change

# Largest share of the residual that forces on the faces may leave.
MISSED = 1e-3

CarriedLoad = tuple[Reactions, Ints, Floats, Floats]


class UnreleasedForces(Effect):
    """Forces at the faces of excavated blocks, by shares that stages change.

    Attributes
    ----------
    forces
        The full forces of the blocks.
    region
        (k,) input region of each point.
    first, last
        (k,) share that acts at load factors 0 and 1 of the stage.
    """

    name = "unreleased forces"
    stays = True

    def __init__(self, setup: Setup) -> None:
        self._setup = setup
        none = np.zeros(0)
        self._take(
            Reactions.none(setup.model.manifold.n_unknowns), none.astype(np.int64), none, none
        )

    @classmethod
    def beyond_strain(cls) -> bool:
        """See `Effect.beyond_strain`: it pushes faces that a support may hold."""
        return True

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Return no forces: nothing has been excavated yet."""
        return cls(setup)

    def _take(self, forces: Reactions, region: Ints, begin: Floats, goal: Floats) -> None:
        self.forces, self.region, self.first, self.last = forces, region, begin, goal
        self._points = forces.points(self._setup.model)

    def follow(self, change: "Change") -> "UnreleasedForces":
        """Return the forces on the new model, with the shares of the new stage.

        An event within a stage leaves the shares as they are.
        """
        new, known = UnreleasedForces(change.setup), self.forces
        elements = np.full(len(known), -1)
        for one in np.unique(self.region):  # blocks with exposed faces
            at = np.flatnonzero(self.region == one)
            there = np.arange(len(change.setup.region_name)) == one
            elements[at] = elements_at(change.setup, known.position[at], there)
        stay = elements >= 0
        moved = Reactions(
            elements[stay], known.position[stay], known.force[stay], new.forces.beside
        )
        begin, goal, released = self.first[stay], self.last[stay], _released(change.setup)
        if change.setup.acting is not change.before.acting:
            begin = goal
            # What is gone of blocks that left before stays gone as others leave.
            goal = begin if released is None else np.minimum(begin, 1.0 - released)
        new._take(moved, self.region[stay], begin, goal)
        return new

    def receive_residual(self, change: "Change", force: Floats) -> None:
        """See `Effect.receive_residual`: balance it by forces on the exposed faces."""
        released = _released(change.setup)
        if released is None:
            return
        old, new = change.old.manifold, change.new.manifold
        left = np.setdiff1d(old.element_region, new.element_region)
        bare = np.isin(old.element_region[old.boundary.element], left)
        place = on_edges(old, bare, 2 * max(new.degree, 1))
        elements = elements_at(change.setup, place.position)
        on = elements >= 0
        found = Reactions(
            elements[on], place.position[on], np.zeros((int(on.sum()), 2)), self.forces.beside
        )
        if not len(found):
            return
        full = _balancing(change, found, place.weight[on], -force)
        whole = Reactions.sum(
            [self.forces, Reactions(found.elements, found.position, full, found.beside)],
            new.n_unknowns,
        )
        more = np.ones(len(found))
        self._take(
            whole,
            np.concatenate([self.region, new.element_region[found.elements]]),
            np.concatenate([self.first, more]),
            np.concatenate([self.last, (1.0 - released) * more]),
        )

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force (n,) of the shares that still act."""
        return self._points.push(state, self._share(end.load_factor) * self.forces.force)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean of the forces at both ends of the step."""
        mean = (self._share(before.load_factor) + self._share(after.load_factor)) / 2
        return self._points.work(before, after, mean * self.forces.force)

    def history(self, state: State) -> Mapping[str, float]:
        """Return the largest share that still acts."""
        share = self._share(state.load_factor)
        return {"share": float(share.max(initial=0.0))}

    def carried(self) -> CarriedLoad:
        return self.forces, self.region, self.first, self.last

    def carry(self, carried: CarriedLoad) -> None:
        self._take(*carried)

    def _share(self, load_factor: float) -> Floats:
        share = self.first + (self.last - self.first) * load_factor
        return np.asarray(share[:, None])


def _released(setup: Setup) -> float | None:
    return None if setup.acting is None else setup.acting.released


def _balancing(change: "Change", at: Reactions, weight: Floats, force: Floats) -> Floats:
    """Return the forces (k, 2) (N) at points that balance ``force`` (n,) on the unknowns.

    Of all such forces the tractions have the least square mean over the faces; ``weight`` (k,) are
    the lengths of the points.

    Raises
    ------
    FormulationError
        No forces on the faces balance it.
    """
    # Imported here, as few stages need it.
    from scipy import linalg

    points, frames = at.points(change.new), change.state.frames
    root = np.repeat(np.sqrt(weight), 2)
    turned = frames.to_body(np.repeat(points.body, 2), np.tile(np.eye(2), (len(at), 1)))
    # Both directions at each point, in the axes of its body.
    local = points.rows.matrix(len(force)).toarray().reshape(len(at), 2, -1)
    every = np.einsum("mij,mjn->min", turned.reshape(-1, 2, 2), local).reshape(2 * len(at), -1)
    touched: Bools = (every != 0).any(axis=0)
    matrix = (root[:, None] * every[:, touched]).T
    found = linalg.lstsq(matrix, force[touched], lapack_driver="gelsy", cond=1e-10)[0]
    missed = np.linalg.norm(matrix @ found - force[touched])
    if missed > MISSED * np.linalg.norm(force[touched]):
        raise FormulationError(
            "[[stages]] release: forces at the faces that blocks left miss "
            f"{missed / np.linalg.norm(force[touched]):.1e} of what is out of balance: expected at "
            f"most {MISSED:.0e}: name bonded interfaces or contact, hold blocks at these faces by "
            'nothing else, and bond them by springs ([glue] method, [contact] bonds = "spring")'
        )
    return np.asarray((root * found).reshape(-1, 2))
