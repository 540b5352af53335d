"""Sketches of benchmark problems: small pictures for the pages of a manual."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.plots.canvas import PathLike, axes_grid, extent_of, limit_plane
from nmm.plots.results.blocks import blocks
from nmm.plots.results.conditions import LOAD, SUPPORT
from nmm.plots.shapes import EDGE, draw_outline, fill
from nmm.plots.small import save_small

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from covers.cutting.cut_cells import CutCells
    from nmm.results.sink import RunData
    from nmm.scene import Scene

WIDTH, LEAST, MOST = 4.4, 1.3, 4.4  # inches
MATERIAL, NET = "#ddd8cb", "#a49d8b"
ARROWS = 40  # tractions drawn at most
LENGTH = 0.09  # longest arrow relative to the body


class DrawnTractions(NamedTuple):
    """Tractions (m, 2) at points (m, 2) of faces with outward normals (m, 2)."""

    points: Floats
    force: Floats
    normals: Floats


def scene_problem(run: "RunData", scene: "Scene", supported: Sequence[int], path: PathLike) -> None:
    """Draw a scene before its run; ``supported`` are the numbers of blocks that cannot move."""
    axes = axes_grid(1, 1, 4.0)[0]
    blocks(run, scene=scene, ax=axes, title="")
    polygons = run.topologies[0].elements
    if supported:
        pattern = {"facecolors": "none", "edgecolors": "#8a8578", "linewidths": 0.0}
        fill(axes, polygons.take(np.array(supported)), hatch="////", **pattern)
    if scene.gravity is not None:
        _weight(axes)
    _write(axes, path)


def solid_problem(
    cut: "CutCells", loads: Sequence[DrawnTractions], supported: Floats, path: PathLike
) -> None:
    """Draw a meshed body.

    Parameters
    ----------
    cut
        Its elements and edges are drawn.
    loads
        To one scale.
    supported
        (m, 2) points that are supported in a direction or in both.
    path
        File to save the figure in.
    """
    axes = axes_grid(1, 1, 4.0)[0]
    elements = cut.elements
    width = float(np.clip(10.0 / np.sqrt(len(elements)), 0.1, 0.6))
    fill(axes, elements, facecolors=MATERIAL, edgecolors=NET, linewidths=width)
    draw_outline(axes, cut, crack_width=1.6)
    axes.plot(*supported.T, ".", color=SUPPORT, markersize=3.0, linestyle="none", zorder=4)
    limit_plane(axes, _arrows(axes, loads, extent_of(elements.points)))
    _write(axes, path)


def polygons_problem(polygons: Polygons, path: PathLike) -> None:
    """Draw polygons alone."""
    axes = axes_grid(1, 1, 4.0)[0]
    fill(axes, polygons, facecolors=MATERIAL, edgecolors=EDGE, linewidths=0.9)
    limit_plane(axes, extent_of(polygons.points))
    _write(axes, path)


def _arrows(axes: "Axes", loads: Sequence[DrawnTractions], extent: Floats) -> Floats:
    """Draw tractions that start at the edge or, where they press, end there; return the extent."""
    strengths = [float(np.hypot(*one.force.T).max(initial=0.0)) for one in loads]
    strongest = max(strengths, default=0.0)
    if not strongest:
        return extent
    size, ends = float(np.hypot(*(extent[1] - extent[0]))), [extent]
    for one in loads:  # a handful of loads
        few = np.unique(np.linspace(0, len(one.points) - 1, ARROWS).astype(int))
        way = LENGTH * size * one.force[few] / strongest
        pulls = (one.normals[few] * way).sum(axis=1, keepdims=True) > -1e-12 * size
        tail = np.where(pulls, one.points[few], one.points[few] - way)
        axes.quiver(
            *tail.T,
            *way.T,
            angles="xy",
            scale_units="xy",
            scale=1,
            color=LOAD,
            width=0.004,
            zorder=3,
        )
        ends.append(np.concatenate([tail, tail + way]))
    return extent_of(*ends)


def _weight(axes: "Axes") -> None:
    """Say that weight acts, by an arrow in the upper right corner."""
    arrow = {"arrowstyle": "-|>", "color": LOAD, "lw": 1.2}
    axes.annotate(
        "g",
        xy=(1.02, 0.80),
        xytext=(1.02, 0.97),
        xycoords="axes fraction",
        ha="center",
        color=LOAD,
        arrowprops=arrow,
        annotation_clip=False,
    )


def _write(axes: "Axes", path: PathLike) -> None:
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    height = np.clip((WIDTH - 0.7) * (high - low) / (right - left) + 0.6, LEAST, MOST)
    axes.set_title("", loc="left")
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.set_xlabel("x (m)", loc="left")
    axes.set_ylabel("y (m)")
    figure = axes.figure.figure
    figure.set_size_inches(WIDTH, float(height))
    save_small(figure, path)
