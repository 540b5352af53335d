"""The deformed blocks with a magnification, broken and sliding joints marked in colour."""

from math import floor, log10
from typing import TYPE_CHECKING

import numpy as np

from integration.polygons import Polygons
from nmm.plots.canvas import (
    PathLike,
    axes_grid,
    extent_of,
    finished,
    fit_height,
    frame_plane,
    legend_below,
    save,
    size_of,
)
from nmm.plots.results.blocks import blocks, material_handles
from nmm.plots.results.broken import broken_parts, sliding_parts
from nmm.plots.results.frame_of import frame_of
from nmm.plots.shapes import draw_blocks, line_width
from nmm.results.frame import Frame, Topology
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

    from nmm.scene import Scene

BROKEN = ("broken joint", "#c1121f")
SLIDING = ("sliding contact", "#e08e0b")
SHARE = 0.05  # of the scene's size that the largest displacement takes when nothing else is asked


def deformed(
    run: RunData,
    *,
    frame: int = -1,
    magnification: float | None = None,
    ax: "Axes | None" = None,
    path: PathLike | None = None,
    title: str = "deformed",
) -> "Axes":
    """Draw the blocks of one frame, displacements magnified, failed joints in colour.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    frame
        Number of the frame, counted from the end when negative.
    magnification
        Factor on displacements; None takes a round one that makes them visible, never below 1.
    ax
        Axes to draw into; a new figure when None.
    path
        File to save the figure in.
    title
        Title; load factor or time and the magnification are added.
    """
    shown = frame_of(run, frame)
    topology = run.topologies[shown.topology]
    factor = magnification or visible(shown, topology)
    polygons = magnified(shown, topology, factor)
    extent = extent_of(polygons.points, topology.elements.points)
    axes = ax or axes_grid(1, 1, 4.0)[0]
    draw_blocks(axes, topology, polygons, shown)
    marked = _draw_marks(axes, run, shown, topology, polygons)
    frame_plane(axes, extent, f"{title}, {moment(shown)}, displacements ×{factor:g}")
    legend_below(axes, [*material_handles(topology), *marked])
    return finished(axes, path, fit=ax is None)


def failure_mode(
    run: RunData,
    *,
    scene: "Scene | None" = None,
    magnification: float | None = None,
    path: PathLike | None = None,
) -> "list[Axes]":
    """Draw the initial geometry above the last frame; arguments as `blocks` and `deformed`."""
    last = run.frames[-1]
    topology = run.topologies[last.topology]
    factor = magnification or visible(last, topology)
    upper, lower = panels = axes_grid(2, 1, 6.0)
    blocks(run, scene=scene, ax=upper)
    name = "failure mode" if last.stage == "failure" else "deformed"
    deformed(run, magnification=factor, ax=lower, title=name)
    _same_limits(panels)
    fit_height(panels)
    save(upper, path)
    return panels


def visible(frame: Frame, topology: Topology) -> float:
    """Return a magnification 1, 2 or 5 times a power of ten that makes displacements visible."""
    largest = float(np.hypot(*frame.displacement.T).max(initial=0.0))
    size = size_of(topology.elements)
    if largest <= 1e-12 * size:
        return 1.0
    wanted = SHARE * size / largest
    power = 10.0 ** floor(log10(wanted))
    return max(1.0, max(step * power for step in (1, 2, 5) if step * power <= wanted * (1 + 1e-9)))


def magnified(frame: Frame, topology: Topology, factor: float) -> Polygons:
    """Return the elements of a frame with displacements times a factor."""
    return topology.elements.with_points(frame.points + (factor - 1.0) * frame.displacement)


def moment(frame: Frame) -> str:
    """Return when a frame was taken in words: time in a dynamic run, else the load factor."""
    if frame.stage == "dynamic":
        return f"t = {frame.time:.4g} s"
    return f"load factor {frame.load_factor:.4g}"


def _draw_marks(
    axes: "Axes", run: RunData, frame: Frame, topology: Topology, polygons: Polygons
) -> "list[Line2D]":
    """Draw failed joints over both edges; return legend entries of the kinds drawn."""
    from matplotlib.collections import LineCollection
    from matplotlib.lines import Line2D

    broken = broken_parts(run.frames, topology, frame)
    sliding = sliding_parts(topology, frame)
    kinds = {SLIDING: sliding.take(~sliding.covered_by(broken)), BROKEN: broken}
    width = 0.9 + line_width(topology)
    entries = []
    for (name, colour), parts in kinds.items():
        if len(parts.point):
            lines = parts.on(polygons)
            axes.add_collection(
                LineCollection(list(lines), colors=colour, linewidths=width, capstyle="round")
            )
            lengthless = parts.begin == parts.end  # contacts that speak for no length
            points = lines[lengthless, 0]
            axes.plot(*points.T, "o", color=colour, markersize=2.5 + width)
            line, marker = ("none", "o") if lengthless.all() else ("-", "none")
            entries.append(
                Line2D([], [], color=colour, lw=width, ls=line, marker=marker, label=name)
            )
    return entries


def _same_limits(panels: "list[Axes]") -> None:
    """Give all axes the limits that hold the drawings of each."""
    left, right = zip(*(axes.get_xlim() for axes in panels), strict=True)
    low, high = zip(*(axes.get_ylim() for axes in panels), strict=True)
    for axes in panels:
        axes.set_xlim(min(left), max(right))
        axes.set_ylim(min(low), max(high))
