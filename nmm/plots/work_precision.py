"""Work-precision figures: error against seconds, unknowns and memory, and where the time goes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from nmm.plots.canvas import SMALL, PathLike, axes_grid, save
from nmm.plots.curves import CYCLE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MARKERS = ("o", "s", "^", "D", "v", "P", "X")
PHASES = ("covers", "effects", "search", "assembly", "solve", "update", "rest")


@dataclass(frozen=True)
class Series:
    """The runs of one formulation; nan where a run failed.

    Attributes
    ----------
    error, seconds, unknowns, memory
        One value a run.
    on_front
        Whether no run of any formulation is better in both error and seconds.
    phases
        Seconds by phase of the finest run.
    failed
        Number of runs that failed.
    """

    error: Sequence[float]
    seconds: Sequence[float]
    unknowns: Sequence[float]
    memory: Sequence[float]
    on_front: Sequence[bool]
    phases: Mapping[str, float] = field(default_factory=dict)
    failed: int = 0


def work_precision(
    series: Mapping[str, Series],
    *,
    title: str = "",
    error_name: str = "relative error",
    uncertainty: float = 0.0,
    path: PathLike | None = None,
) -> "list[Axes]":
    """Draw four panels: error against seconds, unknowns and memory; seconds by phase.

    Parameters
    ----------
    series
        By name of the formulation.
    title, error_name
        Above the figure, and on the axis of the errors.
    uncertainty
        Relative uncertainty of the reference; errors below it mean nothing and are shaded.
    path
        File to save the figure in.
    """
    panels = axes_grid(2, 2, 7.6)
    costs = (("seconds", "processor seconds"), ("unknowns", "unknowns"), ("memory", "memory (MiB)"))
    for axes, (what, label) in zip(panels, costs, strict=False):
        for number, (name, one) in enumerate(series.items()):
            _line(axes, one, what, name, number)
        if uncertainty > 0:
            low = axes.get_ylim()[0]
            axes.axhspan(min(low, uncertainty / 10), uncertainty, color="#00000012", linewidth=0)
        axes.set(xlabel=label, ylabel=error_name)
        if any(np.isfinite(line.get_ydata()).any() for line in axes.lines):
            axes.set(xscale="log", yscale="log")
        axes.grid(visible=True, which="major", linewidth=0.3, color="#cccccc")
    _front(panels[0], series)
    _phases(panels[3], series)
    panels[0].legend(fontsize=SMALL - 1.5, frameon=False)
    if title:
        panels[0].figure.suptitle(title, fontsize=10)
    save(panels[0], path)
    return panels


def _line(axes: "Axes", one: Series, what: str, name: str, number: int) -> None:
    cost = np.asarray(getattr(one, what), dtype=float) / (2**20 if what == "memory" else 1)
    error = np.maximum(np.asarray(one.error, dtype=float), 1e-16)
    good = np.isfinite(cost) & np.isfinite(error) & (cost > 0)
    order = np.argsort(cost[good])
    label = name + (f" ({one.failed} failed)" if one.failed else "")
    axes.plot(
        cost[good][order],
        error[good][order],
        color=CYCLE[number % len(CYCLE)],
        marker=MARKERS[number % len(MARKERS)],
        markersize=4,
        linewidth=1.1,
        label=label,
    )


def _front(axes: "Axes", series: Mapping[str, Series]) -> None:
    """Draw the Pareto front as a broad pale line under the points."""
    best = [
        (s, e)
        for one in series.values()
        for s, e, best in zip(one.seconds, one.error, one.on_front, strict=True)
        if best
    ]
    if len(best) > 1:
        seconds, error = np.array(sorted(best)).T
        error = np.maximum(error, 1e-16)
        axes.plot(seconds, error, color="#00000022", linewidth=7, zorder=0, label="Pareto front")


def _phases(axes: "Axes", series: Mapping[str, Series]) -> None:
    left = np.zeros(len(series))
    names = list(series)
    for number, phase in enumerate(PHASES):
        spent = np.array([series[name].phases.get(phase, 0.0) for name in names])
        axes.barh(names, spent, left=left, color=CYCLE[number % len(CYCLE)], label=phase)
        left = left + spent
    axes.invert_yaxis()
    axes.set(xlabel="seconds of the finest run")
    axes.tick_params(axis="y", labelsize=SMALL - 1)
    axes.legend(fontsize=SMALL - 2, frameon=False, ncols=2)
