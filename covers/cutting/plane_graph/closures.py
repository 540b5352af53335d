"""Closures: auxiliary lines that make every face a simple polygon.

A crack that ends inside a cell is extended straight to the next line, and what lies inside a cell
without touching its edges (a hole, a block, a closed crack) is connected to the lines left and
right of it. A closure is no discontinuity: the parts on both sides keep the same covers. It turns
faces with slits and holes into simple polygons for moments, triangulation and drawing.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely

from covers.cutting.components import components
from covers.cutting.plane_graph.faces import Cells, Faces, Sources, faces_of
from covers.cutting.plane_graph.half_edges import walks
from covers.cutting.plane_graph.snap_rounding import Lines, node
from covers.cutting.resolution import Resolution
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import cross

TIP, LEFT, RIGHT, TOUCH = 0, 1, 2, 3
# A closure that would end nearer to a point than this share of its length ends at the point.
SNAP = 1e-3
CLOSURE_PASSES = 30


@dataclass(frozen=True)
class _Rays:
    """Rays from points (r,) of the graph, with directions (r, 2) and the kind of each (r,)."""

    origin: Ints
    direction: Floats
    kind: Ints


def closed_faces(
    lines: Lines, sources: Sources, cells: Cells, resolution: Resolution, reach: float
) -> Faces:
    """Return the faces between lines, with closures that make each a simple polygon.

    Parameters
    ----------
    reach : float
        largest length of a closure, the largest diameter of a cell, m.

    Raises
    ------
    ValueError
        Faces are not simple after `CLOSURE_PASSES` passes.
    """
    shot = np.empty(0, dtype=np.int64)
    for _ in range(CLOSURE_PASSES):  # one pass without tips and holes, two or three with them
        faces = faces_of(lines, sources, cells)
        rays = _unseen(_rays_of_blocks(faces), shot)
        if not len(rays.origin):
            rays = _unseen(_rays_of_pinches(faces), shot)
        if not len(rays.origin):
            return faces
        shot = np.concatenate([shot, rays.origin * 4 + rays.kind])
        lines = _with_closures(lines, faces, rays, resolution, reach / resolution.step)
    raise ValueError(
        f"cracks: faces with slits left after {CLOSURE_PASSES} closures: simple cracks and holes "
        "expected: remove cracks that wind around one another inside a cell"
    )


def _rays_of_blocks(faces: Faces) -> _Rays:
    """Rays from free ends of lines, and from extreme points of components off the mesh."""
    half, edges = faces.half, faces.edges
    thread = half.loop[0::2] == half.loop[1::2]
    n = len(faces.steps)
    block = components(n, edges[~thread, 0], edges[~thread, 1])
    anchored = np.zeros(n, dtype=bool)
    anchored[block[edges[faces.on_mesh]]] = True
    degree = np.bincount(edges.ravel(), minlength=n)
    several = np.bincount(block, minlength=n)[block] > 1

    tip = (degree == 1) & ~anchored[block] & ~several
    # Lines outside of all cells need no closure.
    outside = np.zeros(half.n_loops, dtype=bool)
    outside[half.loop[np.repeat(faces.on_mesh, 2)]] = True
    outside &= faces.cell < 0
    ending = np.flatnonzero(tip[half.origin] & ~outside[half.loop])
    backward = faces.steps[half.head[ending]] - faces.steps[half.origin[ending]]
    detached = np.flatnonzero((degree > 0) & several & ~anchored[block])
    return _joined(
        [
            _Rays(half.origin[ending], -backward, np.full(len(ending), TIP)),
            _sideways(faces.steps, detached, block, -1.0, LEFT),
            _sideways(faces.steps, detached, block, 1.0, RIGHT),
        ]
    )


def _sideways(steps: Floats, points: Ints, block: Ints, sign: float, kind: int) -> _Rays:
    """Rays to the left (-1) or right (+1) from the extreme point of each block."""
    order = np.lexsort((points, -sign * steps[points, 0], block[points]))
    extreme = points[order[np.unique(block[points][order], return_index=True)[1]]]
    direction = np.tile([sign, 0.0], (len(extreme), 1))
    return _Rays(extreme, direction, np.full(len(extreme), kind))


def _rays_of_pinches(faces: Faces) -> _Rays:
    """Rays from parts that touch the boundary of their face at a single point."""
    half = faces.half
    material = (faces.cell >= 0) & (faces.region >= 0)
    member = np.flatnonzero(material[half.loop])
    key = half.loop[member] * len(faces.steps) + half.origin[member]
    once, number = np.unique(key, return_counts=True)
    rays = [_no_rays()]
    for twice in once[number > 1].tolist():  # faces that touch themselves, which are rare
        loop, point = divmod(twice, len(faces.steps))
        visits = np.flatnonzero((half.loop == loop) & (half.origin == point))
        length = np.array([int((half.loop == loop).sum())])
        ring = walks(half.next, visits[:1], length)
        stops = np.append(np.flatnonzero(half.origin[ring] == point), len(ring))
        for begin, end in pairwise(stops.tolist()):
            part = ring[begin:end]
            if not faces.on_mesh[part // 2].any():
                away = faces.steps[half.origin[part]] - faces.steps[point]
                far = int(np.argmax((away**2).sum(axis=1)))
                rays.append(_Rays(half.origin[part[far : far + 1]], away[[far]], np.array([TOUCH])))
    return _joined(rays)


def _with_closures(
    lines: Lines, faces: Faces, rays: _Rays, resolution: Resolution, reach: float
) -> Lines:
    """Lines with closures along the rays that hit another line."""
    ray, edge, share, distance = _hits(faces, rays, reach)
    start, end = _ends(faces, edge)
    place = faces.steps[start] + share[:, None] * (faces.steps[end] - faces.steps[start])
    lines, target = lines.with_points(place, resolution.points(place))
    for corner in (start, end):
        near = np.hypot(*(faces.steps[corner] - place).T) < SNAP * distance
        target = np.where(near, corner, target)
    old = len(lines.start)
    lines = lines.with_pieces(rays.origin[ray], target, np.full(len(ray), -1))
    return node(lines, np.arange(len(lines.start)) >= old, resolution)


def _hits(faces: Faces, rays: _Rays, reach: float) -> tuple[Ints, Ints, Floats, Floats]:
    """Rays that hit an edge: ray, first edge, parameter on the edge, distance in steps."""
    unit = rays.direction / np.hypot(*rays.direction.T)[:, None]
    begin = faces.steps[rays.origin]
    corners = np.stack([begin, begin + reach * unit], axis=1)
    ray, edge = shapely.STRtree(_boxes(faces.steps[faces.edges])).query(_boxes(corners))
    own = (faces.edges[edge] == rays.origin[ray][:, None]).any(axis=1)
    ray, edge = ray[~own], edge[~own]
    start, end = (faces.steps[side] for side in _ends(faces, edge))
    along, away, direction = end - start, start - begin[ray], unit[ray]
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = cross(direction, along)
        distance = cross(away, along) / slope
        share = cross(away, direction) / slope
    slack = 1.0 / np.hypot(*along.T)
    with np.errstate(invalid="ignore"):
        hit = (distance > 0) & (distance <= reach) & (share >= -slack) & (share <= 1 + slack)
    ray, edge, share, distance = ray[hit], edge[hit], share[hit].clip(0.0, 1.0), distance[hit]
    order = np.lexsort((distance, ray))
    first = order[np.unique(ray[order], return_index=True)[1]]
    return ray[first], edge[first], share[first], distance[first]


def _ends(faces: Faces, edge: Ints) -> tuple[Ints, Ints]:
    """Ends (r,) of edges, the left one first, so that results do not depend on numbering."""
    one, two = faces.edges[edge].T
    turned = (faces.steps[one] - faces.steps[two]) @ np.array([1.0, 1e-3]) > 0
    return np.where(turned, two, one), np.where(turned, one, two)


def _boxes(corners: Floats) -> Floats:
    low, high = corners.min(axis=1) - 1, corners.max(axis=1) + 1
    return np.asarray(shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1]))


def _joined(rays: list[_Rays]) -> _Rays:
    return _Rays(
        np.concatenate([part.origin for part in rays]),
        np.concatenate([part.direction for part in rays]),
        np.concatenate([part.kind for part in rays]),
    )


def _no_rays() -> _Rays:
    return _Rays(np.empty(0, dtype=np.int64), np.empty((0, 2)), np.empty(0, dtype=np.int64))


def _unseen(rays: _Rays, shot: Ints) -> _Rays:
    new: Bools = ~np.isin(rays.origin * 4 + rays.kind, shot)
    return _Rays(rays.origin[new], rays.direction[new], rays.kind[new])
