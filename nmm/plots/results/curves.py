"""Curves of history columns: one against another, several against time, or a page of all."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.plots.canvas import SMALL, PathLike, axes_grid, finished, frame, save
from nmm.plots.units import label, prefixed, unit_of, words_of
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CYCLE = ("#1d4e89", "#c1121f", "#2a7f62", "#e08e0b", "#6a4c93", "#555555", "#4d9de0")
ENERGIES = (
    "external_work",
    "strain_energy",
    "kinetic_energy",
    "contact_energy",
    "support_energy",
    "friction_loss",
    "integration_loss",
    "contact_loss",
)
DAMPING = "damping_loss"
STILL = 1e-9  # of the largest displacement: what moved by less did not
STATES = ("bonded", "stick", "slide", "open", "broken")


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
    x_values, x_text = _readable(run, x, x_factor, x_label)
    y_values, y_text = _readable(run, y, y_factor, y_label)
    dots = "o" if len(x_values) <= 60 else ""
    axes.plot(x_values, y_values, color=CYCLE[0], linewidth=1.2, marker=dots, markersize=3.0)
    title = f"{_signed(words_of(y), y_factor)} against {_signed(words_of(x), x_factor)}"
    _on_grid(axes, x_text, y_text, title)
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
    family = "monitor" if monitor is None else f"monitor:{monitor}"
    columns = _family(run.history, family)
    if not columns:
        raise NmmError(
            f"load-displacement plot: {family}: expected a displacement in the history that is not "
            "zero: add [[monitors]] to the scene"
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


def history(
    run: RunData,
    columns: Sequence[str],
    *,
    x: str | None = None,
    log: bool = False,
    ax: "Axes | None" = None,
    path: PathLike | None = None,
) -> "Axes":
    """Draw history columns of one unit against time, or the load factor of a static run.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    columns
        Names of history columns that share their unit.
    x
        Column on the horizontal axis; None takes what grows: time, else step.
    log
        Logarithmic vertical axis; values that are not positive are left out.
    ax
        Axes to draw into; a new figure when None.
    path
        File to save the figure in.

    Raises
    ------
    NmmError
        When the history has no such column, or the columns differ in unit.
    """
    from matplotlib.ticker import MaxNLocator

    units = {unit_of(name) for name in columns}
    if len(units) != 1:
        raise NmmError(
            f"history plot: columns {', '.join(columns)} have the units "
            f"{', '.join(sorted(units)) or 'none'}: expected one: draw them apart"
        )
    axes = ax or axes_grid(1, 1, 4.2)[0]
    x_values, x_text = _readable(run, x or _clock(run))
    values = [_column(run, name) for name in columns]
    factor, unit = prefixed(np.concatenate(values), units.pop())
    # Later curves are thinner and every other one is dashed, so that none hides those below it.
    widths = np.linspace(max(1.2, min(0.8 + 0.8 * len(columns), 3.2)), 1.2, len(columns))
    looks = zip(columns, values, CYCLE * len(columns), widths, strict=False)
    for number, (name, one, colour, width) in enumerate(looks):
        shown = factor * (np.where(one > 0, one, np.nan) if log else one)
        dashes = (0, (4, 2)) if number % 2 else "-"
        axes.plot(
            x_values, shown, color=colour, linewidth=width, linestyle=dashes, label=words_of(name)
        )
    if log:
        axes.set_yscale("log")
    counted = set(columns) <= set(STATES)
    alone = len(columns) == 1 and not counted
    one_name = words_of(columns[0]) if alone else _common(columns)
    _on_grid(axes, x_text, label(one_name, unit), one_name)
    if counted or set(columns) <= {"passes"}:
        axes.yaxis.set_major_locator(MaxNLocator("auto", integer=True, min_n_ticks=1))
    if not alone:
        axes.legend(loc="best", frameon=False, fontsize=SMALL)
    return finished(axes, path)


def overview(run: RunData, *, path: PathLike | None = None) -> "list[Axes]":
    """Draw what a run's history says at a glance: load or energies, contacts, residual, passes.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    path
        File to save the figure in.
    """
    known, clock = run.history, _clock(run)
    groups: list[tuple[Sequence[str], bool]] = [
        ([name for name in (*ENERGIES, *_family(known, DAMPING)) if _varies(known, name)], False),
        ([name for name in ("load_factor",) if _changes(known, name) and name != clock], False),
        ([name for name in STATES if _varies(known, name)], False),
        ([name for name in ("residual",) if _varies(known, name)], True),
        ([name for name in ("penetration",) if _varies(known, name)], False),
        ([name for name in ("passes",) if name in known], False),
        (_family(known, "monitor"), False),
        (_family(known, "reaction"), False),
    ]
    drawn = [(columns, log) for columns, log in groups if columns]
    rows = (len(drawn) + 1) // 2
    panels = axes_grid(max(rows, 1), 2, 2.5 * max(rows, 1))
    for axes, (columns, log) in zip(panels, drawn, strict=False):
        history(run, columns, log=log, ax=axes)
    for axes in panels[len(drawn) :]:
        axes.set_visible(False)
    save(panels[0], path)
    return panels[: len(drawn)]


def _varies(known: Mapping[str, Floats], name: str) -> bool:
    return name in known and bool(np.any(np.nan_to_num(known[name])))


def _changes(known: Mapping[str, Floats], name: str) -> bool:
    return name in known and bool(np.ptp(known[name]) > 0)


def _family(known: Mapping[str, Floats], family: str) -> list[str]:
    return [name for name in known if name.startswith(f"{family}:") and _varies(known, name)]


def _clock(run: RunData) -> str:
    """Return the column that tells when: the load factor in statics, else time, else the step."""
    time, factor = run.history.get("time"), run.history.get("load_factor")
    if time is None or len(time) < 2 or not bool(np.all(np.diff(time) > 0)):
        return "step"
    return "load_factor" if factor is not None and np.array_equal(time, factor) else "time"


def _column(run: RunData, name: str) -> Floats:
    if name not in run.history:
        raise NmmError(
            f"history: column {name!r}: expected one of {', '.join(run.history) or 'none'}: "
            "name a column of history.csv"
        )
    return run.history[name]


def _readable(
    run: RunData, name: str, factor: float = 1.0, text: str | None = None
) -> tuple[Floats, str]:
    """Return a column in a readable unit and its label; a label of the caller's keeps SI."""
    values = factor * _column(run, name)
    if text is not None:
        return values, text
    scale, unit = prefixed(values, unit_of(name))
    return scale * values, label(_signed(words_of(name), factor), unit)


def _signed(words: str, factor: float) -> str:
    """Say that a column is drawn with its sign changed."""
    return f"-{words}" if factor < 0 else words


def _common(columns: Sequence[str]) -> str:
    for names, words in ((ENERGIES, "energy"), (STATES, "contact points")):
        if {name for name in columns if not name.startswith(DAMPING)} <= set(names):
            return words
    families = {name.partition(":")[0] for name in columns}
    return {"monitor": "displacement", "reaction": "reactions"}.get(families.pop(), "value")


def _on_grid(axes: "Axes", x_text: str, y_text: str, title: str) -> None:
    axes.grid(True, color="#e6e6e6", linewidth=0.6)
    axes.set_axisbelow(True)
    frame(axes, x_text, y_text, title)
