"""What is drawn of compared runs: fields and their differences, what broke, forces, curves."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.plots.canvas import SMALL, frame
from nmm.plots.units import label, prefixed, unit_of, words_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDEST = 3.0  # points, of the largest contact force
SMALLEST = 0.01  # of the largest force; below, nothing is drawn
BAR = (1.03, 0.0, 0.03, 1.0)  # corner and size of a row's scale, of those of its last picture
ROUNDING = 1e-8  # of the fields, a tolerance of solutions: smaller differences have no picture
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


def field(
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
    limit, unit_text = _images(row, images, extent, unit, 0.0, signed=False)
    row[0].set_title(label(words, unit_text), loc="left", fontsize=SMALL - 1)
    if others:
        corner, *row = next(lines)
        most, unit_text = _images(row, others, extent, unit, ROUNDING * limit, signed=True)
        share = f"{float(f'{100 * most / limit:.2g}'):g} % of the scale above"
        if most <= ROUNDING * limit:
            share = f"no more than\n{share}"
        text = f"{words}\nless that of\n{label(first, unit_text)}\n{share}"
        corner.set_axis_off()
        told = corner.text(0.5, 0.5, text, transform=corner.transAxes, fontsize=SMALL - 1)
        told.set(ha="center", va="center")


def _images(
    row: "Sequence[Axes]",
    images: Sequence[Floats],
    extent: Floats,
    unit: str,
    least: float,
    *,
    signed: bool,
) -> tuple[float, str]:
    """Draw images on one scale, about zero where they are signed; return its end and unit.

    The scale does not end below ``least``.
    """
    values = np.abs(np.concatenate([image.ravel() for image in images]))
    values = values[np.isfinite(values)]
    limit = float(np.percentile(values, SHARE)) if len(values) else 1.0
    limit = max(limit, least) or 1.0
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


def cracks(
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


def contacts(
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


def curves(
    axes: "Axes", runs: Sequence[DrawnRun], shades: Sequence[str], curve: tuple[str, str]
) -> None:
    """Draw a column of the histories over another."""
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
