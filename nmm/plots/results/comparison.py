"""Runs of one scene side by side: displacement, stress, their differences, forces, curves."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats
from nmm.plots.canvas import SMALL, STYLE, WIDTH, PathLike, frame, save
from nmm.plots.families import styles
from nmm.plots.units import label, prefixed, unit_of, words_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDEST = 3.0  # points, of the largest contact force
SMALLEST = 0.01  # of the largest force; below, nothing is drawn
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
    compared = len(differences) > 0
    fields = 2 + 2 * compared
    figure, panels = _panels(fields + broken + contacts, len(runs), extent, curves)
    looks = styles([one.family for one in runs], [one.method for one in runs])
    shades = [colour for colour, _ in looks]
    rows: list[tuple[str, str, list[Floats], list[Floats]]] = [
        ("displacement", "m", [one.displacement for one in runs], [u for u, _ in differences]),
        ("von Mises stress", "Pa", [one.stress for one in runs], [s for _, s in differences]),
    ]
    lines = iter(panels)
    for words, unit, images, others in rows:
        limit = _images(next(lines), images, extent, words, unit, None)
        if compared:
            first, *row = next(lines)
            first.set_visible(False)
            _images(row, others, extent, f"less that of {runs[0].name}", unit, limit)
    for axes, one, shade in zip(panels[0], runs, shades, strict=True):
        axes.set_title(one.name, loc="left", fontsize=9, color=shade, fontweight="bold", wrap=True)
    if broken:
        _cracks(next(lines), runs, shades, extent)
    if contacts:
        _contacts(next(lines), runs, shades, extent)
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
    # Coordinates and a colour bar lie below each picture.
    high = float(np.clip(wide / columns * ratio, 0.6, 4.5)) + 1.1
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(wide, rows * high + 2.6 * curves + 0.4), layout="constrained")
        ratios = [high] * rows + [2.6] * curves
        lay = figure.add_gridspec(rows + curves, columns, height_ratios=ratios)
        panels = [[figure.add_subplot(lay[r, c]) for c in range(columns)] for r in range(rows)]
        if curves:
            panels.append([figure.add_subplot(lay[rows, :])])
    return figure, panels


def _images(
    row: "Sequence[Axes]",
    images: Sequence[Floats],
    extent: Floats,
    words: str,
    unit: str,
    size: float | None,
) -> float:
    """Draw images on one scale, about zero when ``size`` of the fields is given; return its end."""
    if not images:
        return 0.0
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
            cmap="viridis" if size is None else "RdBu_r",
            vmin=0.0 if size is None else -factor * limit,
            vmax=factor * limit,
            interpolation="nearest",
        )
        share = "" if not size else f"\n{float(f'{100 * limit / size:.2g}'):g} % of the scale above"
        bar = axes.figure.colorbar(drawn, ax=axes, orientation="horizontal", shrink=0.9, pad=0.03)
        bar.set_label(f"{words}  ({unit_text}){share}", fontsize=SMALL - 1)
        bar.ax.tick_params(labelsize=SMALL - 1.5)
    _label_places(row)
    return limit


def _label_places(row: "Sequence[Axes]") -> None:
    """Say where things are: coordinates below each picture, and left of the first of a row."""
    for number, axes in enumerate(row):
        axes.tick_params(labelsize=SMALL - 1.5)
        axes.locator_params(nbins=4)
        axes.set_xlabel("x  (m)", fontsize=SMALL - 1)
        if not number:
            axes.set_ylabel("y  (m)", fontsize=SMALL - 1)
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
    _label_places(row)
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
