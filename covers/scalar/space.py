"""The scalar functions of a manifold with numbers of their own.

A field is ``T(x) = sum_i w_i(x) sum_j f_ij(x) t_ij`` with the weights and monomials of the
displacements, whatever unknowns combine them there. Singular functions of crack tips, which are
made for displacements, are left out.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from scipy.sparse import csr_array

from covers.approximation.element_groups import ElementGroup
from covers.approximation.manifold import Manifold
from covers.approximation.rows import stack_groups
from integration.arrays import Floats, Ints


@dataclass(frozen=True)
class ScalarGroup:
    """Scalar functions of one element group.

    Attributes
    ----------
    group
        The elements and their functions ``phi_s``.
    kept
        (T,) which of the ``phi_s`` are weighted monomials.
    numbers
        (n, T) number of each of them among the functions of the manifold.
    """

    group: ElementGroup
    kept: Ints
    numbers: Ints


@dataclass(frozen=True)
class ScalarSpace:
    """Scalar functions of a manifold.

    Attributes
    ----------
    manifold
        Elements and covers.
    groups
        In the order of the manifold's groups.
    offset
        (C + 1,) first function of each physical cover.
    """

    manifold: Manifold
    groups: tuple[ScalarGroup, ...]
    offset: Ints

    @classmethod
    def of(cls, manifold: Manifold) -> Self:
        """Number the functions cover by cover."""
        known = [_covers(group, manifold.cover_offset) for group in manifold.groups]
        size = np.zeros(manifold.n_covers, dtype=np.int64)
        for (kept, cover), group in zip(known, manifold.groups, strict=True):  # a handful
            places = group.slots[kept]
            counts = np.bincount(places, minlength=int(places.max(initial=-1)) + 1)
            size[cover] = counts[places]
        offset = np.concatenate([[0], np.cumsum(size)])
        groups = tuple(
            ScalarGroup(group, kept, offset[cover] + _within(group.slots[kept]))
            for (kept, cover), group in zip(known, manifold.groups, strict=True)
        )
        return cls(manifold, groups, offset)

    @property
    def n(self) -> int:
        """Number of functions."""
        return int(self.offset[-1])

    @cached_property
    def body(self) -> Ints:
        """(n,) body of each function."""
        return np.repeat(self.manifold.cover_body, np.diff(self.offset))

    @cached_property
    def one(self) -> Floats:
        """(n,) unknowns of the field that is one everywhere: weights sum to one."""
        found = np.zeros(self.n)
        found[self.offset[:-1]] = 1.0
        return found

    def values(self, elements: Ints, points: Floats) -> csr_array:
        """Rows (m, n) of the field at reference points (m, 2) in elements (m,)."""
        if not len(elements):
            return csr_array((0, self.n))
        return _matrix(*self._stack(elements, points, "values"), self.n)

    def gradients(self, elements: Ints, points: Floats, along: Floats) -> csr_array:
        """Rows (m, n) of the slope along vectors (m, 2) at reference points."""
        if not len(elements):
            return csr_array((0, self.n))
        numbers, slopes = self._stack(elements, points, "gradients")
        return _matrix(numbers, np.einsum("mjs,mj->ms", slopes, along), self.n)

    @cached_property
    def vertices(self) -> csr_array:
        """Rows (P, n) of the field at the elements' vertices."""
        elements = self.manifold.elements
        return self.values(elements.polygon_of_point, elements.points)

    def _stack(self, elements: Ints, points: Floats, what: str) -> tuple[Ints, Floats]:
        group_of = np.empty(len(self.manifold.elements), dtype=np.int64)
        index = np.empty_like(group_of)
        for number, part in enumerate(self.groups):  # a handful of groups
            group_of[part.group.elements] = number
            index[part.group.elements] = np.arange(len(part.group.elements))
        wanted, parts = group_of[elements], []
        for number in np.unique(wanted):  # a handful of groups
            position, part = np.flatnonzero(wanted == number), self.groups[number]
            inside = index[elements[position]]
            found = getattr(part.group, what)(inside, points[position])[:, part.kept]
            # Gradients (m, T, 2) become (m, 2, T): functions last.
            found = np.swapaxes(found, 1, 2) if found.ndim == 3 else found
            parts.append((position, part.numbers[inside], found))
        return stack_groups(parts, len(elements))


def _covers(group: ElementGroup, offset: Ints) -> tuple[Ints, Ints]:
    """Which functions (T,) of a group are weighted monomials, and the cover (n, T) of each."""
    slots = group.slots
    kept = np.flatnonzero(slots >= 0)
    owner = np.searchsorted(offset, group.unknowns, side="right") - 1
    # Unknowns stand cover after cover, as the places of the covers count.
    first = owner[0] if len(owner) else np.zeros(0, dtype=np.int64)
    begins = np.flatnonzero(np.diff(first, prepend=-1))
    return kept, owner[:, begins[slots[kept]]]


def _within(slots: Ints) -> Ints:
    """Place (T,) of each function among those of its cover, which follow one another."""
    begin = np.flatnonzero(np.diff(slots, prepend=-1))
    return np.asarray(np.arange(len(slots)) - np.repeat(begin, np.diff([*begin, len(slots)])))


def _matrix(numbers: Ints, values: Floats, n: int) -> csr_array:
    m, length = values.shape
    found = csr_array((values.ravel(), numbers.ravel(), np.arange(m + 1) * length), shape=(m, n))
    found.sum_duplicates()
    return found
