"""Weights of any mathematical cover times local functions, at points."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.approximation.groups.physical_covers import PhysicalCovers, covers_of
from covers.approximation.groups.quadrature_group import Fields
from covers.local_functions.polynomials import LocalFunctions
from covers.mathematical.base import Cover
from integration.arrays import Floats, Ints
from integration.monomials import count, differentiate, evaluate

# Degree of the quadrature of weights that are not polynomials, beyond that of the polynomials. In
# patch tests, stresses beside cuts are off by 7 % with 6, 2 % with 12, 0.6 % with 20, 0.3 % with
# 24.
RATIONAL = 20
# The same along edges, where weights are not differentiated, and in transfers of fields.
RATIONAL_EDGE = 6


@dataclass(frozen=True)
class WeightedFields(Fields):
    """``phi = w_k f_l`` over the covers active on elements, cover after cover.

    Attributes
    ----------
    weighted
        The mathematical cover.
    cells, slots
        (n,) cell of each element, and (n, k) positions of its covers among the patches of the cell.
    active
        (n, k) physical covers.
    functions
        Local functions of the k covers.
    covers
        All physical covers.
    """

    weighted: Cover
    cells: Ints
    slots: Ints
    active: Ints
    functions: Sequence[LocalFunctions]
    covers: PhysicalCovers

    @property
    def extends(self) -> bool:
        """Whether the weights are polynomials; others are defined in their own cell alone."""
        return self.weighted.weight_degree is not None

    @property
    def degree(self) -> int:
        highest = max(item.degree for item in self.functions)
        own = self.weighted.weight_degree
        return highest + (self.weighted.precision + RATIONAL_EDGE if own is None else own)

    @property
    def cover(self) -> Ints:
        return covers_of(self.functions)

    def local_values(self, index: Ints, points: Floats) -> Floats:
        parts = [
            self._polynomials(item, self.active[index, slot], points)
            for slot, item in enumerate(self.functions)
        ]
        return np.concatenate(parts, axis=1)

    def values(self, index: Ints, points: Floats) -> Floats:
        weight = self.weight_values(index, points)
        parts = [
            weight[:, slot, None] * self._polynomials(item, self.active[index, slot], points)
            for slot, item in enumerate(self.functions)  # the covers of one element
        ]
        return np.concatenate(parts, axis=1)

    def evaluate(self, index: Ints, points: Floats) -> tuple[Floats, Floats]:
        weight, slope = self.weights(index, points)
        values, gradients = [], []
        for slot, item in enumerate(self.functions):  # the covers of one element
            f, df = self.local(item, self.active[index, slot], points)
            w, dw = weight[:, slot, None], slope[:, slot, None, :]
            values.append(w * f)
            gradients.append(dw * f[:, :, None] + w[:, :, None] * df)
        return np.concatenate(values, axis=1), np.concatenate(gradients, axis=1)

    def weights(self, index: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Weights (m, k) and gradients (m, k, 2) of the active covers."""
        weight, slope = self.weighted.evaluate(self.cells[index], points)
        active = self._at(index)
        return weight[active], slope[active]

    def weight_values(self, index: Ints, points: Floats) -> Floats:
        """Weights (m, k) of the active covers alone."""
        return np.asarray(self.weighted.weights(self.cells[index], points)[self._at(index)])

    def _at(self, index: Ints) -> tuple[Ints, Ints]:
        """Rows and columns of the active covers among the patches of cells."""
        return np.arange(len(index))[:, None], self.slots[index]

    def local(self, item: LocalFunctions, cover: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Values (m, S) and gradients (m, S, 2) of the local functions of covers (m,)."""
        xi = self._coordinates(cover, points)
        lower = evaluate(xi, max(item.degree - 1, 0))
        unit = np.eye(count(item.degree))
        by_xi = [lower @ differentiate(unit, item.degree, axis).T for axis in (0, 1)]
        slopes = np.einsum("ims,mij->msj", np.stack(by_xi), self.covers.matrix[cover])
        return evaluate(xi, item.degree), slopes

    def _polynomials(self, item: LocalFunctions, cover: Ints, points: Floats) -> Floats:
        """Values (m, S) of the local functions of covers (m,)."""
        return evaluate(self._coordinates(cover, points), item.degree)

    def _coordinates(self, cover: Ints, points: Floats) -> Floats:
        """Coordinates (m, 2) of points (m, 2) about the centres of covers (m,)."""
        offset = points - self.covers.centre[cover]
        return np.asarray(np.einsum("mij,mj->mi", self.covers.matrix[cover], offset))
