"""Seams: bonded interfaces in scenes without contact, tied for good.

Where the interface names its stiffness these are Goodman's joint elements (Goodman, Taylor and
Brekke 1968) along the edges that two blocks share. Where it names none they are glue, and the
formulation's ``[glue]`` says how it holds: by springs, by Nitsche's method or by multipliers. All
act at Gauss points of the shared edges, whatever the covers on either side.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Bools, Floats, Ints
from integration.segments import segment_rule
from nmm.assembly.model import Model
from nmm.assembly.motion import State, initial_state, material_points
from nmm.contact.joints import Joints, find_joints
from nmm.contact.sides import sides
from nmm.effects.averages import averages
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.multiplier_space import Pieces, multipliers
from nmm.effects.multiplier_ties import MultiplierGlue, independent
from nmm.effects.ties import Pairs, Springs, Tie
from nmm.errors import FormulationError, SceneError

if TYPE_CHECKING:
    from nmm.formulation import Glue

# Springs of glue in E / length of the longest edge that elements share: it opens by 1e-4 of that
# length under a strain of one. At 1e6 the traction along a cut interface oscillates by 10 %, at
# 1e4 by 1 %.
GLUE = 1e4
# Least degree of the work along a seam that is integrated exactly.
ORDER = 8


class Seams(Effect):
    """All seams of a scene under a formulation."""

    name = "seams"

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
            ties.append(_springs(model, joints.take(sprung), spring[sprung]))
        cover = setup.formulation.cover
        held = None
        if glued.any():
            size = None if cover.of_blocks else cover.finest
            more, held = glue(model, joints.take(glued), method, size)
            ties += more
        return cls(ties, model.manifold.n_unknowns, held)

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


def shared_edges(model: Model) -> Joints:
    """Return the edges that bodies share in the reference place."""
    start = initial_state(model.manifold)
    return find_joints(sides(model.manifold).surface(start.frames, start.deformation))


def glue(
    model: Model, joints: Joints, method: "Glue", size: float | None
) -> tuple[list[Tie], MultiplierGlue | None]:
    """Return what holds edges together; ``size`` is that of a mesh's cells, None for blocks (m)."""
    if method.method == "spring":
        return [_springs(model, joints, _stiffness(model, joints, method))], None
    if method.method == "lagrange":
        return [], _multipliers(model, joints, size)
    return _averages(model, joints, method), None


def pairs_of(model: Model, joints: Joints, order: int = ORDER) -> tuple[Pairs, Ints, Ints, Ints]:
    """Gauss points of joints, the elements on both sides and the joint of each point."""
    edges = model.manifold.boundary
    points, weight = segment_rule(joints.start, joints.end, order)
    q = weight.shape[1]
    flat = points.reshape(-1, 2)
    one = np.repeat(edges.element[joints.edge_a], q)
    two = np.repeat(edges.element[joints.edge_b], q)
    first = material_points(model.manifold, one, flat)
    second = material_points(model.manifold, two, flat)
    pairs = Pairs(
        first,
        second,
        np.repeat(joints.normal, q, axis=0),
        weight.ravel() * model.thickness,
    )
    return pairs, one, two, np.repeat(np.arange(len(joints)), q)


def _springs(model: Model, joints: Joints, spring: Floats) -> Springs:
    pairs, _, _, joint = pairs_of(model, joints)
    return Springs(pairs, spring[joint])


def _averages(model: Model, joints: Joints, method: "Glue") -> list[Tie]:
    """Nitsche's terms, and springs where neither side has stress."""
    order = max(ORDER, 2 * degree_of(model) + 2)
    pairs, one, two, joint = pairs_of(model, joints, order)
    found, free = averages(model, pairs, (one, two), method.gamma)
    if not free.any():
        return [found]
    if method.method == "nitsche":
        x, y = joints.start[joint[free][0]]
        raise FormulationError(
            f'[glue] method: "nitsche": at [{x:.6g}, {y:.6g}] neither side has functions with '
            'strain: expected one: use method = "spring"'
        )
    spring = np.where(free[:, None], _stiffness(model, joints, method)[joint], 0.0)
    return [found, Springs(pairs, spring)]


def _multipliers(model: Model, joints: Joints, size: float | None) -> MultiplierGlue:
    degree = degree_of(model)
    pairs, _, _, joint = pairs_of(model, joints, max(ORDER, 2 * degree + 2))
    body = model.manifold.boundary.body
    a, b = body[joints.edge_a], body[joints.edge_b]
    turned = (a > b)[:, None]
    pieces = Pieces(
        np.where(turned, joints.end, joints.start),
        np.where(turned, joints.start, joints.end),
        np.minimum(a, b) * model.manifold.n_bodies + np.maximum(a, b),
        joint,
        model.manifold.body_centroid[pairs.first.body] + pairs.first.arm,
        pairs.normal,
        pairs.weight,
    )
    # A block is one cell: each of its joints has multipliers of its own.
    cell = float(joints.length.sum()) if size is None else size
    basis = multipliers(pieces, cell, max(degree - 1, 0), np.ones(2, dtype=bool))
    found = MultiplierGlue(pairs, basis)
    rows, _ = found.border(initial_state(model.manifold), model.manifold.n_unknowns)
    return replace(found, basis=csr_array(basis[:, independent(rows, model.stiffness.diagonal())]))


def degree_of(model: Model) -> int:
    """Degree of the displacements, as far as it is known."""
    found = [getattr(group, "degree", 2) for group in model.manifold.groups]
    return max(found, default=1)


def _stiffness(model: Model, joints: Joints, method: "Glue") -> Floats:
    """Springs (j, 2) of glue in Pa/m."""
    element = model.manifold.boundary.element
    one, two = (model.modulus[element[edge]] for edge in (joints.edge_a, joints.edge_b))
    factor = GLUE if method.stiffness is None else method.stiffness
    found = factor * np.minimum(one, two) / joints.length.max(initial=0.0)
    return np.repeat(found[:, None], 2, axis=1)


def _interfaces(setup: Setup, joints: Joints) -> tuple[Floats, Bools]:
    """Stiffness (j, 2) in Pa/m of joints that name one, zero elsewhere, and which are glued."""
    edges, region = setup.model.manifold.boundary, setup.model.manifold.element_region
    one, two = edges.element[joints.edge_a], edges.element[joints.edge_b]
    materials, found = list(setup.scene.materials), np.zeros((len(one), 2))
    glued = np.zeros(len(one), dtype=bool)
    first, second = setup.region_material[region[one]], setup.region_material[region[two]]
    glue = _stiffness(setup.model, joints, setup.formulation.glue)
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
