"""Several meshes in one model, each over bodies of its own: the separate cuts are merged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from covers.concatenate import concatenate, starts
from covers.cutting.cut_cells import CutCells
from covers.mathematical.base import Cover
from integration.arrays import Ints


def joined_cover(nets: Sequence[Cover]) -> Cover:
    """Return the cells and patches of all meshes, one after the other; they may overlap.

    Raises
    ------
    ValueError
        Meshes are of different types.
    """
    first = nets[0]
    if any(type(net) is not type(first) for net in nets):
        names = ", ".join(sorted({type(net).__name__ for net in nets}))
        raise ValueError(f"nets: {names}: one kind expected: use one type of mesh for all blocks")
    offsets = {
        "patch": starts([net.n_patches for net in nets]),
        "vertex": starts([len(net.vertices) for net in nets]),
        "shape": starts([int(net.cell_shape.max(initial=-1)) + 1 for net in nets]),
    }
    return concatenate(nets, offsets)


def joined_cut(
    nets: Sequence[Cover], cuts: Sequence[CutCells], regions: Sequence[Ints]
) -> CutCells:
    """Return the cuts of all meshes as one of their joined cover, with bodies by region.

    Parameters
    ----------
    nets, cuts
        The meshes and their cuts.
    regions
        Numbers in the model of the regions of each cut.
    """
    pairs = list(zip(regions, cuts, strict=True))
    offsets = {
        "cell": starts([len(net.cell_vertices) for net in nets]),
        "patch": starts([net.n_patches for net in nets]),
        "element": starts([len(part.elements) for part in cuts]),
        "cover": starts([part.n_covers for part in cuts]),
        "body": starts([part.n_bodies for part in cuts]),
        "edge": starts([len(part.boundary) for part in cuts]),
    }
    whole = concatenate(
        cuts,
        offsets,
        element_region=np.concatenate([own[part.element_region] for own, part in pairs]),
        cover_region=np.concatenate([own[part.cover_region] for own, part in pairs]),
        step=max(part.step for part in cuts),
        crack_tolerance=max(part.crack_tolerance for part in cuts),
        slivers=sum(part.slivers for part in cuts),
        sliver_area=sum(part.sliver_area for part in cuts),
    )
    number = _in_order_of_regions(whole)
    return replace(
        whole,
        element_body=number[whole.element_body],
        cover_body=number[whole.cover_body],
        boundary=replace(whole.boundary, body=number[whole.boundary.body]),
    )


def _in_order_of_regions(cut: CutCells) -> Ints:
    """New number of each body, by region, then by its number in the cut."""
    region = np.empty(cut.n_bodies, dtype=np.int64)
    region[cut.element_body] = cut.element_region
    number = np.empty_like(region)
    number[np.argsort(region, kind="stable")] = np.arange(len(region))
    return number
