"""One column of a history against another: curves of load and displacement."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.errors import NmmError
from nmm.plots.canvas import PathLike, axes_grid, finished
from nmm.plots.results.graphs.columns import CYCLE, family, on_grid, readable, signed
from nmm.plots.units import words_of
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STILL = 1e-9  # of the largest displacement: what moved by less did not


def curve(
    run: RunData,
    x: str,
    y: str = "load_factor",
    *,
    x_factor: float = 1.0,
    y_factor: float = 1.0,
    x_label: str | None = None,
    y_label: str | None = None,
    ax: "Axes | None" = None,
    path: PathLike | None = None,
) -> "Axes":
    """Draw one history column against another, as in a load-displacement curve.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    x, y
        Names of history columns.
    x_factor, y_factor
        Factors on the columns, such as -1 for a deflection positive downwards or the load in N
        at load factor 1.
    x_label, y_label
        Axis labels with units; None takes the column's name and unit.
    ax
        Axes to draw into; a new figure when None.
    path
        File to save the figure in.

    Raises
    ------
    NmmError
        When the history has no such column.
    """
    axes = ax or axes_grid(1, 1, 4.2)[0]
    x_values, x_text = readable(run, x, x_factor, x_label)
    y_values, y_text = readable(run, y, y_factor, y_label)
    dots = "o" if len(x_values) <= 60 else ""
    axes.plot(x_values, y_values, color=CYCLE[0], linewidth=1.2, marker=dots, markersize=3.0)
    title = f"{signed(words_of(y), y_factor)} against {signed(words_of(x), x_factor)}"
    on_grid(axes, x_text, y_text, title)
    return finished(axes, path)


def load_displacement(
    run: RunData,
    monitor: str | None = None,
    *,
    ax: "Axes | None" = None,
    path: PathLike | None = None,
) -> "Axes":
    """Draw the load factor against the displacement component of a monitor that moved most.

    Curves of what was at rest without load begin there.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    monitor
        Name of the monitor; None takes all into account.
    ax
        Axes to draw into; a new figure when None.
    path
        File to save the figure in.

    Raises
    ------
    NmmError
        When the run watched no such point.
    """
    watched = "monitor" if monitor is None else f"monitor:{monitor}"
    columns = family(run.history, watched)
    if not columns:
        raise NmmError(
            f"load-displacement plot: {watched}: expected a displacement in the history that is "
            "not zero: add [[monitors]] to the scene"
        )
    column = max(columns, key=lambda name: float(np.nanmax(np.abs(run.history[name]))))
    last = run.history[column][np.isfinite(run.history[column])][-1]
    axes = curve(run, column, x_factor=float(np.copysign(1.0, last)), ax=ax)
    if _from_rest(run):
        line = axes.lines[-1]
        x, y = line.get_data()
        line.set_data(np.append(0.0, x), np.append(0.0, y))
        axes.relim()
        axes.autoscale_view()
    return finished(axes, path)


def _from_rest(run: RunData) -> bool:
    """Whether the first frame shows no load and no displacement, and the history does not."""
    told = run.history["load_factor"][0] == 0
    if told or not run.frames or run.frames[0].load_factor != 0:
        return False
    first, last = (np.abs(run.frames[n].displacement).max(initial=0.0) for n in (0, -1))
    return bool(first <= STILL * last)
