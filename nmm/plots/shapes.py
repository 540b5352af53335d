"""Polygons and their outlines as matplotlib collections."""

from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.results.frame import Topology

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import PathCollection

MATERIALS = ("#ddd8cb", "#93aac2", "#cfae8a", "#a9c2a0", "#c6a9bd", "#e4d39a")
"""Fill colours of materials in the order of the scene."""

EDGE = "#3d3d3d"


def material_colour(number: int) -> str:
    """Return the fill colour of a material."""
    return MATERIALS[number % len(MATERIALS)]


def line_width(topology: Topology) -> float:
    """Return a width, points, that stays thin against the blocks when there are many."""
    return float(np.clip(8.0 / np.sqrt(max(len(topology.region_material), 1)), 0.25, 0.9))


def fill(axes: "Axes", polygons: Polygons, **style: Any) -> "PathCollection":
    """Fill polygons, holes left open."""
    from matplotlib.collections import PathCollection

    collection = PathCollection(paths(polygons), **style)
    axes.add_collection(collection)
    return collection


def paths(polygons: Polygons) -> list[Any]:
    """Return one matplotlib path a polygon, holes as rings of the other sense."""
    from matplotlib.path import Path

    oriented = polygons.oriented()
    rings = len(oriented.ring_offsets) - 1
    first = oriented.points[oriented.ring_offsets[:-1]]
    closing = np.insert(oriented.points, oriented.ring_offsets[1:], first, axis=0)
    ends = oriented.ring_offsets[1:] + np.arange(1, rings + 1)
    codes = np.full(len(closing), Path.LINETO, dtype=Path.code_type)
    codes[ends - 1] = Path.CLOSEPOLY
    codes[np.concatenate([[0], ends[:-1]]) if rings else []] = Path.MOVETO
    split = ends[oriented.polygon_offsets[1:-1] - 1]
    vertices = zip(np.split(closing, split), np.split(codes, split), strict=True)
    return [Path(points, code) for points, code in vertices]  # one object a polygon by nature


def outlines(topology: Topology) -> Ints:
    """(n,) points at which an edge starts that two elements of one region do not share.

    What is left is the outline of each region and of the cracks in it.
    """
    elements = topology.elements
    points = elements.points
    size = float(np.ptp(points, axis=0).max())
    rounded = np.round((points - points.min(axis=0)) / (1e-9 * size)).astype(np.int64)
    ends = np.stack([rounded, rounded[elements.next_point]], axis=1)
    first_is_less = (ends[:, 0, 0] < ends[:, 1, 0]) | (
        (ends[:, 0, 0] == ends[:, 1, 0]) & (ends[:, 0, 1] < ends[:, 1, 1])
    )
    ends[~first_is_less] = ends[~first_is_less, ::-1]
    region = topology.element_region[elements.polygon_of_point]
    keys = np.column_stack([region, ends.reshape(-1, 4)])
    _, index, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    return np.flatnonzero(count[index.ravel()] == 1)


def segments(polygons: Polygons, start: Ints) -> Floats:
    """(n, 2, 2) edges that start at the given points."""
    return np.stack([polygons.points[start], polygons.points[polygons.next_point[start]]], axis=1)


def draw_blocks(axes: "Axes", topology: Topology, polygons: Polygons, **style: Any) -> None:
    """Draw elements filled by material, with faint element edges and full region outlines.

    Parameters
    ----------
    axes
        Where to.
    topology
        What the polygons are.
    polygons
        The elements where they are drawn.
    style
        Overrides of matplotlib's collection properties of the filling.
    """
    from matplotlib.collections import LineCollection

    width = line_width(topology)
    whole = len(topology.elements) == len(topology.region_material)
    colours = [material_colour(int(number)) for number in topology.element_material]
    filling = {
        "facecolors": colours,
        "edgecolors": EDGE if whole else "#9a968c",
        "linewidths": width if whole else 0.4 * width,
        "joinstyle": "round",
    }
    fill(axes, polygons, **(filling | style))
    if not whole:
        lines = segments(polygons, outlines(topology))
        axes.add_collection(LineCollection(list(lines), colors=EDGE, linewidths=width))
