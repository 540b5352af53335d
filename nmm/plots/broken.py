"""Which parts of block edges carry a joint that broke or slides, found from the contact points."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.results.frame import ContactState, Frame

MARKED = {ContactState.BROKEN: "broken", ContactState.SLIDE: "sliding"}


@dataclass(frozen=True)
class MarkedEdges:
    """Parts of edges.

    Attributes
    ----------
    point
        (n,) point at which the edge starts.
    begin, end
        (n,) the part as fractions of the edge.
    state
        (n,) `ContactState` of the contact point that marks it.
    """

    point: Ints
    begin: Floats
    end: Floats
    state: Ints

    def on(self, polygons: Polygons) -> Floats:
        """(n, 2, 2) the parts as segments on polygons of the same topology."""
        start = polygons.points[self.point]
        edge = polygons.points[polygons.next_point[self.point]] - start
        return np.stack([start + self.begin[:, None] * edge, start + self.end[:, None] * edge], 1)


def marked_edges(frame: Frame, polygons: Polygons) -> MarkedEdges:
    """Return the parts of edges on both sides of contacts that are broken or slide.

    Parameters
    ----------
    frame
        The frame; its contact points lie on the edges, or a gap away from them.
    polygons
        The elements at the points of the frame.
    """
    import shapely

    contact = np.flatnonzero(np.isin(frame.contact_state, list(MARKED)))
    start = polygons.points
    end = start[polygons.next_point]
    reach = 0.02 * frame.contact_length[contact] + 1.5 * np.abs(frame.contact_gap[contact])
    edges: Any = shapely.linestrings(np.stack([start, end], axis=1))
    tree = shapely.STRtree(edges)
    found, edge = tree.query(
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
    return MarkedEdges(
        point=edge[parallel].astype(np.int64),
        begin=(begin / length)[parallel],
        end=(finish / length)[parallel],
        state=frame.contact_state[contact[parallel]],
    )


def _part(foot: Floats, length: Floats, tributary: Floats) -> tuple[Floats, Floats]:
    """Return from where to where on its edge a contact point speaks for the joint.

    A point in a corner speaks for its tributary length to the inside, one within the edge (Gauss
    points) for half of it to both sides.
    """
    at_end = (foot < 0.05 * tributary) | (foot > length - 0.05 * tributary)
    reach = np.where(at_end, tributary, 0.5 * tributary)
    return np.clip(foot - reach, 0.0, length), np.clip(foot + reach, 0.0, length)
