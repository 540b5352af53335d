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
            self.local(item, self.active[index, slot], points)[0]
            for slot, item in enumerate(self.functions)
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
        slots = self.slots[index]
        row = np.arange(len(index))[:, None]
        return weight[row, slots], slope[row, slots]

    def local(self, item: LocalFunctions, cover: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Values (m, S) and gradients (m, S, 2) of the local functions of covers (m,)."""
        matrix = self.covers.matrix[cover]
        xi = np.einsum("mij,mj->mi", matrix, points - self.covers.centre[cover])
        f = evaluate(xi, item.degree)
        lower = evaluate(xi, max(item.degree - 1, 0))
        unit = np.eye(count(item.degree))
        by_xi = [lower @ differentiate(unit, item.degree, axis).T for axis in (0, 1)]
        return f, np.einsum("ims,mij->msj", np.stack(by_xi), matrix)
