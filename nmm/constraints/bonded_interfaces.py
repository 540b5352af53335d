"""Seams: bonded interfaces in scenes without contact, tied for good.

Where the interface names its stiffness these are Goodman's joint elements (Goodman, Taylor and
Brekke 1968) along the edges that two blocks share. Where it names none they are glue, and the
formulation's ``[glue]`` says how it holds: by springs, by Nitsche's method or by multipliers. All
act at Gauss points of the shared edges, whatever the covers on either side.
"""

from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Bools, Floats
from nmm.assembly.motion import State
from nmm.constraints.multiplier_ties import MultiplierGlue
from nmm.constraints.tied_interfaces import glue, glue_stiffness, shared_edges, springs
from nmm.constraints.ties import Tie
from nmm.contact.detection.joints import Joints
from nmm.effects.base import Effect, Instant, Setup
from nmm.errors import SceneError


class Seams(Effect):
    """All seams of a scene under a formulation."""

    name = "seams"
    external = False

    def __init__(
        self, ties: list[Tie], n_unknowns: int, glue: MultiplierGlue | None = None
    ) -> None:
        self.ties = ties
        self.glue = glue
        self._n = n_unknowns
        self._kept: tuple[Floats, csc_array] | None = None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Find the edges that blocks with a bonded interface share."""
        model, method = setup.model, setup.formulation.glue
        joints = shared_edges(model)
        spring, glued = _interfaces(setup, joints)
        sprung = spring[:, 0] > 0
        ties: list[Tie] = []
        if sprung.any():
            ties.append(springs(model, joints.take(sprung), spring[sprung]))
        cover = setup.formulation.cover
        held = None
        if glued.any():
            size = None if cover.of_blocks else cover.finest
            more, held = glue(model, joints.take(glued), method, size)
            ties += more
        return cls(ties, model.manifold.n_unknowns, held)

    @property
    def about(self) -> str:
        """See `Effect.about`."""
        said = [tie.about for tie in self.ties]
        if self.glue is not None:
            said.append(f"{self.glue.basis.shape[1]} Lagrange multipliers")
        return ", ".join(said) if said else "no shared edges"

    def matrix(self, state: State) -> csc_array:
        """Return the stiffness of the ties, the same object while no body turns."""
        if self._kept is None or not np.array_equal(self._kept[0], state.frames.angle):
            total = csc_array((self._n, self._n))
            for tie in self.ties:  # at most two
                total = total + tie.matrix(state, self._n)
            self._kept = state.frames.angle, csc_array(total)
        return self._kept[1]

    def force(self, state: State, end: Instant) -> Floats:
        """Return the pull of the ties."""
        total = np.zeros(self._n)
        for tie in self.ties:  # at most two
            total += tie.force(state, self._n)
        return total

    def energy(self, state: State) -> float:
        """Return the energy of the ties (J)."""
        return sum(tie.energy(state) for tie in self.ties)

    def gap_volume(self, state: State, k: int) -> Floats:
        """See `Effect.gap_volume`."""
        return sum((tie.gap_volume(state, k) for tie in self.ties), start=np.zeros(k))

    def border(self, state: State, end: Instant) -> tuple[csr_array, Floats] | None:
        """Conditions that multipliers hold; None without multipliers."""
        return None if self.glue is None else self.glue.border(state, self._n)

    def keep(self, multipliers: Floats) -> Floats:
        """See `Effect.keep`."""
        if self.glue is None:
            return multipliers
        size = self.glue.basis.shape[1]
        self.glue.found["traction"] = multipliers[:size]
        return multipliers[size:]

    def carried(self) -> dict[str, Floats]:
        """See `Effect.carried`: the multipliers of the last solution."""
        return {} if self.glue is None else dict(self.glue.found)

    def carry(self, carried: dict[str, Floats]) -> None:
        """See `Effect.carry`."""
        if self.glue is not None:
            self.glue.found.update(carried)

    def forget(self) -> None:
        """See `Effect.forget`."""
        self._kept = None


def _interfaces(setup: Setup, joints: Joints) -> tuple[Floats, Bools]:
    """Stiffness (j, 2) in Pa/m of joints that name one, zero elsewhere, and which are glued."""
    edges, region = setup.model.manifold.boundary, setup.model.manifold.element_region
    one, two = edges.element[joints.edge_a], edges.element[joints.edge_b]
    materials, found = list(setup.scene.materials), np.zeros((len(one), 2))
    glued = np.zeros(len(one), dtype=bool)
    first, second = setup.region_material[region[one]], setup.region_material[region[two]]
    glue = glue_stiffness(setup.model, joints, setup.formulation.glue)
    for a, b in np.unique(np.stack([first, second], axis=1), axis=0):  # pairs of materials
        try:
            item = setup.scene.interface(materials[a], materials[b])
        except SceneError:
            continue
        # Sub-blocks of one block are the formulation's to tie.
        chosen = (first == a) & (second == b) & (region[one] != region[two]) & item.bonded
        own = (item.normal_stiffness, item.shear_stiffness)
        if own == (None, None):
            glued |= chosen
            continue
        for axis in (0, 1):
            found[chosen, axis] = glue[chosen, axis] if own[axis] is None else own[axis]
    return found, glued
