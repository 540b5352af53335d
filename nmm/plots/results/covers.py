"""The manifold itself: mathematical cover, physical covers, elements (Shi 1991)."""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons
from nmm.errors import NmmError
from nmm.plots.canvas import PathLike, axes_grid, extent_of, fit_height, frame_plane, save
from nmm.plots.shapes import CRACK, draw_outline, fill

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from covers.cutting.cut_cells import CutCells
    from covers.mathematical.base import Cover

COLOURS = ("#4477aa", "#ee8866", "#bbcc33", "#aa3377", "#44bb99", "#eedd88", "#222255", "#77aadd")
"""Physical covers, neighbours of one patch in colours far apart."""
PALE = ("#e8e4d9", "#dbe4ee", "#efe0cf", "#dfe9da", "#eadfe6", "#f4edd3")
"""Elements."""
MATERIAL, NET = "#ddd8cb", "#8a98a8"


def covers(laid: "Cover", cut: "CutCells", *, path: PathLike | None = None) -> "list[Axes]":
    """Draw a cut cover in three pictures, one below the other.

    The net of the mathematical cover over the material; physical covers of patches that do not
    overlap, each in one colour, so that a patch cut in two is in two colours; the elements.

    Parameters
    ----------
    laid, cut
        The mathematical cover and what the cut made of it.
    path
        File to save the figure in.

    Raises
    ------
    NmmError
        When nothing is covered.
    """
    if not len(cut.elements):
        raise NmmError("picture of covers: no elements: expected material under the cover")
    panels = axes_grid(3, 1, 9.0)
    cells = laid.cells.take(np.unique(cut.element_cell))
    extent = extent_of(cut.elements.points, cells.points)
    _net(panels[0], laid, cut, cells, extent)
    chosen = apart(cut)
    _physical(panels[1], cut, chosen, extent)
    _elements(panels[2], cut, extent)
    fit_height(panels)
    save(panels[0], path)
    return panels


def apart(cut: "CutCells") -> Ints:
    """Physical covers (m,) of patches that share no element, those that are cut apart first."""
    parts = np.bincount(cut.cover_patch)
    taken: Bools = np.zeros(len(cut.elements), dtype=bool)
    element, slot = np.nonzero(cut.covers >= 0)
    patch = cut.cover_patch[cut.covers[element, slot]]
    order = np.argsort(patch, kind="stable")
    element, begin = element[order], np.searchsorted(patch[order], np.arange(len(parts) + 1))
    found = []
    for number in np.argsort(-parts, kind="stable"):  # each choice depends on those before
        mine = element[begin[number] : begin[number + 1]]
        if len(mine) and not taken[mine].any():
            taken[mine] = True
            found.append(number)
    return np.flatnonzero(np.isin(cut.cover_patch, found))


def _net(axes: "Axes", laid: "Cover", cut: "CutCells", cells: Polygons, extent: Floats) -> None:
    fill(axes, cut.elements, facecolors=MATERIAL, edgecolors=MATERIAL, linewidths=0.3)
    fill(axes, cells, facecolors="none", edgecolors=NET, linewidths=_width(len(cells)))
    _outline(axes, cut)
    used = len(np.unique(cut.cover_patch))
    frame_plane(axes, extent, f"mathematical cover: {used} patches with material")


def _physical(axes: "Axes", cut: "CutCells", chosen: Ints, extent: Floats) -> None:
    fill(axes, cut.elements, facecolors="#f1efe9", edgecolors="#dcd8cc", linewidths=0.3)
    first = np.searchsorted(cut.cover_patch, cut.cover_patch[chosen])
    # Colours of one patch follow one another, so its parts are never alike.
    start = np.unique(cut.cover_patch[chosen], return_inverse=True)[1] * 3
    colour = (start.ravel() + chosen - first) % len(COLOURS)
    element, slot = np.nonzero(np.isin(cut.covers, chosen))
    place = np.searchsorted(chosen, cut.covers[element, slot])
    fills = [COLOURS[number] for number in colour[place]]
    fill(
        axes,
        cut.elements.take(element),
        facecolors=fills,
        edgecolors="#ffffff",
        linewidths=0.3,
        alpha=0.85,
    )
    _outline(axes, cut)
    parted = int((np.bincount(cut.cover_patch) > 1).sum())
    frame_plane(
        axes,
        extent,
        f"{cut.n_covers} physical covers, {parted} patches cut apart (some that do not overlap)",
    )


def _elements(axes: "Axes", cut: "CutCells", extent: Floats) -> None:
    colour = [PALE[number % len(PALE)] for number in cut.element_body]
    fill(
        axes,
        cut.elements,
        facecolors=colour,
        edgecolors="#77736a",
        linewidths=_width(len(cut.elements)),
    )
    _outline(axes, cut)
    part = int((~cut.element_whole).sum())
    frame_plane(axes, extent, f"{len(cut.elements)} elements, {part} of them parts of cells")


def _outline(axes: "Axes", cut: "CutCells") -> None:
    """Edges of the material, faces of cracks and their tips."""
    draw_outline(axes, cut, crack_width=1.4)
    if len(cut.tips):
        axes.plot(*cut.tips.point.T, ls="", marker="o", ms=3.5, color=CRACK)


def _width(number: int) -> float:
    return float(np.clip(12.0 / np.sqrt(max(number, 1)), 0.15, 0.6))
