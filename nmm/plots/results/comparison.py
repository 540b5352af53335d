"""Runs of one scene side by side: displacement, stress, their differences, forces, curves."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats
from nmm.plots.canvas import BESIDE, SMALL, STYLE, WIDTH, PathLike, save
from nmm.plots.families import styles
from nmm.plots.results.compared import DrawnRun, contacts, cracks, curves, field

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BETWEEN = 0.3  # inches between rows, for ticks and a title
TICK = 0.2  # inches between numbers beside a picture


def comparison(
    runs: Sequence[DrawnRun],
    differences: Sequence[tuple[Floats, Floats]],
    extent: Floats,
    *,
    title: str = "",
    curve: tuple[str, str] = ("load_factor", "strain_energy"),
    path: PathLike | None = None,
) -> "list[Axes]":
    """Draw runs side by side on one scale, their differences from the first below.

    Parameters
    ----------
    runs
        The runs; the first is what the others are compared with.
    differences
        Images of displacement and stress of the difference of each other run from the first.
    extent
        (2, 2) corners of the images (m).
    title
        Above the figure.
    curve
        Columns of the history that ``x`` and ``y`` of the runs hold.
    path
        File to save the figure in.
    """
    touch = any(len(one.contact_vector) for one in runs)
    curved = any(len(one.x) > 1 for one in runs)
    broken = any(len(one.cracks) for one in runs)
    pictures = 2 + 2 * (len(differences) > 0) + broken + touch
    figure, panels = _panels(pictures, len(runs), extent, curved)
    looks = styles([one.family for one in runs], [one.method for one in runs])
    shades = [colour for colour, _ in looks]
    lines = iter(panels)
    displacements = [one.displacement for one in runs], [u for u, _ in differences]
    stresses = [one.stress for one in runs], [s for _, s in differences]
    field(lines, "displacement", "m", runs[0].name, *displacements, extent)
    field(lines, "von Mises stress", "Pa", runs[0].name, *stresses, extent)
    for axes, one, shade in zip(panels[0], runs, shades, strict=True):
        head = axes.annotate(one.name, (0, 1), (0, 15), "axes fraction", "offset points", wrap=True)
        head.set(color=shade, fontsize=9, fontweight="bold")
    if broken:
        cracks(next(lines), runs, shades, extent)
    if touch:
        contacts(next(lines), runs, shades, extent)
    _label_places(panels[:pictures])
    if curved:
        curves(panels[-1][0], runs, shades, curve)
    if title:
        figure.suptitle(title, fontsize=11, x=0.01, ha="left")
    drawn = [axes for row in panels for axes in row]
    save(drawn[0], path)
    return drawn


def _panels(
    rows: int, columns: int, extent: Floats, curves: bool
) -> "tuple[Any, list[list[Axes]]]":
    """Rows of equal pictures and, below, one wide panel for curves."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    wide = WIDTH * max(1.0, columns / 3)
    ratio = float((extent[1, 1] - extent[0, 1]) / (extent[1, 0] - extent[0, 0]))
    high = float(np.clip((wide - BESIDE) / columns * ratio, 0.6, 4.5)) + BETWEEN
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(wide, rows * high + 2.6 * curves + 0.9), layout="constrained")
        ratios = [high] * rows + [2.6] * curves
        lay = figure.add_gridspec(rows + curves, columns, height_ratios=ratios)
        panels = [[figure.add_subplot(lay[r, c]) for c in range(columns)] for r in range(rows)]
        if curves:
            panels.append([figure.add_subplot(lay[rows, :])])
    return figure, panels


def _label_places(rows: "Sequence[Sequence[Axes]]") -> None:
    """Say where things are: coordinates left of the first and below the last picture drawn."""
    wide = (rows[0][0].figure.figure.get_figwidth() - BESIDE) / len(rows[0])
    for number, row in enumerate(rows):
        for column, axes in enumerate(row):
            last, first = number == len(rows) - 1, column == (not row[0].axison)
            axes.tick_params(labelsize=SMALL - 1.5, labelbottom=last, labelleft=first)
            axes.locator_params(axis="x", nbins=4)
            (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
            tall = wide * (high - low) / (right - left)
            axes.locator_params(axis="y", nbins=int(np.clip(tall / TICK, 1, 4)))
            axes.set_xlabel("x  (m)" if last else "", fontsize=SMALL - 1)
            axes.set_ylabel("y  (m)" if not column else "", fontsize=SMALL - 1)
            for side in ("top", "right"):
                axes.spines[side].set_visible(False)
