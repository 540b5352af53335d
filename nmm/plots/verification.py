"""How near benchmarks come to what is allowed, and how their errors fall with size."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from nmm.plots.canvas import SMALL, PathLike, axes_grid, frame
from nmm.plots.results.graphs.columns import CYCLE
from nmm.plots.small import save_small

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PASSED, MISSED = "#2a7f62", "#c1121f"
LEAST = 1e-6  # shares below are drawn here
MARKERS = ("o", "s", "^", "D", "v", "P", "X")


@dataclass(frozen=True)
class Fall:
    """Errors of one formulation over sizes.

    Attributes
    ----------
    sizes, errors
        One value a run.
    theory
        Slope to draw beside.
    label
        What it is, with the observed order.
    x
        What the sizes are.
    """

    sizes: Sequence[float]
    errors: Sequence[float]
    theory: float
    label: str
    x: str


def margins(shares: Mapping[str, Sequence[float]], path: PathLike) -> None:
    """Draw error over tolerance, a row a benchmark and a dot a quantity; right of 1 is missed.

    Parameters
    ----------
    shares
        Error over tolerance of every quantity by benchmark; nan and inf are drawn at the right
        edge.
    path
        File to save the figure in.
    """
    axes = axes_grid(1, 1, 1.0 + 0.15 * len(shares))[0]
    for row, many in enumerate(shares.values()):  # one row a benchmark
        values = np.nan_to_num(np.asarray(many, dtype=float), nan=1e3, posinf=1e3)
        colours = [MISSED if value > 1 else PASSED for value in values]
        drawn = np.clip(values, LEAST, 1e3)
        axes.scatter(drawn, np.full(len(drawn), row), c=colours, s=10, alpha=0.6, linewidths=0)
    axes.axvline(1.0, color=MISSED, linewidth=0.8)
    axes.set_xscale("log")
    missed = any(value > 1 or value != value for many in shares.values() for value in many)
    axes.set_xlim(LEAST / 2, 2e3 if missed else 3.0)
    axes.set_yticks(range(len(shares)), list(shares), fontsize=SMALL - 1.5)
    axes.set_ylim(len(shares) - 0.5, -0.5)
    axes.grid(visible=True, axis="y", linewidth=0.4, color="#e0e0e0")
    axes.set_axisbelow(True)
    frame(axes, "error / tolerance", "", "")
    save_small(axes.figure.figure, path)


def convergence(panels: Mapping[str, Sequence[Fall]], path: PathLike) -> None:
    """Draw errors over sizes with the slopes of theory.

    Parameters
    ----------
    panels
        Errors by quantity; one panel each.
    path
        File to save the figure in.
    """
    columns = min(len(panels), 2)
    rows = -(-len(panels) // columns)
    lines = max(len(many) for many in panels.values())
    grid = axes_grid(rows, columns, rows * (2.9 + 0.16 * lines))
    for axes, (name, falls) in zip(grid, panels.items(), strict=False):
        for number, fall in enumerate(falls):
            _fall(axes, fall, CYCLE[number % len(CYCLE)], MARKERS[number % len(MARKERS)])
        _scales(axes)
        frame(axes, falls[0].x, "error", name)
        axes.legend(
            loc="upper left",
            bbox_to_anchor=(-0.02, -0.2),
            frameon=False,
            fontsize=SMALL - 1,
            handlelength=1.6,
            labelspacing=0.2,
        )
    for axes in grid[len(panels) :]:
        axes.set_axis_off()
    if columns == 1:
        grid[0].figure.figure.set_size_inches(4.4, rows * (2.9 + 0.16 * lines))
    save_small(grid[0].figure.figure, path)


def _fall(axes: "Axes", fall: Fall, colour: str, marker: str) -> None:
    """Errors, and the slope of theory dashed through the finest of them."""
    x, y = np.asarray(fall.sizes, dtype=float), np.asarray(fall.errors, dtype=float)
    order = np.argsort(x)
    x, y = x[order], y[order]
    axes.plot(x, y, color=colour, marker=marker, markersize=4, linewidth=1.1, label=fall.label)
    slope = y[0] * (x / x[0]) ** fall.theory
    axes.plot(x, slope, color=colour, linewidth=0.8, linestyle=(0, (4, 3)), alpha=0.7)


def _scales(axes: "Axes") -> None:
    """Logarithmic axes; the sizes themselves as ticks when they are few."""
    from matplotlib.ticker import NullLocator

    axes.set_xscale("log")
    axes.set_yscale("log")
    sizes = sorted({float(x) for line in axes.lines for x in np.asarray(line.get_xdata())})
    if 1 < len(sizes) <= 7 and sizes[-1] / sizes[0] < 100:
        axes.set_xticks(sizes, [f"{size:.3g}" for size in sizes])
        axes.xaxis.set_minor_locator(NullLocator())
    axes.grid(visible=True, which="major", linewidth=0.4, color="#e0e0e0")
    axes.set_axisbelow(True)
