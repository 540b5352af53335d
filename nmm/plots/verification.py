"""Errors of benchmarks over what is allowed."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from nmm.plots.canvas import SMALL, PathLike, axes_grid, frame, save

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PASSED, MISSED = "#2a7f62", "#c1121f"
LEAST = 1e-6  # shares below are drawn here


def margins(names: Sequence[str], shares: Sequence[float], path: PathLike | None = None) -> "Axes":
    """Draw error over tolerance, one row a quantity; right of 1 it is missed.

    Parameters
    ----------
    names
        One a quantity.
    shares
        Error over tolerance; nan and inf are drawn at the right edge.
    path
        File to save the figure in.
    """
    axes = axes_grid(1, 1, 1.0 + 0.17 * len(names))[0]
    values = np.nan_to_num(np.asarray(shares, dtype=float), nan=1e3, posinf=1e3)
    drawn = np.clip(values, LEAST, 1e3)
    rows = np.arange(len(names))
    colours = [MISSED if value > 1 else PASSED for value in values]
    axes.hlines(rows, LEAST / 2, drawn, color="#dddddd", linewidth=0.8)
    axes.scatter(drawn, rows, c=colours, s=14, zorder=3)
    axes.axvline(1.0, color=MISSED, linewidth=0.8)
    axes.set_xscale("log")
    axes.set_xlim(LEAST / 2, 2e3 if (values > 1).any() else 3.0)
    axes.set_yticks(rows, list(names), fontsize=SMALL - 2.5)
    axes.set_ylim(len(names) - 0.5, -0.5)
    frame(axes, "error / tolerance", "", "benchmarks: how near to what is allowed")
    save(axes, path)
    return axes
