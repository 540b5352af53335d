"""The pressures of a manifold: which patches there are, their measures and changes of volume."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from covers.approximation.groups.element_group import ElementGroup
from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints
from integration.monomials import count
from integration.sparse import coo_array, csr_array
from nmm.assembly.projected_volumes.patch_inverse import inverse_roots
from nmm.assembly.projected_volumes.pressures import Pressures

# Share of its largest neighbour below which a patch has no constant pressure of its own.
SLIVER = 0.1


@dataclass(frozen=True)
class _Part:
    """What pressures take of one element group.

    Attributes
    ----------
    group
        The elements.
    chosen, slot, rank
        (T,) functions that pressures have, the covers they are of, and their place among them.
    patch
        (n, slots) patch of each cover of each element, or -1.
    """

    group: ElementGroup
    chosen: Ints
    slot: Ints
    rank: Ints
    patch: Ints

    def pressure(self, offset: Ints) -> Ints:
        """Pressure (n, T) of each function, -1 for none."""
        own = self.patch[:, self.slot]
        return np.where(own >= 0, offset[own] + self.rank, -1)

    def measures(self) -> Iterator[tuple[Ints, Floats]]:
        """Patches (m,) and the integrals (m, q, q) of products, cover by cover."""
        products = self.group.lumped_products()
        for one in np.unique(self.slot):  # the covers of one element
            at = self.chosen[self.slot == one]
            there = np.flatnonzero(self.patch[:, one] >= 0)
            if not len(there):  # its functions may be more than any pressure has
                continue
            yield self.patch[there, one], products[:, at[:, None], at][self.group.shape[there]]


def pressures(manifold: Manifold, bulk: Floats, lower: int) -> Pressures | None:
    """Return the pressures of elements of a bulk stiffness (E,) above zero (Pa).

    Their functions are ``lower`` degrees below those of the displacements, twice as many where
    weights are constant, and of degree 0 at least. None where weights are negative somewhere, so
    that a patch has no positive measure.
    """
    stiffness, parts = _patches(manifold, bulk, lower)
    size = np.zeros(len(stiffness), dtype=np.int64)
    for part in parts:  # a handful of groups
        there = part.patch >= 0
        width = np.bincount(part.slot, minlength=part.patch.shape[1])
        size[part.patch[there]] = np.broadcast_to(width, there.shape)[there]
    most = int(size.max(initial=1))
    mass = np.zeros((len(size), most, most))
    for part in parts:
        for patch, block in part.measures():
            q = block.shape[1]
            np.add.at(mass[:, :q, :q], patch, block)
    roots = inverse_roots(mass, size)
    if roots is None:
        return None
    offset = np.concatenate([[0], np.cumsum(size)])
    return Pressures(
        _divergence(parts, offset, manifold.n_unknowns),
        _block_diagonal(roots * np.sqrt(stiffness)[:, None, None], offset, size),
        tuple((part.chosen, part.pressure(offset)) for part in parts),
    )


def _patches(manifold: Manifold, bulk: Floats, lower: int) -> tuple[Floats, list[_Part]]:
    """Bulk stiffness of each patch, one for each cover and stiffness in it, and the groups."""
    value, kind = np.unique(bulk, return_inverse=True)
    kind = kind.ravel()
    parts = []
    for group in manifold.groups:  # a handful of groups
        slots = group.slots
        sizes = np.bincount(slots[slots >= 0])
        # The divergence under weights that vary is of the degree of the functions.
        below = lower if group.weighted else 2 * lower
        width = np.array([_below(size, below) for size in sizes.tolist()], dtype=np.int64)
        first = np.array([np.argmax(slots == one) for one in range(len(sizes))], dtype=np.int64)
        rank = np.arange(len(slots)) - first[slots]
        chosen = np.flatnonzero((slots >= 0) & (rank < width[slots]))
        key = _covers(manifold, group, len(sizes)) * len(value) + kind[group.elements, None]
        key[bulk[group.elements] <= 0] = -1
        parts.append(_Part(group, chosen, slots[chosen], rank[chosen], key))
    every = np.unique(np.concatenate([part.patch.ravel() for part in parts]))
    every = every[every >= 0]
    for part in parts:
        none = part.patch < 0
        part.patch[:] = np.where(none, -1, np.searchsorted(every, part.patch))
    kept, stands = np.unique(_joined(parts, len(every)), return_inverse=True)
    for part in parts:
        part.patch[:] = np.where(part.patch < 0, -1, stands.ravel()[part.patch])
    return value[every[kept] % len(value)], parts


def _joined(parts: Sequence[_Part], n: int) -> Ints:
    """Patch (n,) of which each patch is a part: itself, or a larger one beside a sliver.

    What a cut leaves of a patch, `SLIVER` of its neighbour, is too little to say what the pressure
    is there. Only constant pressures are joined: those of higher degree have own coordinates.
    """
    measure, constant = np.zeros(n), np.ones(n, dtype=bool)
    for part in parts:  # a handful of groups
        for patch, block in part.measures():
            np.add.at(measure, patch, block[:, 0, 0])
            constant[patch] &= block.shape[1] == 1
    best = np.arange(n)
    for part in parts:
        there = part.patch >= 0
        size = np.where(there & constant[part.patch], measure[part.patch], 0.0)
        if not size.size:
            continue
        largest = np.take_along_axis(part.patch, size.argmax(axis=1)[:, None], axis=1)
        own, other = part.patch[there], np.broadcast_to(largest, there.shape)[there]
        order = np.argsort(measure[other], kind="stable")
        own, other = own[order], other[order]
        more = measure[other] > measure[best[own]]
        best[own[more]] = other[more]
    small = constant & constant[best] & (measure < SLIVER * measure[best])
    found = np.where(small, best, np.arange(n))
    return np.asarray(found[found])


def _below(functions: int, lower: int) -> int:
    """Number of monomials ``lower`` degrees below complete ones of a number; at least one."""
    degree = 0
    while count(degree) < functions:  # degrees 0 to 3
        degree += 1
    return count(max(degree - lower, 0))


def _covers(manifold: Manifold, group: ElementGroup, number: int) -> Ints:
    """Physical covers (n, number) of the slots of a group's elements."""
    owner = np.searchsorted(manifold.cover_offset, group.unknowns, side="right") - 1
    if not len(owner):
        return np.zeros((0, number), dtype=np.int64)
    starts = np.flatnonzero(np.concatenate([[True], owner[0, 1:] != owner[0, :-1]]))
    return np.asarray(owner[:, starts[:number]])


