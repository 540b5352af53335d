"""Material points: where elements ask a law for stress, and how it acts on the unknowns."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from covers.approximation.groups.element_group import ElementGroup
from covers.approximation.manifold import Manifold
from integration.arrays import Bools, Floats, Ints
from integration.permutations import inverse
from integration.rules import PointRule
from integration.sparse import csc_array, csr_array
from nmm.assembly.elements.blocks import Part, assemble
from nmm.solvers.unchecked import made_of, product

StressAt = Callable[[Ints, Floats, float], Floats]
"""Stress (m, 3) in Pa in body axes from elements, their reference points (m, 2) and a time (s)."""
PressureAt = Callable[[Ints, Floats, float], Floats]
"""Pressure (m,) in Pa of what fills pores, from the same."""


@dataclass(frozen=True)
class Batch:
    """Elements of one group that have equally many points.

    Attributes
    ----------
    at
        (k, q) their points among all.
    unknowns
        (k, L) of each element.
    rows
        (k, q, c, L) strain of the unknowns in c components.
    """

    at: Ints
    unknowns: Ints
    rows: Floats


Measure = Callable[[Floats], Floats]
"""From rows of gradients (m, 2 components, 2 directions, L) to those of strain (m, c, L)."""


def small_strain(gradient: Floats) -> Floats:
    """Return the rows (m, 3, L) of small strain: xx, yy, 2 xy."""
    return np.stack(
        [gradient[:, 0, 0], gradient[:, 1, 1], gradient[:, 0, 1] + gradient[:, 1, 0]], axis=1
    )


def gradients(gradient: Floats) -> Floats:
    """Return the rows (m, 4, L) of the gradient itself: xx, xy, yx, yy."""
    return gradient.reshape(len(gradient), 4, gradient.shape[3])


@dataclass(frozen=True)
class StressPoints:
    """Points of some elements of a manifold, element after element.

    Strain is what is measured there, in c components, and stress what does work on it.

    Attributes
    ----------
    rule
        Q points and weights (m2); ``owner`` are elements of the manifold, sorted.
    batches
        The elements with their strains.
    offset
        (C + 1,) first unknown of each cover.
    """

    rule: PointRule
    batches: tuple[Batch, ...]
    offset: Ints

    @classmethod
    def of(cls, manifold: Manifold, chosen: Bools, measure: Measure = small_strain) -> Self:
        """Return the points of the chosen elements (E,)."""
        parts = [_part(group, manifold, chosen) for group in manifold.groups]
        owner, points, weights = (
            np.concatenate([getattr(part[0], name) for part in parts])
            for name in ("owner", "points", "weights")
        )
        order = np.argsort(owner, kind="stable")
        place = inverse(order)
        rule = PointRule(points[order], weights[order], owner[order])
        batches: list[Batch] = []
        first = 0
        for group, (own, index) in zip(manifold.groups, parts, strict=True):
            at = place[first : first + len(index)]
            batches.extend(_batches(group, own.points, index, at, measure))
            first += len(index)
        return cls(rule, tuple(batches), manifold.cover_offset)

    def __len__(self) -> int:
        return len(self.rule.owner)

    @property
    def width(self) -> int:
        """Number c of components."""
        return int(self.batches[0].rows.shape[2]) if self.batches else 3

    def strain(self, deformation: Floats) -> Floats:
        """Strain (Q, c) of the unknowns (n,)."""
        return product(self._rows, deformation).reshape(len(self), self.width)

    def force(self, stress: Floats) -> Floats:
        """Integral of ``B^T sigma`` (n,) of a stress (Q, c), per unit thickness."""
        weighted = self.rule.weights[:, None] * stress
        return product(self._columns, weighted.ravel())

    @cached_property
    def _rows(self) -> csr_array:
        """``B`` (Q c, n): a twelfth of the time of small products, element by element."""
        width, row, column, value = self.width, [], [], []
        for part in self.batches:
            shape, at = part.rows.shape, width * part.at[:, :, None] + np.arange(width)
            row.append(np.broadcast_to(at[..., None], shape).ravel())
            column.append(np.broadcast_to(part.unknowns[:, None, None], shape).ravel())
            value.append(part.rows.ravel())
        shape = width * len(self), int(self.offset[-1])
        if not value:
            return csr_array(shape)
        places = np.concatenate(row), np.concatenate(column)
        found = csr_array((np.concatenate(value), places), shape=shape)
        found.eliminate_zeros()
        return found

    @cached_property
    def _columns(self) -> csc_array:
        """``B^T`` (n, Q c), of the same numbers."""
        rows = self._rows
        return made_of(csc_array, rows.data, rows.indices, rows.indptr, rows.shape[::-1])

    def matrix(self, tangent: Floats, symmetric: bool = True) -> csc_array:
        """Integral of ``B^T D B`` (n, n) of tangents (Q, c, c), per unit thickness."""
        weighted, parts = self.rule.weights[:, None, None] * tangent, []
        for part in self.batches:
            k, q, width, length = part.rows.shape
            rows = part.rows.reshape(k, width * q, length)
            stress = (weighted[part.at] @ part.rows).reshape(k, width * q, length)
            parts.append(Part(part.unknowns, np.swapaxes(rows, 1, 2) @ stress, np.arange(k)))
        return assemble(parts, int(self.offset[-1]), self.offset, symmetric)

    def means(self, values: Floats) -> tuple[Ints, Floats]:
        """Return the elements (k,) that have points and the means (k, h) of values (Q, h)."""
        elements, averaging = self._averaging
        return elements, averaging @ values

    @cached_property
    def _averaging(self) -> tuple[Ints, csr_array]:
        """The elements (k,) that have points, and the matrix (k, Q) of means over each."""
        elements, place = np.unique(self.rule.owner, return_inverse=True)
        share = self.rule.weights / np.bincount(place, self.rule.weights)[place]
        return elements, csr_array((share, (place, np.arange(len(place)))))


def nearest(rule: PointRule, elements: Ints, points: Floats) -> Ints:
    """Return which point of a rule with sorted owners is nearest, in elements (m,); -1 for none."""
    first = np.searchsorted(rule.owner, elements)
    last = np.searchsorted(rule.owner, elements, side="right")
    found, least = np.full(len(elements), -1), np.full(len(elements), np.inf)
    for number in range(int((last - first).max(initial=0))):  # points of an element
        there = np.flatnonzero(first + number < last)
        at = first[there] + number
        away = ((rule.points[at] - points[there]) ** 2).sum(axis=1)
        nearer = away < least[there]
        found[there[nearer]], least[there[nearer]] = at[nearer], away[nearer]
    return found


def _part(group: ElementGroup, manifold: Manifold, chosen: Bools) -> tuple[PointRule, Ints]:
    """Points of a group's chosen elements, and the number of their element in the group."""
    rule = group.gradient_rule(manifold.elements)
    kept = chosen[group.elements[rule.owner]]
    index = rule.owner[kept]
    return PointRule(rule.points[kept], rule.weights[kept], group.elements[index]), index


def _batches(
    group: ElementGroup, points: Floats, index: Ints, at: Ints, measure: Measure
) -> Iterator[Batch]:
    """Batches of a group; points (m, 2) in its elements ``index`` (m,), ``at`` among all."""
    own, first, count = np.unique(index, return_index=True, return_counts=True)
    for q in np.unique(count):  # a handful of numbers of points
        alike = np.flatnonzero(count == q)
        chosen = (first[alike, None] + np.arange(q)).ravel()
        rows = measure(group.gradient_rows(index[chosen], points[chosen]))
        unknowns = group.unknowns[own[alike]]
        shape = (len(alike), int(q), rows.shape[1], unknowns.shape[1])
        yield Batch(at[chosen].reshape(shape[:2]), unknowns, rows.reshape(shape))
