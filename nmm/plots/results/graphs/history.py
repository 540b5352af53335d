"""Columns of a history against time: those of one unit, or a page of all."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.plots.canvas import SMALL, PathLike, axes_grid, finished, save
from nmm.plots.results.graphs.columns import CYCLE, column, family, on_grid, readable, varies
from nmm.plots.units import label, prefixed, unit_of, words_of
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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
SEEN = 0.005
"""Share of the largest energy below which a curve lies on the axis, and its name hides others."""
STATES = ("bonded", "stick", "slide", "open", "broken")


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
    x_values, x_text = readable(run, x or _clock(run))
    values = [column(run, name) for name in columns]
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
    on_grid(axes, x_text, label(one_name, unit), one_name)
    if counted or set(columns) <= {"passes"}:
        axes.yaxis.set_major_locator(MaxNLocator("auto", integer=True, min_n_ticks=1))
        axes.set_ylim(bottom=0)
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
    clock = _clock(run)
    # A run that ended before its first step has columns without rows.
    known = {name: column for name, column in run.history.items() if len(column)}
    groups: list[tuple[Sequence[str], bool]] = [
        (_seen(known, [*ENERGIES, *family(known, DAMPING)]), False),
        ([name for name in ("load_factor",) if _changes(known, name) and name != clock], False),
        ([name for name in STATES if varies(known, name)], False),
        ([name for name in ("residual",) if varies(known, name)], True),
        ([name for name in ("penetration",) if varies(known, name)], False),
        ([name for name in ("passes",) if name in known], False),
        (family(known, "monitor"), False),
        (family(known, "reaction"), False),
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


def _seen(known: Mapping[str, Floats], names: Sequence[str]) -> list[str]:
    """Return the columns that vary and can be told from zero beside the largest of them."""
    sizes = {name: float(np.nanmax(np.abs(known[name]))) for name in names if varies(known, name)}
    largest = max(sizes.values(), default=0.0)
    return [name for name, size in sizes.items() if size > SEEN * largest]


def _changes(known: Mapping[str, Floats], name: str) -> bool:
    return name in known and bool(np.ptp(known[name]) > 0)


def _clock(run: RunData) -> str:
    """Return the column that tells when: the load factor in statics, else time, else the step."""
    time, factor = run.history.get("time"), run.history.get("load_factor")
    if time is None or len(time) < 2 or not bool(np.all(np.diff(time) > 0)):
        return "step"
    return "load_factor" if factor is not None and np.array_equal(time, factor) else "time"


def _common(columns: Sequence[str]) -> str:
    for names, words in ((ENERGIES, "energy"), (STATES, "contact points")):
        if {name for name in columns if not name.startswith(DAMPING)} <= set(names):
            return words
    families = {name.partition(":")[0] for name in columns}
    return {"monitor": "displacement", "reaction": "reactions"}.get(families.pop(), "value")
