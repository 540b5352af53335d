"""Joints that carry water: their nodes, openings, and the forces of pressure on their faces."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from integration.arrays import Floats, Ints
from nmm.assembly.material_points import MaterialPoints, material_points
from nmm.assembly.model import Model
from nmm.assembly.state import State, rotation_matrices
from nmm.constraints.interface import Interface
from nmm.constraints.ties.shared_edges import gauss_interface
from nmm.contact.detection.joints import Joints

# Ends of joints nearer to each other than this share of the size of the domain are one node.
NEAR = 1e-9


@dataclass(frozen=True)
class WetJoints:
    """Joints that carry water.

    Attributes
    ----------
    joints
        Edges that blocks share, in the reference configuration.
    nodes, places
        (j, 2) nodes of their ends, and places (n, 2) of the nodes (m).
    sides
        The ends (2 j) on either side as material points, both ends of a joint one after the other.
    interface
        Gauss points of the joints.
    share
        (m,) place of each Gauss point along its joint, from 0 to 1.
    corner
        (P,) node at each vertex of the elements; -1 for none.
    """

    joints: Joints
    nodes: Ints
    places: Floats
    sides: tuple[MaterialPoints, MaterialPoints]
    interface: Interface
    share: Floats
    corner: Ints

    @classmethod
    def of(cls, model: Model, joints: Joints) -> Self:
        """Return the joints of a model with their points."""
        manifold = model.manifold
        ends = np.stack([joints.start, joints.end], axis=1).reshape(-1, 2)
        size = manifold.elements.extent
        nodes, places = _merged(ends, NEAR * size)
        a, b = (
            material_points(manifold, np.repeat(manifold.boundary.element[edge], 2), ends)
            for edge in (joints.edge_a, joints.edge_b)
        )
        interface = gauss_interface(model, joints, manifold.degree + 2)
        piece = interface.first.piece
        assert piece is not None
        away = interface.first.position - joints.start[piece]
        share = np.hypot(*away.T) / joints.length[piece]
        corner = _at(places, manifold.elements.points, NEAR * size)
        return cls(joints, nodes.reshape(-1, 2), places, (a, b), interface, share, corner)

    def opening(self, state: State) -> Floats:
        """Opening (j, 2) of the joints at their ends since the reference configuration (m)."""
        one, other = (side.moved(state.frames, state.deformation) for side in self.sides)
        normal = np.repeat(self.joints.normal, 2, axis=0)
        angle = np.mean([state.frames.angle[side.body] for side in self.sides], axis=0)
        turned = np.einsum("mij,mj->mi", rotation_matrices(angle), normal)
        return np.asarray(np.sum((one - other) * turned, axis=1).reshape(-1, 2))

    def forces(self, state: State, pressure: Floats) -> Floats:
        """Forces (m, 2) (N) on the first side of pressures (j, 2) at the ends (Pa)."""
        piece = self.interface.first.piece
        assert piece is not None
        low, high = pressure[piece].T
        there = low + self.share * (high - low)
        size = there * self.interface.area
        return np.asarray(-size[:, None] * self.interface.normal(state))


def _merged(points: Floats, near: float) -> tuple[Ints, Floats]:
    """Number (m,) of each point among distinct ones, and the places (n, 2) of these."""
    from scipy.spatial import KDTree

    pairs = KDTree(points).query_pairs(near, output_type="ndarray")
    graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(points), len(points)))
    number = connected_components(graph, directed=False)[1].astype(np.int64)
    return number, points[np.unique(number, return_index=True)[1]]


def _at(places: Floats, points: Floats, near: float) -> Ints:
    """Number (m,) of the place at each point; -1 for none."""
    from scipy.spatial import KDTree

    away, nearest = KDTree(places).query(points)
    return np.where(away <= near, nearest, -1)
