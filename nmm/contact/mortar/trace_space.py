"""How finely the fields of bodies can follow a pressure along their faces.

A body answers a pressure with the traces of its functions. Points of a face where those are too
much alike cannot be held one by one: forces on each of them have no unique values (Babuška 1973).
So *nodes* are chosen along every face, as on boundaries that cut a mesh (Béchet, Moës and
Wohlmuth 2009): corner by corner, each the first whose functions differ enough from those of the
node before. On meshes that fit the face these are those of the mesh.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.cutting.cut_boundary import CutBoundary
from integration.arrays import Bools, Floats, Ints
from nmm.assembly.material_points import material_points
from nmm.contact.detection.tolerances import ALIKE_COSINE, ALIKE_FINE, KINK
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.cracks.welded import WeldedVertices

# Places on an edge that may be nodes: fields that are smooth are most unlike between corners.
ALONG_EDGES = (0.0, 1 / 3, 2 / 3)
# What covers weigh at a corner, as a vector of length one.
Weights = dict[int, float]


@dataclass(frozen=True, eq=False)
class TraceSpace:
    """Faces of all bodies laid on one line, one after another, and the nodes chosen on them.

    Attributes
    ----------
    start, end
        (n,) where each boundary edge begins and ends on the line (m).
    face
        (n,) face of each edge.
    node
        (p,) chosen nodes, rising; among them both ends of every face.
    fine
        (q,) the same that are less unlike, for segments of faces with few of the others.
    softness
        (n,) one over Young's modulus at each edge (1/Pa).
    welded
        (n,) which edges begin or end where both faces of a crack are one.
    """

    start: Floats
    end: Floats
    face: Ints
    node: Floats
    fine: Floats
    softness: Floats
    welded: Bools

    @classmethod
    def of(
        cls, sides: Sides, edges: CutBoundary, modulus: Floats, welded: WeldedVertices | None
    ) -> TraceSpace:
        """Return the nodes on the boundary of a manifold; ``modulus`` (E,) is of its elements."""
        along = edges.end - edges.start
        length = np.hypot(*along.T)
        order, first = _faces(along, edges.next, edges.previous)
        face = np.empty(len(length), dtype=np.int64)
        face[order] = np.cumsum(first) - 1
        # Faces lie a mean edge apart.
        end = np.empty_like(length)
        end[order] = np.cumsum(length[order] + float(length.mean()) * first)
        start = end - length
        weights = [_weights(sides, part) for part in ALONG_EDGES]
        nodes: list[float] = []
        fine: list[float] = []
        for edge in np.split(order, np.flatnonzero(first)[1:]):  # faces, once a run
            there = [part[one] for one in edge for part in weights]
            there.append(weights[0][edges.next[edge[-1]]])
            on_line = start[edge, None] + length[edge, None] * np.array(ALONG_EDGES)
            on_line = np.append(on_line, end[edge[-1]])
            nodes.extend(on_line[_unlike(there, ALIKE_COSINE)].tolist())
            fine.extend(on_line[_unlike(there, ALIKE_FINE)].tolist())
        return cls(
            start,
            end,
            face,
            np.array(nodes),
            np.array(fine),
            1 / modulus[edges.element],
            np.zeros(len(edges), dtype=bool) if welded is None else welded.beside,
        )

    def on(self, edge: Ints, parameter: Floats) -> Floats:
        """Places (m,) of fractions of edges on the line."""
        return np.asarray(self.start[edge] + parameter * (self.end[edge] - self.start[edge]))


def _faces(along: Floats, after: Ints, before: Ints) -> tuple[Ints, Bools]:
    """Edges face by face, and which of them is the first of its face."""
    angle = np.arctan2(along[:, 1], along[:, 0])
    turn = np.abs((angle - angle[before] + np.pi) % (2 * np.pi) - np.pi)
    seen = np.zeros(len(along), dtype=bool)
    order, first = [], []
    # Rings without a corner begin anywhere.
    for head in [*np.flatnonzero(turn > KINK).tolist(), *range(len(along))]:  # edges, once a run
        edge = head
        while not seen[edge] and (edge == head or turn[edge] <= KINK):
            seen[edge] = True
            order.append(edge)
            first.append(edge == head)
            edge = int(after[edge])
    return np.array(order, dtype=np.int64), np.array(first, dtype=bool)


def _weights(sides: Sides, part: float) -> list[Weights]:
    """Weights of the covers at a ``part`` of every edge.

    All functions of a cover count together: near its middle they are alike.
    """
    edges = sides.manifold.boundary
    count = np.arange(len(edges))
    place = edges.at(count, np.full(len(edges), part))
    rows = material_points(sides.manifold, edges.element, place).rows
    cover = np.searchsorted(sides.manifold.cover_offset, rows.unknowns, side="right") - 1
    square = (rows.values**2).sum(axis=1)
    square /= square.sum(axis=1, keepdims=True)
    found = []
    for names, parts in zip(cover.tolist(), square.tolist(), strict=True):  # corners, once a run
        total: Weights = {}
        for name, part in zip(names, parts, strict=True):
            total[name] = total.get(name, 0.0) + part
        found.append({name: part**0.5 for name, part in total.items() if part > 0})
    return found


def _unlike(corners: list[Weights], alike: float) -> list[int]:
    """Corners of a face that are nodes: both ends, and those not ``alike`` the node before."""
    chosen = [0]
    for k in range(1, len(corners) - 1):  # corners, once a run
        if _cosine(corners[chosen[-1]], corners[k]) <= alike:
            chosen.append(k)
    if len(chosen) > 1 and _cosine(corners[chosen[-1]], corners[-1]) > alike:
        chosen.pop()
    return [*chosen, len(corners) - 1]


def _cosine(one: Weights, other: Weights) -> float:
    return sum(value * other.get(name, 0.0) for name, value in one.items())
