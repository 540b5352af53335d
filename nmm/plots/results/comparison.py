"""Runs of one scene side by side: displacement, stress, their differences, forces, curves."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats
from nmm.plots.canvas import BESIDE, SMALL, STYLE, WIDTH, PathLike, frame, save
from nmm.plots.families import styles
from nmm.plots.units import label, prefixed, unit_of, words_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDEST = 3.0  # points, of the largest contact force
SMALLEST = 0.01  # of the largest force; below, nothing is drawn
BAR = (1.03, 0.0, 0.03, 1.0)  # corner and size of a row's scale, of those of its last picture
BETWEEN = 0.3  # inches between rows, for ticks and a title
SHARE = 99.5  # percent of the stresses that the scale holds: singular corners would swallow it


@dataclass(frozen=True)
class DrawnRun:
    """What is drawn of one run.

    Attributes
    ----------
    name, family, method
        Name of the formulation; "DDA" or "manifold"; the cover with its degree, "triangles 1".
    displacement, stress
        Images of the size of displacement (m) and of the von Mises stress (Pa).
    contact_position, contact_vector
        (C, 2) m and N.
    cracks
        Lines (n, 2) of what broke (m).
    x, y
        Curve of a history column.
    """

    name: str
    family: str
    method: str
    displacement: Floats
    stress: Floats
    contact_position: Floats
    contact_vector: Floats
    cracks: Sequence[Floats]
    x: Floats
    y: Floats


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
    contacts = any(len(one.contact_vector) for one in runs)
    curves = any(len(one.x) > 1 for one in runs)
    broken = any(len(one.cracks) for one in runs)
    pictures = 2 + 2 * (len(differences) > 0) + broken + contacts
    figure, panels = _panels(pictures, len(runs), extent, curves)
    looks = styles([one.family for one in runs], [one.method for one in runs])
    shades = [colour for colour, _ in looks]
    lines = iter(panels)
    displacements = [one.displacement for one in runs], [u for u, _ in differences]
    stresses = [one.stress for one in runs], [s for _, s in differences]
    _field(lines, "displacement", "m", runs[0].name, *displacements, extent)
    _field(lines, "von Mises stress", "Pa", runs[0].name, *stresses, extent)
    for axes, one, shade in zip(panels[0], runs, shades, strict=True):
        head = axes.annotate(one.name, (0, 1), (0, 15), "axes fraction", "offset points", wrap=True)
        head.set(color=shade, fontsize=9, fontweight="bold")
    if broken:
        _cracks(next(lines), runs, shades, extent)
    if contacts:
        _contacts(next(lines), runs, shades, extent)
    _label_places(panels[:pictures])
    if curves:
        _curves(panels[-1][0], runs, shades, curve)
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


def _field(
    lines: "Iterator[Sequence[Axes]]",
    words: str,
    unit: str,
    first: str,
    images: Sequence[Floats],
    others: Sequence[Floats],
    extent: Floats,
) -> None:
    """Draw a field of all runs, and below it, where given, its differences from the first run."""
    row = next(lines)
    limit, unit_text = _images(row, images, extent, unit, signed=False)
    row[0].set_title(label(words, unit_text), loc="left", fontsize=SMALL - 1)
    if others:
        corner, *row = next(lines)
        most, unit_text = _images(row, others, extent, unit, signed=True)
        share = float(f"{100 * most / limit:.2g}")
        text = f"{words}\nless that of\n{label(first, unit_text)}\n{share:g} % of the scale above"
        corner.set_axis_off()
        told = corner.text(0.5, 0.5, text, transform=corner.transAxes, fontsize=SMALL - 1)
        told.set(ha="center", va="center")


def _images(
    row: "Sequence[Axes]",
    images: Sequence[Floats],
    extent: Floats,
    unit: str,
    *,
    signed: bool,
) -> tuple[float, str]:
    """Draw images on one scale, about zero where they are signed; return its end and unit."""
    values = np.abs(np.concatenate([image.ravel() for image in images]))
    values = values[np.isfinite(values)]
    limit = float(np.percentile(values, SHARE)) if len(values) else 1.0
    limit = limit or 1.0
    factor, unit_text = prefixed(np.array([limit]), unit)
    box = (extent[0, 0], extent[1, 0], extent[0, 1], extent[1, 1])
    for axes, image in zip(row, images, strict=True):
        drawn = axes.imshow(
            factor * image,
            origin="lower",
            extent=box,
            cmap="RdBu_r" if signed else "viridis",
            vmin=-factor * limit if signed else 0.0,
            vmax=factor * limit,
            interpolation="nearest",
        )
    bar = row[-1].figure.colorbar(drawn, cax=row[-1].inset_axes(BAR))
    bar.ax.tick_params(labelsize=SMALL - 1.5)
    return limit, unit_text


def _label_places(rows: "Sequence[Sequence[Axes]]") -> None:
    """Say where things are: coordinates left of the first and below the last picture drawn."""
    for number, row in enumerate(rows):
        for column, axes in enumerate(row):
            last, first = number == len(rows) - 1, column == (not row[0].axison)
            axes.tick_params(labelsize=SMALL - 1.5, labelbottom=last, labelleft=first)
            axes.locator_params(nbins=4)
            axes.set_xlabel("x  (m)" if last else "", fontsize=SMALL - 1)
            axes.set_ylabel("y  (m)" if not column else "", fontsize=SMALL - 1)
            for side in ("top", "right"):
                axes.spines[side].set_visible(False)


def _cracks(
    row: "Sequence[Axes]", runs: Sequence[DrawnRun], shades: Sequence[str], extent: Floats
) -> None:
    """Draw what broke over the outline of what is drawn above."""
    from matplotlib.collections import LineCollection

    for axes, one, shade in zip(row, runs, shades, strict=False):
        box = (extent[0, 0], extent[1, 0], extent[0, 1], extent[1, 1])
        inside = np.isfinite(one.displacement)
        axes.imshow(inside, origin="lower", extent=box, cmap="Greys", vmin=0, vmax=8)
        axes.add_collection(LineCollection(list(one.cracks), colors=shade, linewidths=1.6))
        axes.set_title("what broke", loc="left", fontsize=SMALL - 1)
    _frame_pictures(row, extent)


def _contacts(
    row: "Sequence[Axes]", runs: Sequence[DrawnRun], shades: Sequence[str], extent: Floats
) -> None:
    """Draw contact forces as lines along the force, their width its size, on one scale."""
    from matplotlib.collections import LineCollection

    sizes = [np.hypot(*one.contact_vector.T) for one in runs]
    largest = max((float(size.max(initial=0.0)) for size in sizes), default=0.0) or 1.0
    reach = 0.025 * float(np.hypot(*(extent[1] - extent[0])))
    factor, unit = prefixed(np.array([largest]), "N")
    for axes, one, size, shade in zip(row, runs, sizes, shades, strict=False):
        kept = size > SMALLEST * largest
        arms = reach * one.contact_vector[kept] / size[kept, None]
        middle = one.contact_position[kept]
        axes.add_collection(
            LineCollection(
                list(np.stack([middle - arms, middle + arms], axis=1)),
                colors=shade,
                linewidths=WIDEST * size[kept] / largest,
            )
        )
        axes.set_title(
            f"contact forces, largest {factor * float(size.max(initial=0.0)):.3g} {unit}",
            loc="left",
            fontsize=SMALL - 1,
        )
    _frame_pictures(row, extent)


def _frame_pictures(row: "Sequence[Axes]", extent: Floats) -> None:
    """Give pictures of lines the frame of the images above them."""
    for axes in row:
        axes.set_aspect("equal")
        axes.set(xlim=extent[:, 0], ylim=extent[:, 1])


def _curves(
    axes: "Axes", runs: Sequence[DrawnRun], shades: Sequence[str], curve: tuple[str, str]
) -> None:
    x_unit, y_unit = (unit_of(name) for name in curve)
    x_factor, x_unit = prefixed(np.concatenate([one.x for one in runs]), x_unit)
    y_factor, y_unit = prefixed(np.concatenate([one.y for one in runs]), y_unit)
    for one, shade in zip(runs, shades, strict=True):
        dots = "o" if len(one.x) <= 60 else ""
        axes.plot(
            x_factor * one.x,
            y_factor * one.y,
            color=shade,
            linewidth=1.2,
            marker=dots,
            markersize=3,
            label=one.name,
        )
    axes.grid(visible=True, color="#e6e6e6", linewidth=0.6)
    axes.legend(frameon=False, fontsize=SMALL)
    frame(axes, label(words_of(curve[0]), x_unit), label(words_of(curve[1]), y_unit), "")
