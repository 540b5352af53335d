"""Work-precision figures: error against seconds, unknowns and memory, and where the time goes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from nmm.plots.canvas import SMALL, PathLike, axes_grid, frame, save
from nmm.plots.families import styles
from nmm.plots.time_shares import by_effect, by_phase

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_IN_A_COLUMN = 12
FAILED = 0.96  # height, in fractions of the axes, at which failed runs are marked


@dataclass(frozen=True)
class WorkPrecision:
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
    family, method
        "DDA", "manifold" or "elements"; what `nmm.plots.families.METHODS` knows it by.
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
    method: str = ""


def work_precision(
    series: Mapping[str, WorkPrecision],
    *,
    title: str = "",
    error_name: str = "relative error",
    reference: str = "",
    uncertainty: float = 0.0,
    counted: str = "unknowns",
    path: PathLike | None = None,
) -> "list[Axes]":
    """Draw error against seconds, counts and memory; shares of time by phase and by effect.

    Parameters
    ----------
    series
        By name of the formulation.
    title, error_name
        Above the figure, and on the axis of the errors.
    reference
        What errors are taken against, in words, under the title.
    uncertainty
        Relative uncertainty of the reference; errors below it mean nothing and are shaded.
    counted
        What the runs are counted by: "unknowns", or "steps" where those do not differ.
    path
        File to save the figure in.
    """
    rows = len(series)
    panels = axes_grid(3, 2, 7.2 + 0.16 * rows)
    costs = (("seconds", "processor seconds"), ("counts", counted), ("memory", "memory (MiB)"))
    looks = styles([one.family for one in series.values()], [one.method for one in series.values()])
    for axes, (what, words) in zip(panels, costs, strict=False):
        for one, look in zip(series.values(), looks, strict=True):
            _line(axes, one, what, *look)
        _scales(axes)
        _shade(axes, uncertainty)
        frame(axes, words, error_name, f"error against {words.partition(' (')[0]}")
        axes.grid(visible=True, which="major", linewidth=0.4, color="#e0e0e0")
        axes.set_axisbelow(True)
    _front(panels[0], series)
    _legend(panels[3], series, looks, uncertainty)
    timed = {name: one for name, one in series.items() if one.phases}
    phases = {name: one.phases for name, one in timed.items()}
    by_phase(panels[4], phases)
    by_effect(panels[5], phases, {name: one.effects for name, one in timed.items()})
    # The names stand at the left already.
    seconds = [f"{np.nanmax(one.seconds):.2g} s" for one in timed.values()]
    panels[5].set_yticks(range(len(timed)), seconds)
    if title:
        head = f"{title}\n{reference}" if reference else title
        panels[0].figure.suptitle(head, fontsize=9.5, x=0.01, ha="left")
    save(panels[0], path)
    _fewer_colours(path)
    return panels


def _fewer_colours(path: PathLike | None) -> None:
    """Store a PNG with a palette: a third of its size, so that reports can be committed."""
    if path is not None and Path(path).suffix == ".png":
        from PIL import Image

        with Image.open(path) as picture:
            few = picture.convert("RGB").quantize(200, Image.Quantize.MAXCOVERAGE)
        few.save(path, optimize=True)


def _line(axes: "Axes", one: WorkPrecision, what: str, colour: str, marker: str) -> None:
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


def _front(axes: "Axes", series: Mapping[str, WorkPrecision]) -> None:
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


def _legend(
    axes: "Axes",
    series: Mapping[str, WorkPrecision],
    looks: Sequence[tuple[str, str]],
    uncertainty: float,
) -> None:
    """Fill a panel with what the lines stand for."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    entries: list[Line2D | Patch] = []
    for (colour, marker), (name, one) in zip(looks, series.items(), strict=True):
        failed = len(one.valid) - sum(one.valid)
        text = f"{name} ({failed} of {len(one.valid)} failed)" if failed else name
        entries.append(Line2D([], [], color=colour, marker=marker, markersize=4.5, label=text))
    entries.append(Line2D([], [], color="#f3d98b", linewidth=7, label="Pareto front"))
    if not all(all(one.valid) for one in series.values()):
        entries.append(
            Line2D([], [], color="#555555", marker="x", linewidth=0, label="failed run, no error")
        )
    if uncertainty > 0:
        entries.append(Patch(color="#00000014", label="uncertainty of the reference"))
    axes.axis("off")
    axes.legend(
        handles=entries,
        loc="center left",
        bbox_to_anchor=(-0.14, 0.5),
        ncols=2 if len(entries) > MOST_IN_A_COLUMN else 1,
        frameon=False,
        fontsize=SMALL - 1.5,
        borderaxespad=0.0,
        columnspacing=0.8,
        handlelength=1.6,
        handletextpad=0.8,
    )
