"""Figures and axes: made without pyplot, so that no window system and no global state is needed."""

import io
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.results.storage.writing import told, write_bytes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDTH = 7.0  # inches, about the text width of a page
RESOLUTION = 200  # dots an inch
SMALL = 8.5  # points
BESIDE = 0.9  # inches of the width that labels take
ABOVE = 0.75  # inches of a panel's height that title and labels take
TALLEST = 8.0  # inches of a picture of the plane
HANDLE, LETTER = 26.0, 4.2  # points of a legend that a sign and its gaps take, and a letter
BELOW_TICKS, BELOW_LABEL = 19.0, 33.0  # points below the axes at which legends begin

STYLE: Any = {
    "font.size": 9.0,
    "axes.linewidth": 0.6,
    "axes.edgecolor": "#555555",
    "axes.labelcolor": "#222222",
    "xtick.color": "#555555",
    "ytick.color": "#555555",
    "xtick.labelcolor": "#222222",
    "ytick.labelcolor": "#222222",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
}

PathLike = str | os.PathLike[str]


def axes_grid(rows: int, columns: int, height: float) -> "list[Axes]":
    """Return the axes of a new figure of so many rows and columns, row by row."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, height), layout="constrained")
        return list(figure.subplots(rows, columns, squeeze=False).ravel())


def fit_height(panels: "Sequence[Axes]", beside: float = BESIDE) -> None:
    """Give the figure of stacked pictures of the plane the height that their limits ask for.

    Parameters
    ----------
    panels
        The axes, all of one figure.
    beside
        Inches that labels and a colour bar take of the width.
    """
    height = 0.0
    for axes in panels:
        (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
        tall = (WIDTH - beside) * (high - low) / (right - left)
        legend = axes.get_legend()
        names = [] if legend is None else [text.get_text() for text in legend.get_texts()]
        below = 0.0 if _fit_beside(axes, names) else (BELOW_LABEL - BELOW_TICKS) / 72
        height += float(np.clip(tall, 0.8, TALLEST)) + ABOVE + below
    panels[0].figure.figure.set_size_inches(WIDTH, height)


def frame_plane(axes: "Axes", extent: Floats, title: str) -> None:
    """Give a picture of the plane equal scales, limits with a margin, labels and a title.

    Parameters
    ----------
    axes
        The axes.
    extent
        (2, 2) lower left and upper right corner of what is drawn, m.
    title
        The title.
    """
    limit_plane(axes, extent)
    frame(axes, "x  (m)", "y  (m)", title)


def limit_plane(axes: "Axes", extent: Floats) -> None:
    """Give axes equal scales and limits with a margin around an extent (2, 2), m."""
    margin = 0.03 * float(np.max(extent[1] - extent[0]))
    axes.set_aspect("equal")
    axes.set_xlim(extent[0, 0] - margin, extent[1, 0] + margin)
    axes.set_ylim(extent[0, 1] - margin, extent[1, 1] + margin)


def frame(axes: "Axes", x_text: str, y_text: str, title: str) -> None:
    """Label axes and leave the right and upper line out."""
    axes.set_xlabel(x_text)
    axes.set_ylabel(y_text)
    axes.set_title(title, loc="left", fontsize=10.0)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def legend_below(axes: "Axes", handles: Sequence[Any]) -> None:
    """Put a legend below the axes: at the right of the axis label, or under it where it is long."""
    from matplotlib.transforms import ScaledTranslation

    if not handles:
        return
    names = [handle.get_label() for handle in handles]
    below = BELOW_TICKS if _fit_beside(axes, names) else BELOW_LABEL
    down = ScaledTranslation(0, -below / 72, axes.figure.figure.dpi_scale_trans)
    axes.legend(
        handles=handles,
        ncols=min(len(names), max(1, int(_room(axes) // max(_widths(names))))),
        loc="upper right",
        bbox_to_anchor=(1.0, 0.0),
        bbox_transform=axes.transAxes + down,
        borderaxespad=0.0,
        borderpad=0.0,
        columnspacing=1.2,
        handlelength=1.4,
        frameon=False,
        fontsize=SMALL,
    )


def _fit_beside(axes: "Axes", names: Sequence[str]) -> bool:
    """Whether a legend of so many names has room at the right of the axis label."""
    return sum(_widths(names)) < (_room(axes) - LETTER * len(axes.get_xlabel())) / 2


def _widths(names: Sequence[str]) -> list[float]:
    """Points that names take in a legend, with their signs."""
    return [HANDLE + LETTER * len(name) for name in names]


def _room(axes: "Axes") -> float:
    """Points that a picture of the plane is wide."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    return min(WIDTH - BESIDE, TALLEST * (right - left) / (high - low)) * 72


def colour_bar(axes: "Axes", drawn: Any, text: str, arrows: str = "neither") -> None:
    """Put a bar beside a picture that says what its colours are; ``arrows``: ends that go on."""
    bar = axes.figure.colorbar(drawn, ax=axes, pad=0.02, fraction=0.05, aspect=15, extend=arrows)
    bar.set_label(text, fontsize=9.0)
    bar.ax.tick_params(labelsize=9.0, width=0.6)
    bar.outline.set_visible(False)


def extent_of(*points: Floats) -> Floats:
    """(2, 2) lower left and upper right corner of all points."""
    together = np.concatenate(points)
    return np.stack([together.min(axis=0), together.max(axis=0)])


def size_of(polygons: Polygons) -> float:
    """Diagonal of the box around all polygons, m."""
    return float(np.hypot(*np.diff(extent_of(polygons.points), axis=0)[0]))


def finished(
    axes: "Axes", path: PathLike | None, *, fit: bool = False, beside: float = BESIDE
) -> "Axes":
    """Save a picture when a path is given, a new figure of the plane fitted to it; the axes."""
    if fit:
        fit_height([axes], beside)
    save(axes, path)
    return axes


def save(axes: "Axes", path: PathLike | None) -> None:
    """Write the figure of the axes when a path is given; folders are made when missing."""
    if path is None:
        return
    target = Path(path)
    kind = target.suffix.removeprefix(".") or "png"
    figure, picture = axes.figure.figure, io.BytesIO()
    if kind == "png":
        _draw_once(figure, picture)
    else:
        figure.savefig(picture, dpi=RESOLUTION, format=kind)
    with told(target.parent):
        target.parent.mkdir(parents=True, exist_ok=True)
    write_bytes(target, picture.getvalue())


def _draw_once(figure: "Figure", picture: io.BytesIO) -> None:
    """Write a figure as PNG.

    `Figure.savefig` draws one that has a layout twice, the first time for the layout alone, which
    measures all texts by itself. Nothing shines through, so that three channels are enough.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    figure.set_dpi(RESOLUTION)
    canvas, layout = FigureCanvasAgg(figure), figure.get_layout_engine()
    if layout is not None:
        layout.execute(figure)
    figure.set_layout_engine("none")
    canvas.draw()  # type: ignore[no-untyped-call]
    figure.set_layout_engine(layout)
    pixels = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
    shown = Image.fromarray(pixels[..., :3])
    # Harder pressed they are a fifth smaller and take half as long again.
    shown.save(picture, format="png", dpi=(RESOLUTION, RESOLUTION), compress_level=3)
