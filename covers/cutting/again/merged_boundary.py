"""Boundary edges and crack tips of an updated cut: merged from kept and new ones."""

from __future__ import annotations

import numpy as np

from covers.cutting.again.merged_elements import MergedElements
from covers.cutting.cut_boundary import CrackTips, CutBoundary
from integration.arrays import Ints
from integration.permutations import inverse

# Fields that link edges.
LINKS = ("next", "previous", "opposite")


def merged_boundary(
    old: CutBoundary, local: CutBoundary, parts: MergedElements
) -> CutBoundary | None:
    """Merge edges, with bodies yet to be filled in; None if they cannot be linked."""
    stays = np.flatnonzero(parts.kept[old.element] >= 0)
    new = np.flatnonzero(parts.fresh[local.element])
    element = np.concatenate([parts.kept[old.element[stays]], parts.made[local.element[new]]])
    start = np.concatenate([old.start[stays], local.start[new]])
    order = np.lexsort((start[:, 1], start[:, 0], element))
    rank = inverse(order)
    was = np.full(len(old) + 1, -1, dtype=np.int64)  # the last entry is for -1
    was[stays] = rank[: len(stays)]
    now = np.full(len(local) + 1, -1, dtype=np.int64)
    now[new] = rank[len(stays) :]
    beside = np.flatnonzero(~parts.fresh[local.element])
    twin, known = _unchanged_edges(old, stays, local, beside, parts)
    now[beside[known]] = was[twin[known]]

    found = {name: _linked(old, local, name, was, now, len(order)) for name in LINKS}
    linked = {name: links for name, links in found.items() if links is not None}
    if len(linked) < len(LINKS):
        return None
    return CutBoundary(
        start=start[order],
        end=np.concatenate([old.end[stays], local.end[new]])[order],
        element=element[order],
        body=np.full(len(order), -1, dtype=np.int64),
        crack=np.concatenate([old.crack[stays], local.crack[new]])[order],
        **linked,
    )


def _linked(
    old: CutBoundary, local: CutBoundary, name: str, was: Ints, now: Ints, n: int
) -> Ints | None:
    """Links (n,) of one ``name`` between merged edges; None if one has no target.

    ``was`` and ``now`` are the merged numbers of old and local edges, with a last entry for -1.
    """
    before, links = getattr(old, name), np.full(n, -1, dtype=np.int64)
    there, stays = np.flatnonzero(now[:-1] >= 0), np.flatnonzero(was[:-1] >= 0)
    links[now[there]] = now[getattr(local, name)[there]]
    # Links to a removed edge are taken from the new cut.
    mine = was[before[stays]]
    links[was[stays]] = np.where(mine >= 0, mine, links[was[stays]])
    lost = (before[stays] >= 0) & (links[was[stays]] < 0)
    # Only edges of the outer boundary have no opposite edge.
    alone = name == "opposite" or bool((links >= 0).all())
    return links if alone and not lost.any() else None


def _unchanged_edges(
    old: CutBoundary, stays: Ints, local: CutBoundary, beside: Ints, parts: MergedElements
) -> tuple[Ints, Ints]:
    """Old edge (k,) of each local edge ``beside`` the new ones, and the rows that have one.

    They belong to the same element and start at the same point.
    """
    near = stays[np.isin(parts.kept[old.element[stays]], parts.made[local.element[beside]])]
    rows = [
        np.column_stack([element, edges.start[chosen]])
        for element, edges, chosen in (
            (parts.kept[old.element[near]], old, near),
            (parts.made[local.element[beside]], local, beside),
        )
    ]
    _, which = np.unique(np.concatenate(rows), axis=0, return_inverse=True)
    which = which.ravel()
    place = np.full(int(which.max(initial=-1)) + 1, -1, dtype=np.int64)
    place[which[: len(near)]] = near
    found = place[which[len(near) :]]
    return found, np.flatnonzero(found >= 0)


def merged_tips(old: CrackTips, local: CrackTips, parts: MergedElements) -> CrackTips:
    """Merge the crack tips."""
    stays = np.flatnonzero(parts.kept[old.element] >= 0)
    new = np.flatnonzero(parts.fresh[local.element])
    point = np.concatenate([old.point[stays], local.point[new]])
    crack = np.concatenate([old.crack[stays], local.crack[new]])
    order = np.lexsort((point[:, 1], point[:, 0], crack))
    return CrackTips(
        point[order],
        np.concatenate([old.direction[stays], local.direction[new]])[order],
        np.concatenate([parts.kept[old.element[stays]], parts.made[local.element[new]]])[order],
        crack[order],
    )
