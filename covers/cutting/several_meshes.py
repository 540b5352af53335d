"""Several nets in one model, each over bodies of its own: what was cut apart becomes one cut."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from covers.cutting.cut_boundary import CrackTips, CutBoundary
from covers.cutting.cut_cells import CutCells
from covers.mathematical.polynomial_cover import PolynomialCover
from integration.arrays import Ints
from integration.polygons import Polygons


def joined_cover(nets: Sequence[PolynomialCover]) -> PolynomialCover:
    """Return the cells and patches of all nets, one net after the other; they may overlap.

    Raises
    ------
    ValueError
        Nets of different kinds.
    """
    first = nets[0]
    if any(type(net) is not type(first) for net in nets):
        names = ", ".join(sorted({type(net).__name__ for net in nets}))
        raise ValueError(f"nets: {names}: one kind expected: use one type of mesh for all blocks")
    patch = _starts([net.n_patches for net in nets])
    vertex = _starts([len(net.vertices) for net in nets])
    shape = _starts([int(net.cell_shape.max(initial=-1)) + 1 for net in nets])

    def shifted(name: str, by: Ints) -> Ints:
        parts = (getattr(net, name) for net in nets)
        moved = [np.where(part >= 0, part + n, -1) for part, n in zip(parts, by, strict=True)]
        return np.concatenate(moved)

    return replace(
        first,
        vertices=np.concatenate([net.vertices for net in nets]),
        patch_centre=np.concatenate([net.patch_centre for net in nets]),
        patch_size=np.concatenate([net.patch_size for net in nets]),
        cell_origin=np.concatenate([net.cell_origin for net in nets]),
        cell_matrix=np.concatenate([net.cell_matrix for net in nets]),
        cell_vertices=shifted("cell_vertices", vertex),
        cell_patches=shifted("cell_patches", patch),
        cell_shape=shifted("cell_shape", shape),
    )


def joined_cut(
    nets: Sequence[PolynomialCover], cuts: Sequence[CutCells], regions: Sequence[Ints]
) -> CutCells:
    """Return the cuts of all nets as one, of their joined cover; bodies in the order of regions.

    Parameters
    ----------
    nets, cuts
        What was cut, and how.
    regions
        The regions, by their number in the model, that each cut was given.
    """
    cell = _starts([len(net.cell_vertices) for net in nets])
    patch = _starts([net.n_patches for net in nets])
    element = _starts([len(part.elements) for part in cuts])
    cover = _starts([part.n_covers for part in cuts])
    body_start = _starts([part.n_bodies for part in cuts])
    edge = _starts([len(part.boundary) for part in cuts])
    region = np.concatenate(
        [own[part.element_region] for own, part in zip(regions, cuts, strict=True)]
    )
    body = _shifted([part.element_body for part in cuts], body_start)
    # Bodies stand in the order of their regions, and within a region in that of its cut.
    of_body = np.empty(int(body.max()) + 1, dtype=np.int64)
    of_body[body] = region
    order = np.argsort(of_body, kind="stable")
    number = np.empty_like(order)
    number[order] = np.arange(len(order))
    boundaries, tips = [part.boundary for part in cuts], [part.tips for part in cuts]
    return CutCells(
        elements=Polygons.concatenate([part.elements for part in cuts]),
        element_cell=_shifted([part.element_cell for part in cuts], cell),
        element_region=region,
        element_body=number[body],
        element_whole=np.concatenate([part.element_whole for part in cuts]),
        covers=_shifted([part.covers for part in cuts], cover),
        cover_patch=_shifted([part.cover_patch for part in cuts], patch),
        cover_region=np.concatenate(
            [own[part.cover_region] for own, part in zip(regions, cuts, strict=True)]
        ),
        cover_body=number[_shifted([part.cover_body for part in cuts], body_start)],
        boundary=CutBoundary(
            start=np.concatenate([part.start for part in boundaries]),
            end=np.concatenate([part.end for part in boundaries]),
            element=_shifted([part.element for part in boundaries], element),
            body=number[_shifted([part.body for part in boundaries], body_start)],
            next=_shifted([part.next for part in boundaries], edge),
            previous=_shifted([part.previous for part in boundaries], edge),
            crack=np.concatenate([part.crack for part in boundaries]),
            opposite=_shifted([part.opposite for part in boundaries], edge),
        ),
        tips=CrackTips(
            np.concatenate([part.point for part in tips]),
            np.concatenate([part.direction for part in tips]),
            _shifted([part.element for part in tips], element),
            np.concatenate([part.crack for part in tips]),
        ),
        step=max(part.step for part in cuts),
        crack_tolerance=max(part.crack_tolerance for part in cuts),
        slivers=sum(part.slivers for part in cuts),
        sliver_area=sum(part.sliver_area for part in cuts),
    )


def _starts(counts: Sequence[int]) -> Ints:
    return np.cumsum([0, *counts])[:-1]


def _shifted(parts: Sequence[Ints], by: Ints) -> Ints:
    """All parts with their numbers raised; -1 stays."""
    moved = [np.where(part >= 0, part + n, -1) for part, n in zip(parts, by, strict=True)]
    return np.concatenate(moved)
