"""Removal of discs with too little material, and enlargement of others.

If only the rim of the kernel of a disc lies in the material, integration hardly sees its function:
its stiffness is rounding, and a load moves it by kilometres. As moving least squares need no
particular disc, such a disc is removed, for each part where cracks divide it, and the fit uses the
others. Where these do not determine it well, they are enlarged.

The measure of a disc is its *share*: the integral of its squared kernel over the material over that
over the whole disc. A disc is removed if its share is below `POOR` of the largest share among the
discs that it overlaps, so that a body thinner than the discs keeps the best of them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from covers.mathematical.meshless.disc_cover import DiscCover
from covers.mathematical.meshless.kernels import kernel
from integration.arrays import Bools, Floats
from integration.rules import polygon_rule

if TYPE_CHECKING:
    from covers.cutting.cut_cells import CutCells

# A disc is removed if its share is below this part of the largest about it, by degree of the basis.
# Each removed disc makes a coarse grid stiffer, but functions on Shepard weights need larger
# shares.
POOR = {0: 0.05, 1: 1e-3, 2: 1e-3, 3: 1e-3}
# Degree of the quadrature of shares.
ORDER = 8
# Points whose kernels are kept in memory at once.
KERNELS_AT_ONCE = 20_000

Discs = TypeVar("Discs", bound=DiscCover)


def fitted_discs(cover: Discs, cut: CutCells) -> tuple[Discs, CutCells]:
    """Return cover and cut without discs of too little material.

    Elements of a cell that lose different discs get cells of their own.
    """
    share = shares(cover, cut)
    known = np.append(share, -1.0)
    best = known[cut.covers].max(axis=1)
    around = np.zeros(len(share) + 1)
    np.maximum.at(around, cut.covers, np.broadcast_to(best[:, None], cut.covers.shape))
    lost = share < POOR[cover.degree] * around[:-1]
    if not lost.any():
        return cover, cut
    gone = (cut.covers >= 0) & np.append(lost, False)[cut.covers]
    key = np.column_stack([cut.element_cell, gone])
    _, first, cell = np.unique(key, axis=0, return_index=True, return_inverse=True)
    source = cut.element_cell[first]
    patches = np.where(gone[first], -1, cover.cell_patches[source])
    number = np.append(np.where(lost, -1, np.cumsum(~lost) - 1), -1)
    kept = replace(
        cover,
        cell_vertices=cover.cell_vertices[source],
        cell_patches=patches,
        cell_shape=np.where(gone[first].any(axis=1), -1, cover.cell_shape[source]),
        left_out=int(lost.sum()),
    )
    return kept, replace(
        cut,
        element_cell=cell.ravel(),
        cell_width=cut.cell_width[source],
        covers=number[cut.covers],
        cover_patch=cut.cover_patch[~lost],
        cover_region=cut.cover_region[~lost],
        cover_body=cut.cover_body[~lost],
    )


def shares(cover: DiscCover, cut: CutCells) -> Floats:
    """Integral (P,) of the squared kernel over the material by that over the whole disc."""
    total = np.zeros(cut.n_covers + 1)
    rule = polygon_rule(cut.elements, ORDER)
    for first in range(0, len(rule.points), KERNELS_AT_ONCE):  # so many points in memory
        part = slice(first, first + KERNELS_AT_ONCE)
        element = rule.owner[part]
        values = cover.kernels(cut.element_cell[element], rule.points[part])
        np.add.at(total, cut.covers[element], rule.weights[part, None] * values**2)
    return np.asarray(total[:-1] / (cover.radius[cut.cover_patch] ** 2 * _disc(cover.kernel)))


def _disc(name: str) -> float:
    """Integral of the squared kernel over a disc of radius one."""
    at, weight = np.polynomial.legendre.leggauss(20)
    total = 0.0
    for low in (0.0, 0.5):  # spline kernels are piecewise, with a knot at half the radius
        r = low + (at + 1) / 4
        total += float(np.sum(weight / 4 * 2 * np.pi * r * kernel(name)(r)[0] ** 2))
    return total


def undetermined_discs(cover: DiscCover, cut: CutCells) -> Bools:
    """Return the discs (N,) whose fit is ill-determined at points of some element."""
    found = np.zeros(cover.n_patches + 1, dtype=bool)
    rule = polygon_rule(cut.elements, ORDER)
    points = np.concatenate([rule.points, cut.elements.points])
    owner = np.concatenate([rule.owner, cut.elements.polygon_of_point])
    for first in range(0, len(points), KERNELS_AT_ONCE):  # so many points in memory
        part = slice(first, first + KERNELS_AT_ONCE)
        cells = cut.element_cell[owner[part]]
        found[cover.cell_patches[cells[~cover.determined(cells, points[part])]]] = True
    return np.asarray(found[:-1])
