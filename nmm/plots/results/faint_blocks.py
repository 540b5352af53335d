"""The blocks of one frame, faint, for something else to be drawn over them."""

from typing import TYPE_CHECKING

from integration.polygons import Polygons
from nmm.plots.canvas import axes_grid
from nmm.plots.results.deformed import magnified
from nmm.plots.results.frame_of import frame_of
from nmm.plots.shapes import draw_blocks
from nmm.results.frame import Frame
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def faint_blocks(run: RunData, frame: int, ax: "Axes | None") -> tuple["Axes", Frame, Polygons]:
    """Draw the blocks of a frame into ``ax`` or a new figure; return axes, frame and outlines."""
    shown = frame_of(run, frame)
    topology = run.topologies[shown.topology]
    polygons, axes = magnified(shown, topology, 1.0), ax or axes_grid(1, 1, 4.0)[0]
    draw_blocks(axes, topology, polygons, facecolors="#f4f2ed", edgecolors="#c9c5ba")
    return axes, shown, polygons