def _divergence(parts: Sequence[_Part], offset: Ints, n: int) -> csr_array:
    """Integrals (k, n) of the pressures' functions times the divergence."""
    rows, columns, values = [], [], []
    for part in parts:  # a handful of groups
        integrals = part.group.value_gradients(part.chosen)
        d, t, size, _ = integrals.shape
        full = integrals.reshape(d, t, 2 * size)
        if part.group.combination is not None:
            full = full @ part.group.combination
        pressure = part.pressure(offset)
        there = pressure >= 0
        rows.append(np.repeat(pressure[there], full.shape[2]))
        columns.append(np.repeat(part.group.unknowns[:, None, :], t, axis=1)[there].ravel())
        values.append(full[part.group.shape][there].ravel())
    places = np.concatenate(rows), np.concatenate(columns)
    return csr_array(coo_array((np.concatenate(values), places), shape=(int(offset[-1]), n)))


def _block_diagonal(blocks: Floats, offset: Ints, size: Ints) -> csr_array:
    inside = np.arange(blocks.shape[1])
    there = (inside[None, :, None] < size[:, None, None]) & (inside < size[:, None, None])
    row = np.broadcast_to(offset[:-1, None, None] + inside[None, :, None], blocks.shape)
    column = np.broadcast_to(offset[:-1, None, None] + inside, blocks.shape)
    n = int(offset[-1])
    entries = blocks[there], (row[there], column[there])
    return csr_array(coo_array(entries, shape=(n, n)))
