"""Parts of edges on which members and masses of a scene act: where they end on faces."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import shapely

from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints
from integration.plane_vectors import clockwise
from nmm.assembly.places import NEAR
from nmm.effects.base import Setup
from nmm.geometry.places import EdgeParts

if TYPE_CHECKING:
    from nmm.effects.members.ends import MemberEnds

    Place = tuple[str, Floats, Ints]


def member_edge_parts(setup: Setup) -> Iterator[tuple[str, EdgeParts]]:
    """Yield the name of each member or mass with ends on faces, and these as parts of edges."""
    for name, position, element in _places(setup):
        parts = ends_on_faces(setup.model.manifold, position, element)
        if len(parts.edge):
            yield name, parts


def ends_on_faces(manifold: Manifold, position: Floats, element: Ints) -> EdgeParts:
    """Return points (m, 2) of elements (m,) as parts without length of the edges that pass them.

    Edges are those of the body of the element, which lies behind them: beside a crack those of one
    of its faces. Points of the ground, of element -1, are on none.
    """
    edges = manifold.boundary
    there, element = position[element >= 0], element[element >= 0]
    lines = np.asarray(shapely.linestrings(np.stack([edges.start, edges.end], axis=1)))
    near = NEAR * manifold.elements.extent
    tree, points = shapely.STRtree(lines), shapely.points(there)
    end, edge = tree.query(points, predicate="dwithin", distance=near)
    own = element[end]
    out = clockwise(edges.end[edge] - edges.start[edge])
    behind = np.sum((there[end] - manifold.elements.centroids[own]) * out, axis=1) > 0
    same = manifold.element_body[own] == manifold.element_body[edges.element[edge]]
    kept = same & (behind | (edges.element[edge] == own))
    return EdgeParts(edge[kept], there[end[kept]], there[end[kept]])


def _places(setup: Setup) -> "Iterator[Place]":
    """Yield names of members and masses, places (m, 2) at which they act and elements (m,)."""
    scene = setup.scene
    if scene.springs or scene.dashpots:
        from nmm.effects.members.ends import ends_of

        for key, members in (("springs", scene.springs), ("dashpots", scene.dashpots)):
            if members:
                both = ends_of(setup, key, members)
                yield from _each([one.name for one in members], *both)
    if scene.bars:
        from nmm.effects.members.bars import bar_nodes

        for bar in scene.bars:  # a handful of bars
            nodes = bar_nodes(setup, bar)
            yield bar.name, nodes.position, nodes.elements
    if scene.masses:
        from nmm.effects.members.masses import mass_ends

        yield from _each([one.name for one in scene.masses], mass_ends(setup))


def _each(names: list[str], *ends: "MemberEnds") -> "Iterator[Place]":
    """Yield the ends of one after the other."""
    for at, name in enumerate(names):  # a handful of members
        position = np.stack([one.position[at] for one in ends])
        yield name, position, np.array([one.element[at] for one in ends])
