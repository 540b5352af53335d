"""The paths of growing cracks, piece by piece, over the material as it is cut at last."""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.plots.canvas import (
    PathLike,
    axes_grid,
    extent_of,
    finished,
    frame_plane,
    legend_below,
)
from nmm.plots.shapes import EDGE, MATERIALS, draw_lines, fill
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = ("#b2182b", "#2166ac", "#1b7837", "#762a83", "#b35806", "#01665e")
PLACE = ":growth"
# Effects whose fronts grow.
GROWING = ("fracture", "fracture in time", "cohesive zones")


def crack_paths(run: RunData, *, ax: "Axes | None" = None, path: PathLike | None = None) -> "Axes":
    """Draw where the fronts of all cracks that have grown were, step by step.

    Parameters
    ----------
    run
        A run of a scene with ``[fracture]`` or ``[cohesive_zones]``, in memory or stored.
    ax
        Axes to draw into; a new figure when None.
    path
        File to save the figure in.

    Raises
    ------
    NmmError
        No crack has grown.
    """
    paths = grown_paths(run)
    if not paths:
        raise NmmError(
            "picture of crack paths: no crack has grown: expected a run in which one did"
        )
    shown = run.frames[-1]
    topology = run.topologies[shown.topology]
    elements = topology.elements
    axes = ax or axes_grid(1, 1, 5.0)[0]
    fill(axes, elements, facecolors=MATERIALS[0], edgecolors=MATERIALS[0], linewidths=0.4)
    draw_lines(axes, topology, elements, shown, colors=EDGE)
    handles = []
    for number, (name, points) in enumerate(paths.items()):  # a handful of fronts
        colour = COLOURS[number % len(COLOURS)]
        handles += axes.plot(*points.T, "-", color=colour, lw=1.6, marker=".", ms=4, label=name)
    frame_plane(axes, extent_of(elements.points), "paths of cracks")
    legend_below(axes, handles)
    return finished(axes, path, fit=ax is None)


def grown_paths(run: RunData) -> dict[str, Floats]:
    """Return the places (n, 2) of every front that has grown, by its name; a point a piece."""
    history, found = run.history, {}
    for column, grown in history.items():
        effect, _, name = column.removesuffix(PLACE).partition(":")
        if effect not in GROWING or not column.endswith(PLACE) or not np.nanmax(grown) > 0:
            continue
        if f"{effect}:{name}:x" in history:
            known = np.flatnonzero(np.isfinite(grown))
            first = known[np.unique(grown[known], return_index=True)[1]]
            places = [history[f"{effect}:{name}:{axis}"][first] for axis in "xy"]
            found[name] = np.stack(places, axis=1)
    return found
