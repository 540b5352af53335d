"""The base of element groups: elements of the same local functions, as rectangular arrays.

On element ``e`` of a group ``u(x) = sum_a d[unknowns[e, a]] T_a(x)`` with

    T(x) = [phi_0 I2, phi_1 I2, ...] @ combination        (2, L),

with scalar functions ``phi_s``. All that mechanics needs are integrals of products of the ``phi_s``
and of their gradients.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from integration.rules import PointRule


@dataclass(frozen=True)
class ElementGroup(ABC):
    """Base of element groups.

    Attributes
    ----------
    elements
        (n,) indices into the manifold's elements.
    unknowns
        (n, L) global unknowns of each element.
    combination
        (2S, L) matrix that combines the scalar functions; None for the identity, with both
        components of a function next to each other.
    shape
        (n,) number of the shape of each element: congruent elements share one, and integrals are
        those of each of the d shapes.
    """

    elements: Ints
    unknowns: Ints
    combination: Floats | None
    shape: Ints

    @property
    def extends(self) -> bool:
        """Whether the functions of an element can be extended beyond it."""
        return True

    @property
    def weighted(self) -> bool:
        """Whether the functions carry weights that vary over the element."""
        return True

    @property
    def shape_degree(self) -> int:
        """Degree of displacements on an element for quadrature: exact for polynomials."""
        return 2

    @property
    def trace_degree(self) -> int | None:
        """Degree of displacements along a line; None where they are no polynomials."""
        return None

    @property
    def n_shapes(self) -> int:
        """Number d of distinct shapes."""
        return int(self.shape.max(initial=-1)) + 1

    @property
    @abstractmethod
    def slots(self) -> Ints:
        """(S,) position of the cover of each weighted monomial among an element's; else -1."""

    @property
    @abstractmethod
    def carriers(self) -> Ints:
        """(S,) position of the cover of each function, singular ones too, among an element's."""

    @abstractmethod
    def values(self, index: Ints, points: Floats) -> Floats:
        """``phi_s`` (m, S) at reference points (m, 2) in elements ``index`` (m,) of the group."""

    @abstractmethod
    def gradients(self, index: Ints, points: Floats) -> Floats:
        """Gradients of ``phi_s`` (m, S, 2) at reference points."""

    @abstractmethod
    def products(self) -> Floats:
        """Integrals of ``phi_s phi_t`` (d, S, S)."""

    @abstractmethod
    def lumped_products(self) -> Floats:
        """Integrals of ``w_k f_s f_t`` (d, S, S) of functions of one cover, zero between covers.

        With ``phi_s = w_k f_s``, the sum over all covers is that of products of the local fields,
        each weighted once (Yang, Zheng and Sivaselvan 2017).
        """

    @abstractmethod
    def gradient_products(self) -> Floats:
        """Integrals (d, 3, S, S) of ``s_x t_x``, ``s_x t_y``, ``s_y t_y``."""

    @abstractmethod
    def value_gradients(self, of: Ints) -> Floats:
        """Integrals (d, T, S, 2) of ``t s_x`` and ``t s_y``, ``t`` the functions ``of`` (T,)."""

    @abstractmethod
    def integrals(self) -> Floats:
        """Integrals of ``phi_s`` (d, S)."""

    @abstractmethod
    def gradient_integrals(self) -> Floats:
        """Integrals of the gradient of ``phi_s`` (d, S, 2)."""

    @abstractmethod
    def gradient_rule(self, polygons: Polygons) -> PointRule:
        """Quadrature of products of two gradients; ``owner`` counts within the group.

        ``polygons`` are the manifold's elements.
        """

    def displacement_rows(self, index: Ints, points: Floats) -> Floats:
        """``T`` (m, 2, L) at reference points."""
        return self._combine(self.values(index, points)[:, None, :])[:, 0]

    def gradient_rows(self, index: Ints, points: Floats) -> Floats:
        """``d T_c / d x_j`` (m, 2 components, 2 directions, L) at reference points."""
        by_direction = self._combine(np.swapaxes(self.gradients(index, points), 1, 2))
        return np.swapaxes(by_direction, 1, 2)

    def both_rows(self, index: Ints, points: Floats) -> Floats:
        """``T``, ``d T / d x`` and ``d T / d y`` (m, 3, 2 components, L) at reference points."""
        value, gradient = self.evaluate(index, points)
        scalars = np.concatenate([value[:, None], np.swapaxes(gradient, 1, 2)], axis=1)
        return self._combine(scalars)

    def evaluate(self, index: Ints, points: Floats) -> tuple[Floats, Floats]:
        """``phi_s`` (m, S) and their gradients (m, S, 2) at reference points."""
        return self.values(index, points), self.gradients(index, points)

    def _combine(self, scalars: Floats) -> Floats:
        """Turn scalars (m, r, S) into vector rows (m, r, 2, L)."""
        m, r, n_scalars = scalars.shape
        if self.combination is None:
            rows = np.zeros((m, r, 2, 2 * n_scalars))
            rows[:, :, 0, 0::2] = scalars
            rows[:, :, 1, 1::2] = scalars
            return rows
        by_component = self.combination.reshape(n_scalars, 2, -1)
        return np.asarray(np.einsum("mrs,scl->mrcl", scalars, by_component, optimize=True))


def one_cover(products: Floats, cover: Ints) -> Floats:
    """Symmetric products (d, S, S) of functions of the same cover (S,), zero for others."""
    same = cover[:, None] == cover
    return np.where(same, (products + np.swapaxes(products, 1, 2)) / 2, 0.0)
