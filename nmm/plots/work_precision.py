"""Work-precision figures: error against seconds, unknowns and memory, and where the time goes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from nmm.plots.canvas import SMALL, PathLike, axes_grid, frame, save
from nmm.plots.families import colours

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "h")
PHASES = {
    "covers": "#6a4c93",
    "effects": "#b8a1cf",
    "search": "#e08e0b",
    "assembly": "#93aac2",
    "solve": "#1d4e89",
    "update": "#2a7f62",
    "rest": "#c9c5ba",
}
FAILED = 0.96  # height, in fractions of the axes, at which failed runs are marked


@dataclass(frozen=True)
class Series:
    """The runs of one formulation; errors are nan where a run failed.

    Attributes
    ----------
    error, seconds, counts, memory
        One value a run; counts are of what ``counted`` of `work_precision` says.
    on_front
        Whether no run of any formulation is better in both error and seconds.
    valid
        Whether the run came to an answer.
    phases, effects
        Seconds of the dearest run by phase, and by effect.
    family
        "DDA" or "manifold".
    """

    error: Sequence[float]
    seconds: Sequence[float]
    counts: Sequence[float]
    memory: Sequence[float]
    on_front: Sequence[bool]
    valid: Sequence[bool]
    phases: Mapping[str, float] = field(default_factory=dict)
    effects: Mapping[str, float] = field(default_factory=dict)
    family: str = "manifold"


def work_precision(
    series: Mapping[str, Series],
    *,
    title: str = "",
    error_name: str = "relative error",
    uncertainty: float = 0.0,
    counted: str = "unknowns",
    path: PathLike | None = None,
) -> "list[Axes]":
    """Draw four panels: error against seconds, counts and memory; where the time goes.

    Parameters
    ----------
    series
        By name of the formulation.
    title, error_name
        Above the figure, and on the axis of the errors.
    uncertainty
        Relative uncertainty of the reference; errors below it mean nothing and are shaded.
    counted
        What the runs are counted by: "unknowns", or "steps" where those do not differ.
    path
        File to save the figure in.
    """
    rows = len(series)
    panels = axes_grid(2, 2, 6.2 + 0.17 * rows + 0.14 * max(rows - 4, 0))
    costs = (("seconds", "processor seconds"), ("counts", counted), ("memory", "memory (MiB)"))
    shades = colours([one.family for one in series.values()])
    for axes, (what, words) in zip(panels, costs, strict=False):
        for number, one in enumerate(series.values()):
            _line(axes, one, what, shades[number], MARKERS[number % len(MARKERS)])
        _scales(axes)
        _shade(axes, uncertainty)
        frame(axes, words, error_name, f"error against {words.partition(' (')[0]}")
        axes.grid(visible=True, which="major", linewidth=0.4, color="#e0e0e0")
        axes.set_axisbelow(True)
    _front(panels[0], series)
    _phases(panels[3], series)
    _legend(panels[0], series, shades, uncertainty)
    if title:
        panels[0].figure.suptitle(title, fontsize=11, x=0.01, ha="left")
    save(panels[0], path)
    return panels


def _line(axes: "Axes", one: Series, what: str, colour: str, marker: str) -> None:
    cost = np.asarray(getattr(one, what), dtype=float) / (2**20 if what == "memory" else 1)
    error = np.maximum(np.asarray(one.error, dtype=float), 1e-16)
    there = np.isfinite(cost) & (cost > 0)
    good = there & np.isfinite(error)
    order = np.argsort(cost[good])
    axes.plot(
        cost[good][order],
        error[good][order],
        color=colour,
        marker=marker,
        markersize=4.5,
        linewidth=1.2,
    )
    failed = cost[there & ~np.asarray(one.valid)]
    axes.plot(
        failed,
        np.full(len(failed), FAILED),
        color=colour,
        marker="x",
        markersize=6,
        linewidth=0,
        transform=axes.get_xaxis_transform(),
    )


def _scales(axes: "Axes") -> None:
    from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

    if not any(np.size(line.get_xdata()) for line in axes.lines):
        axes.text(0.5, 0.5, "not measured", ha="center", color="#777777", transform=axes.transAxes)
        axes.set(xticks=[], yticks=[])
        return
    axes.set(xscale="log", yscale="log")
    # Less than two decades of cost: numbers are read better than powers of ten.
    low, high = axes.get_xlim()
    if high / low < 100:
        axes.xaxis.set_major_locator(LogLocator(base=10, subs=(1.0, 2.0, 5.0), numticks=12))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axes.xaxis.set_minor_formatter(NullFormatter())
    bottom, top = axes.get_ylim()
    axes.set_ylim(bottom, top * (top / bottom) ** 0.08)


def _shade(axes: "Axes", uncertainty: float) -> None:
    if uncertainty > 0 and axes.get_yscale() == "log":
        low, high = axes.get_ylim()
        low = min(low, uncertainty / 2)
        axes.axhspan(low, uncertainty, color="#00000014", linewidth=0, zorder=0)
        axes.set_ylim(low, high)


def _front(axes: "Axes", series: Mapping[str, Series]) -> None:
    """Draw the Pareto front as a broad pale line under the points."""
    best = [
        (s, e)
        for one in series.values()
        for s, e, best in zip(one.seconds, one.error, one.on_front, strict=True)
        if best
    ]
    if best:
        seconds, error = np.array(sorted(best)).T
        error = np.maximum(error, 1e-16)
        axes.plot(seconds, error, color="#f3d98b", linewidth=8, zorder=0, solid_capstyle="round")


def _phases(axes: "Axes", series: Mapping[str, Series]) -> None:
    """Draw shares of the dearest run's time by phase, its processor seconds at the end."""
    timed = {name: one for name, one in series.items() if one.phases}
    names = list(timed)
    total = np.array([sum(one.phases.values()) for one in timed.values()])
    left = np.zeros(len(names))
    for phase, colour in PHASES.items():
        spent = np.array([one.phases.get(phase, 0.0) for one in timed.values()])
        share = 100 * spent / np.where(total > 0, total, 1.0)
        if share.any():
            axes.barh(names, share, left=left, color=colour, label=phase, height=0.65)
        left = left + share
    for row, one in enumerate(timed.values()):
        seconds = np.nanmax(one.seconds)
        axes.text(101, row, f"{seconds:.2g} s", va="center", fontsize=SMALL - 1.5)
    axes.set(xlim=(0, 100))
    axes.invert_yaxis()
    axes.tick_params(axis="y", labelsize=SMALL - 1.5)
    frame(axes, "share of the dearest run's time  (%)", "", "where the time goes")
    if names:
        axes.legend(
            fontsize=SMALL - 2,
            frameon=False,
            ncols=3,
            loc="upper center",
            bbox_to_anchor=(0.4, -0.2),
            columnspacing=1.0,
            handlelength=1.0,
        )


def _legend(
    axes: "Axes", series: Mapping[str, Series], shades: Sequence[str], uncertainty: float
) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    entries: list[Line2D | Patch] = []
    for number, (name, one) in enumerate(series.items()):
        failed = len(one.valid) - sum(one.valid)
        text = f"{name} ({failed} of {len(one.valid)} failed)" if failed else name
        marker = MARKERS[number % len(MARKERS)]
        entries.append(
            Line2D([], [], color=shades[number], marker=marker, markersize=4.5, label=text)
        )
    entries.append(Line2D([], [], color="#f3d98b", linewidth=7, label="Pareto front"))
    if not all(all(one.valid) for one in series.values()):
        entries.append(
            Line2D([], [], color="#555555", marker="x", linewidth=0, label="failed run, no error")
        )
    if uncertainty > 0:
        entries.append(Patch(color="#00000014", label="uncertainty of the reference"))
    columns = 3 if max(len(name) for name in series) < 24 else 2
    axes.figure.figure.legend(
        handles=entries,
        loc="outside lower center",
        ncols=columns,
        frameon=False,
        fontsize=SMALL - 0.5,
    )
