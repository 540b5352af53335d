"""Seams: bonded interfaces in scenes without contact, tied by springs that never fail.

Where the interface names its stiffness these are Goodman's joint elements (Goodman, Taylor and
Brekke 1968) along the edges that two blocks share; where it names none they are glue. The springs
act at Gauss points of the shared edges, whatever the covers on either side.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from integration.segments import segment_rule
from nmm.assembly.model import Model
from nmm.assembly.motion import MaterialPoints, State, material_points
from nmm.contact.joints import Joints, find_joints
from nmm.contact.sides import sides
from nmm.effects.base import Effect, Instant, Setup
from nmm.errors import SceneError

# Springs of glue in E / length of the longest edge that elements share: it opens by 1e-4 of that
# length under a strain of one. At 1e6 the traction along a cut interface oscillates by 10 %, at
# 1e4 by 1 %.
GLUE = 1e4
# Degree of the work of the springs along a seam.
ORDER = 8


@dataclass(frozen=True)
class Ties:
    """Points of seams.

    Attributes
    ----------
    first, second
        The same m points on both sides.
    normal
        (m, 2) from the second to the first body, in the axes of the second.
    spring
        (m, 2) normal and shear stiffness (N/m).
    """

    first: MaterialPoints
    second: MaterialPoints
    normal: Floats
    spring: Floats


class Seams(Effect):
    """All seams of a scene under a formulation."""

    name = "seams"

    def __init__(self, ties: Ties, n_unknowns: int) -> None:
        self.ties = ties
        self._n = n_unknowns
        self._kept: tuple[Floats, csc_array] | None = None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Find the edges that blocks with a bonded interface share."""
        model = setup.model
        points = sides(model.manifold)
        found = find_joints(points.surface(setup.start.frames, setup.start.deformation))
        spring = _springs(setup, found)
        tied = spring[:, 0] > 0
        return cls(_ties(model, found.take(tied), spring[tied]), model.manifold.n_unknowns)

    def matrix(self, state: State) -> csc_array:
        """Return the springs' stiffness, the same object while no body turns."""
        if self._kept is None or not np.array_equal(self._kept[0], state.frames.angle):
            total = csc_array((self._n, self._n))
            for axis in (0, 1):
                rows = self._rows(state, axis)
                total = total + rows.T @ rows.multiply(self.ties.spring[:, [axis]])
            self._kept = state.frames.angle, csc_array(total)
        return self._kept[1]

    def force(self, state: State, end: Instant) -> Floats:
        """Return the springs' pull."""
        stretch = self.stretch(state)
        total = np.zeros(self._n)
        for axis in (0, 1):
            total -= self._rows(state, axis).T @ (self.ties.spring[:, axis] * stretch[:, axis])
        return total

    def energy(self, state: State) -> float:
        """Return the energy of the springs (J)."""
        return 0.5 * float(np.sum(self.ties.spring * self.stretch(state) ** 2))

    def stretch(self, state: State) -> Floats:
        """Opening and slip (m, 2) at the points (m)."""
        frames, ties = state.frames, self.ties
        apart = ties.first.place(frames, state.deformation)
        apart = apart - ties.second.place(frames, state.deformation)
        return np.stack(
            [np.einsum("mi,mi->m", apart, self._axis(state, k)) for k in (0, 1)], axis=1
        )

    def _axis(self, state: State, axis: int) -> Floats:
        normal = state.frames.to_global(self.ties.second.body, self.ties.normal)
        return normal if axis == 0 else np.stack([normal[:, 1], -normal[:, 0]], axis=1)

    def _rows(self, state: State, axis: int) -> csr_array:
        toward = self._axis(state, axis)
        one, two = self.ties.first, self.ties.second
        values = np.concatenate(
            [one.along(state.frames, toward), -two.along(state.frames, toward)], axis=1
        )
        columns = np.concatenate([one.rows.unknowns, two.rows.unknowns], axis=1)
        offsets = np.arange(len(values) + 1) * values.shape[1]
        return csr_array((values.ravel(), columns.ravel(), offsets), shape=(len(values), self._n))


def _springs(setup: Setup, joints: Joints) -> Floats:
    """Normal and shear stiffness (j, 2) in Pa/m; zero where bodies are not tied."""
    model = setup.model
    edges, region = model.manifold.boundary, model.manifold.element_region
    one, two = edges.element[joints.edge_a], edges.element[joints.edge_b]
    glue = (
        GLUE * np.minimum(model.modulus[one], model.modulus[two]) / joints.length.max(initial=0.0)
    )
    materials, found = list(setup.scene.materials), np.zeros((len(one), 2))
    first, second = setup.region_material[region[one]], setup.region_material[region[two]]
    for a, b in np.unique(np.stack([first, second], axis=1), axis=0):  # pairs of materials
        try:
            item = setup.scene.interface(materials[a], materials[b])
        except SceneError:
            continue
        chosen = (first == a) & (second == b)
        for axis, own in enumerate((item.normal_stiffness, item.shear_stiffness)):
            if item.bonded:
                found[chosen, axis] = glue[chosen] if own is None else own
    # Sub-blocks of one block are the formulation's to tie.
    found[region[one] == region[two]] = 0.0
    return found


def _ties(model: Model, joints: Joints, spring: Floats) -> Ties:
    edges = model.manifold.boundary
    points, weight = segment_rule(joints.start, joints.end, ORDER)
    q = weight.shape[1]
    flat = points.reshape(-1, 2)
    first = material_points(model.manifold, np.repeat(edges.element[joints.edge_a], q), flat)
    second = material_points(model.manifold, np.repeat(edges.element[joints.edge_b], q), flat)
    area = weight.ravel() * model.thickness
    return Ties(
        first,
        second,
        np.repeat(joints.normal, q, axis=0),
        area[:, None] * np.repeat(spring, q, axis=0),
    )
