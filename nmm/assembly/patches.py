"""The pressures of a manifold: which patches there are, their measures and changes of volume."""

import numpy as np
from scipy.sparse import coo_array, csr_array

from covers.element_groups import ElementGroup
from covers.manifold import Manifold
from integration.arrays import Floats, Ints
from integration.monomials import count
from nmm.assembly.patch_inverse import inverse_roots
from nmm.assembly.pressures import Pressures


def pressures(manifold: Manifold, bulk: Floats, lower: int) -> Pressures | None:
    """Return the pressures of elements of a bulk stiffness (E,) above zero (Pa).

    Their functions are ``lower`` degrees below those of the displacements. None where weights are
    negative somewhere, so that a patch has no positive measure.
    """
    patch, parts = _patches(manifold, bulk, lower)
    degree_of = np.zeros(len(patch), dtype=np.int64)
    for _, _, _, of_slot, width in parts:
        degree_of[of_slot[of_slot >= 0]] = np.broadcast_to(width, of_slot.shape)[of_slot >= 0]
    offset = np.concatenate([[0], np.cumsum(degree_of)])
    k, most = int(offset[-1]), int(degree_of.max(initial=1))
    mass = np.zeros((len(patch), most, most))
    functions, entries = [], []
    for group, chosen, rank, of_slot, _ in parts:
        slot = group.slots[chosen]
        own = of_slot[:, slot]
        pressure = np.where(own >= 0, offset[own] + rank, -1)
        functions.append((chosen, pressure))
        if not len(chosen):
            continue
        products = group.lumped_products()[:, chosen][:, :, chosen]
        for one in np.unique(slot):  # the covers of one element
            at = np.flatnonzero(slot == one)
            there = np.flatnonzero(of_slot[:, one] >= 0)
            block = products[:, at[:, None], at][group.shape[there]]
            np.add.at(mass[:, : len(at), : len(at)], of_slot[there, one], block)
        entries.append(_divergence(group, chosen, pressure))
    roots = inverse_roots(mass, degree_of)
    if roots is None:
        return None
    root = _block_diagonal(roots * np.sqrt(patch)[:, None, None], offset, degree_of)
    row, column, value = (np.concatenate(part) for part in zip(*entries, strict=True))
    shape = (k, manifold.n_unknowns)
    divergence = csr_array(coo_array((value, (row, column)), shape=shape))
    return Pressures(divergence, root, tuple(functions))


def _patches(
    manifold: Manifold, bulk: Floats, lower: int
) -> tuple[Floats, list[tuple[ElementGroup, Ints, Ints, Ints, Ints]]]:
    """Bulk stiffness of each patch, and the functions of each group.

    For a group: functions (T,), their rank in a patch, patch (n, slots) or -1 of each cover of an
    element, and the number of functions (slots,) of each.
    """
    _, kind = np.unique(bulk, return_inverse=True)
    kind = kind.ravel()
    keys, found = [], []
    n_kinds = int(kind.max(initial=0)) + 1
    for group in manifold.groups:  # a handful of groups
        slots = group.slots
        number = int(slots.max(initial=-1)) + 1
        sizes = np.bincount(slots[slots >= 0], minlength=number)
        width = np.array([_below(size, lower) for size in sizes.tolist()], dtype=np.int64)
        first = np.array([np.flatnonzero(slots == s)[0] for s in range(number)], dtype=np.int64)
        rank = np.arange(len(slots)) - first[slots]
        chosen = np.flatnonzero((slots >= 0) & (rank < width[slots]))
        cover = _covers(manifold, group, number)
        key = cover * n_kinds + kind[group.elements][:, None]
        key[bulk[group.elements] <= 0] = -1
        keys.append(key.ravel())
        found.append((group, chosen, rank[chosen], key, width))
    every = np.unique(np.concatenate(keys))
    every = every[every >= 0]
    value = np.zeros(n_kinds)
    value[kind] = bulk
    parts = []
    for group, chosen, rank, key, width in found:
        patch = np.where(key >= 0, np.searchsorted(every, key), -1)
        parts.append((group, chosen, rank, patch, width))
    return value[every % n_kinds], parts


def _below(functions: int, lower: int) -> int:
    """Number of monomials ``lower`` degrees below complete ones of a number; at least one."""
    degree = 0
    while count(degree) < functions:
        degree += 1
    return count(max(degree - lower, 0))


def _covers(manifold: Manifold, group: ElementGroup, number: int) -> Ints:
    """Physical covers (n, number) of the slots of a group's elements."""
    owner = np.searchsorted(manifold.cover_offset, group.unknowns, side="right") - 1
    if not len(owner):
        return np.zeros((0, number), dtype=np.int64)
    starts = np.flatnonzero(np.concatenate([[True], owner[0, 1:] != owner[0, :-1]]))
    return np.asarray(owner[:, starts[:number]])


def _divergence(group: ElementGroup, chosen: Ints, pressure: Ints) -> tuple[Ints, Ints, Floats]:
    """Rows, columns and values of the divergence's integrals of a group."""
    integrals = group.value_gradients(chosen)
    d, t, size, _ = integrals.shape
    full = integrals.reshape(d, t, 2 * size)
    if group.combination is not None:
        full = full @ group.combination
    values = full[group.shape]
    there = pressure >= 0
    length = values.shape[2]
    row = np.repeat(pressure[there], length)
    unknowns = np.repeat(group.unknowns[:, None, :], t, axis=1)[there]
    return row, unknowns.ravel(), values[there].ravel()


def _block_diagonal(blocks: Floats, offset: Ints, size: Ints) -> csr_array:
    most = blocks.shape[1]
    inside = np.arange(most)
    there = (inside[None, :, None] < size[:, None, None]) & (inside < size[:, None, None])
    row = np.broadcast_to(offset[:-1, None, None] + inside[None, :, None], blocks.shape)
    column = np.broadcast_to(offset[:-1, None, None] + inside, blocks.shape)
    n = int(offset[-1])
    entries = blocks[there], (row[there], column[there])
    return csr_array(coo_array(entries, shape=(n, n)))
