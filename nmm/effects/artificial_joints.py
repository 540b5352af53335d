"""Artificial joints (Ke 1996): springs that hold the sub-blocks of a block together for good.

The forces are read from the whole opening and sliding of each joint as it stands, so that nothing
drifts over steps; there is no state and nothing to iterate.
"""

from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from integration.polygons import centroids
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.contact.joints import JointPoints, find_joints, joint_points
from nmm.contact.sides import sides, tangents
from nmm.effects.base import Effect, Instant, Setup
from nmm.geometry.sub_blocks import SubBlocks


class ArtificialJoints(Effect):
    """Bonds between all sub-blocks of one block, alike in normal and tangential direction."""

    name = "artificial joints"

    def __init__(self, model: Model, stiffness: float, stations: str, start: State) -> None:
        """Find the joints; ``stiffness`` in Young's moduli over the distance of the middles."""
        manifold = model.manifold
        self._n = manifold.n_unknowns
        self._sides = sides(manifold)
        surface = self._sides.surface(start.frames, start.deformation)
        joints = find_joints(surface)
        element = manifold.boundary.element
        region = manifold.element_region[element]
        joints = joints.take(region[joints.edge_a] == region[joints.edge_b])
        self._points: JointPoints = joint_points(surface, joints, stations)
        a, b = element[joints.edge_a], element[joints.edge_b]
        middle = centroids(manifold.elements)
        apart = np.abs(np.einsum("ij,ij->i", middle[a] - middle[b], joints.normal))
        spring = stiffness * model.thickness * np.sqrt(model.modulus[a] * model.modulus[b]) / apart
        self._spring = spring[self._points.joint] * self._points.length
        self._stood: tuple[Floats, csr_array, csc_array] | None = None  # at angles

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the options of the cover."""
        formulation = setup.formulation
        stiffness = SubBlocks.of(formulation.cover).stiffness
        return cls(setup.model, stiffness, formulation.contact.joint_points, setup.start)

    def matrix(self, state: State) -> csc_array:
        """Stiffness of the joints, the same object as long as nothing turns."""
        return self._now(state)[1]

    def force(self, state: State, end: Instant) -> Floats:
        """Forces of the joints as they stand."""
        pull = np.tile(self._spring, 2) * self._stretch(state)
        return np.asarray(-(self._now(state)[0].T @ pull))

    def energy(self, state: State) -> float:
        """Energy stored in the joints (J)."""
        return 0.5 * float(np.tile(self._spring, 2) @ self._stretch(state) ** 2)

    def _stretch(self, state: State) -> Floats:
        """Openings, then slidings (2m,) in m."""
        p = self._points
        a = self._sides.at(p.edge_a, p.parameter_a).place(state.frames, state.deformation)
        b = self._sides.at(p.edge_b, p.parameter_b).place(state.frames, state.deformation)
        return np.concatenate([np.sum((a - b) * n, axis=1) for n in self._directions(state)])

    def _directions(self, state: State) -> tuple[Floats, Floats]:
        normal = state.frames.rotation[self._sides.manifold.boundary.body[self._points.edge_b]]
        turned = np.einsum("mij,mj->mi", normal, self._points.normal)
        return turned, tangents(turned)

    def _now(self, state: State) -> tuple[csr_array, csc_array]:
        """Rows (2m, n) of openings and slidings, and the stiffness."""
        angle = state.frames.angle
        if self._stood is None or not np.array_equal(self._stood[0], angle):
            p = self._points
            a = self._sides.at(p.edge_a, p.parameter_a)
            b = self._sides.at(p.edge_b, p.parameter_b)
            columns = np.concatenate([a.rows.unknowns, b.rows.unknowns], axis=1)
            values = np.concatenate(
                [
                    np.concatenate([a.along(state.frames, n), -b.along(state.frames, n)], axis=1)
                    for n in self._directions(state)
                ]
            )
            columns = np.tile(columns, (2, 1))
            offsets = np.arange(len(columns) + 1) * columns.shape[1]
            rows = csr_array((values.ravel(), columns.ravel(), offsets), (len(columns), self._n))
            heavy = csr_array(
                ((np.tile(self._spring, 2)[:, None] * values).ravel(), columns.ravel(), offsets),
                (len(columns), self._n),
            )
            self._stood = angle.copy(), rows, csc_array(rows.T @ heavy)
        return self._stood[1], self._stood[2]
