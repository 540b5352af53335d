"""Polygons and their outlines as matplotlib collections."""

from typing import TYPE_CHECKING, Any

import numpy as np

from integration.polygons import Polygons
from nmm.plots.edges import cracks, opened_on_several, outlines, segments
from nmm.quantity import SPOT
from nmm.results.frame import Frame, Topology

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import PathCollection

    from covers.cutting.cut_cells import CutCells

MATERIALS = ("#ddd8cb", "#93aac2", "#cfae8a", "#a9c2a0", "#c6a9bd", "#e4d39a")
"""Fill colours of materials in the order of the scene."""

EDGE, CRACK = "#3d3d3d", "#b2182b"


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


def draw_outline(axes: "Axes", cut: "CutCells", crack_width: float) -> None:
    """Draw the edges of the material and, in so many points, the faces of cracks."""
    from matplotlib.collections import LineCollection

    edges = cut.boundary
    lines = np.stack([edges.start, edges.end], axis=1)
    crack = edges.crack >= 0
    axes.add_collection(LineCollection(list(lines[~crack]), colors=EDGE, linewidths=0.9))
    axes.add_collection(LineCollection(list(lines[crack]), colors=CRACK, linewidths=crack_width))


def draw_lines(
    axes: "Axes", topology: Topology, polygons: Polygons, frame: Frame | None, **style: Any
) -> None:
    """Draw the outlines of regions and faces that have opened, cracks half as wide again."""
    from matplotlib.collections import LineCollection

    width = style.pop("linewidths", line_width(topology))
    starts = outlines(topology)
    if frame is not None:
        starts = np.append(starts, opened_on_several(topology, frame))
    lines = segments(polygons, starts)
    axes.add_collection(LineCollection(list(lines), linewidths=width, **style))
    if frame is not None and len(opened := segments(polygons, cracks(topology, frame))):
        axes.add_collection(
            LineCollection(list(opened), linewidths=1.5 * width, capstyle="round", **style)
        )
    if frame is not None:
        draw_tips(axes, polygons, frame)


def draw_tips(axes: "Axes", polygons: Polygons, frame: Frame) -> None:
    """Mark the tips of cracks that may grow, where the polygons are drawn."""
    for quantity in frame.on("tips").values():  # a handful
        if quantity.components != SPOT or not len(quantity.values):
            continue
        away = np.hypot(*np.moveaxis(quantity.values[:, None] - frame.points, -1, 0))
        points = polygons.points[np.argmin(away, axis=1)]
        axes.plot(*points.T, "o", color=CRACK, markersize=4, markeredgewidth=0)


def draw_blocks(
    axes: "Axes", topology: Topology, polygons: Polygons, frame: Frame | None = None, **style: Any
) -> None:
    """Draw elements filled by material, with faint element edges, full region outlines and cracks.

    Parameters
    ----------
    axes
        Where to.
    topology
        What the polygons are.
    polygons
        The elements where they are drawn.
    frame
        When given, cracks that have opened in it are drawn.
    style
        Overrides of matplotlib's collection properties of the filling.
    """
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
        draw_lines(axes, topology, polygons, frame, colors=EDGE)
