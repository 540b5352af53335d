"""The scalar functions of a manifold with numbers of their own.

A field is ``T(x) = sum_i w_i(x) sum_j f_ij(x) t_ij`` with the weights, monomials and components of
singular functions that displacements have, whatever unknowns combine them there. Those of a crack
tip span ``sqrt(r) sin(t / 2)`` and ``sqrt(r) cos(t / 2)``, which is how fields that spread along
their slope behave at the end of a line that they do not cross, and of one that holds them.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from scipy.sparse import csr_array

from covers.approximation.groups.element_group import ElementGroup
from covers.approximation.manifold import Manifold
from covers.approximation.rows import stack_groups
from integration.arrays import Floats, Ints
from integration.ragged import within


@dataclass(frozen=True)
class ScalarGroup:
    """Scalar functions of one element group.

    Attributes
    ----------
    group
        The elements and their functions ``phi_s``.
    numbers
        (n, S) number of each of them among the functions of the manifold.
    """

    group: ElementGroup
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
        covers = [_covers(group, manifold.cover_offset) for group in manifold.groups]
        size = np.zeros(manifold.n_covers, dtype=np.int64)
        for cover, group in zip(covers, manifold.groups, strict=True):  # a handful
            size[cover] = np.bincount(group.carriers)[group.carriers]
        offset = np.concatenate([[0], np.cumsum(size)])
        groups = tuple(
            ScalarGroup(group, offset[cover] + _within(group.carriers))
            for cover, group in zip(covers, manifold.groups, strict=True)
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
            found = getattr(part.group, what)(inside, points[position])
            # Gradients (m, S, 2) become (m, 2, S): functions last.
            found = np.swapaxes(found, 1, 2) if found.ndim == 3 else found
            parts.append((position, part.numbers[inside], found))
        return stack_groups(parts, len(elements))


def _covers(group: ElementGroup, offset: Ints) -> Ints:
    """Return the cover (n, S) of each function of a group."""
    owner = np.searchsorted(offset, group.unknowns, side="right") - 1
    # Unknowns stand cover after cover, as the places of the covers count.
    first = owner[0] if len(owner) else np.zeros(0, dtype=np.int64)
    begins = np.flatnonzero(np.diff(first, prepend=-1))
    return owner[:, begins[group.carriers]]


def _within(carriers: Ints) -> Ints:
    """Place (S,) of each function among those of its cover."""
    order, counts = np.argsort(carriers, kind="stable"), np.bincount(carriers)
    found = np.empty_like(carriers)
    found[order] = within(counts)
    return found


def _matrix(numbers: Ints, values: Floats, n: int) -> csr_array:
    m, length = values.shape
    found = csr_array((values.ravel(), numbers.ravel(), np.arange(m + 1) * length), shape=(m, n))
    found.sum_duplicates()
    return found
