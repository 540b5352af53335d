"""Supports and loads of a scene, drawn at their places before the run."""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from nmm.scene import Scene
    from nmm.scene.actions import SupportTable
    from nmm.scene.tables.loading.loads import LoadTable

SUPPORT = "#1f5f3f"
LOAD = "#8c2d19"
ARROW = 0.10  # length of load arrows relative to the size of the scene
MARK = 0.022  # distance of support marks from their points, likewise


def draw_conditions(axes: "Axes", scene: "Scene", extent: Floats) -> Floats:
    """Draw supports as marks and loads as arrows; return the extent (2, 2) that holds them too.

    A triangle holds both components, a circle one of them, at the side it pushes against. Blocks
    that are held as a whole are hatched.
    """
    _hatch_held(axes, scene)
    supports = [_draw_support(axes, support, extent) for support in scene.supports]
    loads = [_draw_load(axes, load, extent) for load in scene.loads]
    together = np.concatenate([extent, *supports, *loads])
    return np.stack([together.min(axis=0), together.max(axis=0)])


def _places(item: "SupportTable | LoadTable", count: int) -> Floats:
    """(n, 2) the point, or points along the segment; none for a whole block."""
    if item.point is not None:
        return np.array([item.point])
    if item.segment is None:
        return np.zeros((0, 2))
    return np.linspace(item.segment[0], item.segment[1], count)


def _hatch_held(axes: "Axes", scene: "Scene") -> None:
    """Hatch the blocks that a support holds as a whole."""
    whole = {one.block for one in scene.supports if one.point is None and one.segment is None}
    for block in scene.blocks:  # a handful is held
        if block.name in whole:
            x, y = np.array(block.vertices).T
            axes.fill(x, y, facecolor="none", edgecolor=SUPPORT, hatch="//", linewidth=0.0)


def _draw_support(axes: "Axes", support: "SupportTable", extent: Floats) -> Floats:
    points = _places(support, 9)
    if not len(points):
        return points
    size = float(np.hypot(*(extent[1] - extent[0])))
    away = np.where(points.mean(axis=0) <= extent.mean(axis=0), -1.0, 1.0)
    along = np.array([0.0, away[1]]) if "y" in support.fix else np.array([away[0], 0.0])
    marker = _triangle(along) if len(support.fix) == 2 else "o"
    marks = points + MARK * size * along
    axes.plot(*marks.T, marker, color=SUPPORT, markersize=7, linestyle="none", clip_on=False)
    return marks + MARK * size * along


def _triangle(along: Floats) -> str:
    """Return the marker whose tip points against `along`, to the body."""
    return "^" if along[1] < 0 else "v"


def _draw_load(axes: "Axes", load: "LoadTable", extent: Floats) -> Floats:
    points = _places(load, 5)
    vector = np.array(load.force or load.traction or (0.0, 0.0))
    strength = float(np.hypot(*vector))
    if not len(points) or strength == 0.0:
        return np.zeros((0, 2))
    shift = ARROW * float(np.hypot(*(extent[1] - extent[0]))) * vector / strength
    outward = (points.mean(axis=0) - extent.mean(axis=0)) @ vector > 0
    tails = points if outward else points - shift
    for tail in tails:  # a handful of arrows
        axes.annotate(
            "",
            xy=tuple(tail + shift),
            xytext=tuple(tail),
            arrowprops={"arrowstyle": "-|>", "color": LOAD, "lw": 1.2, "shrinkA": 0, "shrinkB": 0},
            annotation_clip=False,
        )
    return np.concatenate([tails, tails + shift])
