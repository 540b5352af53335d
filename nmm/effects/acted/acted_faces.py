"""Faces on which a scene lets loads, pressures or supports act.

Beside them the traction of a body is not the one that it hands on to its neighbour: of the face
``i`` of a bond, ``sigma_i n_i = t_i + lambda_i`` with the traction ``t_i`` that is applied there.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.ragged import within
from nmm.assembly.model import Model
from nmm.effects.acted.acted_ends import member_edge_parts
from nmm.effects.acted.acted_parts import acted_edge_parts, acting_tables
from nmm.effects.base import Setup
from nmm.geometry.places import EdgeParts

# Share of a joint up to which something that begins at its end reaches into it by rounding.
REACHES = 1e-6


Sides = tuple[EdgeParts, EdgeParts]
"""Joints (j,) as parts of an edge on either side."""


@dataclass(frozen=True)
class ActedFaces:
    """Parts of edges on which something acts.

    Attributes
    ----------
    parts
        Those of all tables, in the order of their edges.
    table
        (k,) which table acts there.
    names
        Of the tables.
    holds
        (t,) whether a table holds faces, in place of loading them.
    origin
        (2,) of the axes of the parts in those of the scene (m).
    """

    parts: EdgeParts
    table: Ints
    names: tuple[str, ...]
    holds: Bools
    origin: Floats

    @classmethod
    def of(cls, setup: Setup) -> Self:
        """Find them for a scene: parts of edges, and points on edges of a single body.

        What acts at a point on several bodies acts in equal shares, as the mean of their stress is.
        """
        found = [
            (table.name, acted_edge_parts(setup, table), holds)
            for table, holds in acting_tables(setup)
        ]
        found += [(name, parts, False) for name, parts in member_edge_parts(setup)]
        pieces = [parts for _, parts, _ in found]
        counts = [len(one.edge) for one in pieces]
        none = EdgeParts(np.zeros(0, dtype=np.int64), np.zeros((0, 2)), np.zeros((0, 2)))
        edge, start, end = (
            np.concatenate([getattr(one, name) for one in (none, *pieces)])
            for name in ("edge", "start", "end")
        )
        order = np.argsort(edge, kind="stable")
        number = np.repeat(np.arange(len(found)), counts)[order]
        names = tuple(name for name, _, _ in found)
        holds = np.array([holding for _, _, holding in found], dtype=bool)
        parts = EdgeParts(edge[order], start[order], end[order])
        return cls(parts, number, names, holds, setup.origin)

    def beside(self, joints: Sides) -> tuple[Bools, Bools] | None:
        """Return on which sides (j,) of joints something acts; None where nothing does."""
        one, two = (self._on(side) for side in joints)
        return (one, two) if one.any() or two.any() else None

    def twice(self, joints: Sides) -> str:
        """Name the first joint on both faces of which something acts, not supports alone.

        With what acts there, in words; empty without any.
        """
        one, two = (self._on(side) for side in joints)
        loaded = self._on(joints[0], ~self.holds) | self._on(joints[1], ~self.holds)
        found = np.flatnonzero(one & two & loaded)
        if not len(found):
            return ""
        first = [EdgeParts(s.edge[found[:1]], s.start[found[:1]], s.end[found[:1]]) for s in joints]
        tables = np.concatenate([self.table[self._pairs(side)[1]] for side in first])
        names = ", ".join(f'"{self.names[one]}"' for one in np.unique(tables))
        x, y = ((first[0].start + first[0].end) / 2)[0] + self.origin
        more = f" and {len(found) - 1} more" if len(found) > 1 else ""
        return f"{names} on both faces at ({x:.6g}, {y:.6g}){more}"

    def _on(self, joints: EdgeParts, chosen: Bools | None = None) -> Bools:
        """Return on which joints (j,), by the edge of one side, tables that are ``chosen`` act."""
        joint, part = self._pairs(joints)
        if chosen is not None:
            joint = joint[chosen[self.table[part]]]
        return np.bincount(joint, minlength=len(joints.edge)) > 0

    def _pairs(self, joints: EdgeParts) -> tuple[Ints, Ints]:
        """Pairs (p,) of joints and parts of their edge that overlap."""
        parts = self.parts
        first = np.searchsorted(parts.edge, joints.edge, side="left")
        counts = np.searchsorted(parts.edge, joints.edge, side="right") - first
        joint = np.repeat(np.arange(len(counts)), counts)
        part = first[joint] + within(counts)
        begin, way = joints.start[joint], (joints.end - joints.start)[joint]
        size = np.sum(way * way, axis=1)
        shares = [
            np.sum((at[part] - begin) * way, axis=1) / np.where(size > 0, size, 1.0)
            for at in (parts.start, parts.end)
        ]
        low, high = np.minimum(*shares), np.maximum(*shares)
        overlap = np.minimum(high, 1.0) - np.maximum(low, 0.0)
        meet = np.where(high > low, overlap > REACHES, overlap > -REACHES)
        return joint[meet], part[meet]


def shared_edge_parts(model: Model, edge_a: Ints, edge_b: Ints) -> Sides:
    """Return the parts (j,) of edges that pairs of them share, on either side."""
    edges = model.manifold.boundary
    begin, way = edges.start[edge_a], edges.end[edge_a] - edges.start[edge_a]
    size = np.sum(way * way, axis=1)
    shares = [np.sum((at[edge_b] - begin) * way, axis=1) / size for at in (edges.start, edges.end)]
    low, high = np.clip([np.minimum(*shares), np.maximum(*shares)], 0.0, 1.0)[:, :, None]
    start, end = begin + low * way, begin + high * way
    return EdgeParts(edge_a, start, end), EdgeParts(edge_b, start, end)


def wet_faces(setup: Setup) -> str:
    """Tell bonds in which ``[joint_flow]`` presses on both faces, in words; empty without any."""
    if setup.scene.joint_flow is None:
        return ""
    bonds = (one for one in setup.scene.interfaces.values() if one.bonded)
    if not any(one.aperture is not None and one.normal_stiffness is None for one in bonds):
        return ""
    return "the water of [joint_flow] on both faces"


def mean_taken(found: str, held: str, remedy: str, harm: str = "faces part") -> str:
    """Tell that terms take the mean of both sides where loads are ``found`` on both faces."""
    return (
        f"{found} of {held}, which take the mean stress of both sides for the traction: {harm} by "
        f"the loads on them over twice the penalty; use {remedy}"
    )
