"""Which parts of block edges carry a joint that broke or slides, found from the contact points."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons
from nmm.contact.problem.contact_state import ContactState
from nmm.results.frame import Frame, Topology


@dataclass(frozen=True)
class BrokenParts:
    """Parts of edges.

    Attributes
    ----------
    point
        (n,) point at which the edge starts.
    begin, end
        (n,) the part as fractions of the edge.
    """

    point: Ints
    begin: Floats
    end: Floats

    def on(self, polygons: Polygons) -> Floats:
        """(n, 2, 2) the parts as segments on polygons of the same topology."""
        start = polygons.points[self.point]
        edge = polygons.points[polygons.next_point[self.point]] - start
        return np.stack([start + self.begin[:, None] * edge, start + self.end[:, None] * edge], 1)

    def take(self, chosen: Bools) -> "BrokenParts":
        """Return the parts chosen by a mask."""
        return BrokenParts(self.point[chosen], self.begin[chosen], self.end[chosen])

    def joined(self, other: "BrokenParts") -> "BrokenParts":
        """Return the parts of both."""
        return BrokenParts(
            np.concatenate([self.point, other.point]),
            np.concatenate([self.begin, other.begin]),
            np.concatenate([self.end, other.end]),
        )

    def covered_by(self, other: "BrokenParts") -> Bools:
        """(n,) whether the middle of a part lies in a part of the same edge of the other."""
        middle = 0.5 * (self.begin + self.end)
        order = np.argsort(other.point, kind="stable")
        first = np.searchsorted(other.point[order], self.point, side="left")
        last = np.searchsorted(other.point[order], self.point, side="right")
        covered = np.zeros(len(middle), dtype=bool)
        for step in range(int((last - first).max(initial=0))):  # as many as points an edge has
            candidate = order[np.minimum(first + step, len(order) - 1)]
            inside = (other.begin[candidate] <= middle) & (middle <= other.end[candidate])
            covered |= (first + step < last) & inside
        return covered


def broken_parts(frames: Sequence[Frame], topology: Topology, frame: Frame) -> BrokenParts:
    """Return where joints are broken: bonded when the run began and not in this frame.

    Contact points that the frame itself calls broken are among them.
    """
    here = topology.elements.with_points(frame.points)
    marked = edge_parts(frame, here, ContactState.BROKEN)
    first = _first_with_bonds(frames)
    if first is None or first.topology != frame.topology:
        return marked
    bonded = edge_parts(first, topology.elements.with_points(first.points), ContactState.BONDED)
    intact = bonded.covered_by(edge_parts(frame, here, ContactState.BONDED))
    lost = bonded.take(~intact)
    return lost.joined(marked.take(~marked.covered_by(lost)))


def sliding_parts(topology: Topology, frame: Frame) -> BrokenParts:
    """Return where contacts slide in this frame."""
    here = topology.elements.with_points(frame.points)
    return edge_parts(frame, here, ContactState.SLIDE)


def _first_with_bonds(frames: Sequence[Frame]) -> Frame | None:
    """Return the first frame that has contact points, if any of them is bonded."""
    for frame in frames[:3]:  # a run may store its start before the first contact solution
        if len(frame.contact_state):
            return frame if ContactState.BONDED in frame.contact_state else None
    return None


def edge_parts(frame: Frame, polygons: Polygons, state: ContactState) -> BrokenParts:
    """Return the parts of edges on both sides of the contact points in a state.

    Parameters
    ----------
    frame
        The frame; its contact points lie on the edges, or a gap away from them.
    polygons
        The elements at the points of the frame.
    state
        State of the contact points that count.
    """
    import shapely

    contact = np.flatnonzero(frame.contact_state == state)
    start = polygons.points
    end = start[polygons.next_point]
    reach = 0.02 * frame.contact_length[contact] + 1.5 * np.abs(frame.contact_gap[contact])
    edges: Any = shapely.linestrings(np.stack([start, end], axis=1))
    found, edge = shapely.STRtree(edges).query(
        shapely.points(frame.contact_position[contact]), predicate="dwithin", distance=reach
    )
    contact = contact[found]
    along = end[edge] - start[edge]
    length = np.maximum(np.hypot(*along.T), 1e-300)
    from_start = frame.contact_position[contact] - start[edge]
    off_normal = np.abs(np.sum(along * frame.contact_normal[contact], axis=1)) / length
    foot = np.sum(from_start * along, axis=1) / length
    half = frame.contact_length[contact]
    parallel = (off_normal < 0.05) & (foot > -0.5 * half) & (foot < length + 0.5 * half)
    begin, finish = _part(foot, length, half)
    parts = BrokenParts(edge.astype(np.int64), begin / length, finish / length)
    return parts.take(parallel)


def _part(foot: Floats, length: Floats, tributary: Floats) -> tuple[Floats, Floats]:
    """Return from where to where on its edge a contact point speaks for the joint.

    A point in a corner speaks for its tributary length to the inside, one within the edge (Gauss
    points) for half of it to both sides.
    """
    at_end = (foot < 0.05 * tributary) | (foot > length - 0.05 * tributary)
    reach = np.where(at_end, tributary, 0.5 * tributary)
    return np.clip(foot - reach, 0.0, length), np.clip(foot + reach, 0.0, length)
