"""Polynomial local functions of a physical cover: monomials, and their combinations.

On a physical cover with centre ``c`` and matrix ``M`` the displacement is

    u(x) = sum_s f_s(xi) a_s,   xi = M (x - c),   a = C d,

with ``f_s`` all monomials up to ``degree``, ``a_s`` a vector of two components and ``d`` the
cover's unknowns. ``C`` (`combination`) is the identity for plain polynomials; DDA's block basis
is a particular ``C`` over the linear monomials (Shi 1988).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from covers.small_matrices import inverses
from integration.arrays import Floats, Ints
from integration.monomials import count


@dataclass(frozen=True)
class LocalFunctions:
    """Base: complete polynomials of one degree, or combinations of them.

    Attributes
    ----------
    degree
        Highest total degree of the monomials, 0 to 3.
    any_degree
        Whether they are made in every degree, which must be given then; else in their own alone.
    enriched
        Whether covers about tips of cracks carry singular functions beside them unless told.
    """

    any_degree: ClassVar[bool] = True
    enriched: ClassVar[bool] = True
    degree: int

    def __post_init__(self) -> None:
        if self.degree not in (0, 1, 2, 3):
            raise ValueError(f"degree: {self.degree}: expected 0, 1, 2 or 3: choose one")

    @property
    def n_functions(self) -> int:
        """Number of scalar functions."""
        return count(self.degree)

    @property
    def n_unknowns(self) -> int:
        """Number of unknowns of a cover."""
        return 2 * self.n_functions if self.combination is None else self.combination.shape[1]

    @property
    def physical_length(self) -> bool:
        """Whether ``M = I``, so that unknowns have the units of displacement and strain."""
        return False

    @cached_property
    def combination(self) -> Floats | None:
        """The matrix ``C`` (2 n_functions, n_unknowns); None is the identity."""
        return None

    def linear_field(self, value: Floats, gradient: Floats, matrix: Floats) -> Floats:
        """Return the unknowns of ``u = value + gradient (x - c)`` on each cover.

        Parameters
        ----------
        value
            (n, 2) the field at the centres.
        gradient
            (n, 2, 2) ``gradient[:, i, j] = d u_i / d x_j``.
        matrix
            (n, 2, 2) the matrix ``M`` of each cover.

        Returns
        -------
        (n, n_unknowns); a basis without linear functions takes the value at the centre alone.
        """
        coefficients = np.zeros((len(value), self.n_functions, 2))
        coefficients[:, 0] = value
        if self.degree >= 1:
            coefficients[:, 1:3] = np.swapaxes(gradient @ inverses(matrix), 1, 2)
        flat = coefficients.reshape(len(value), -1)
        if self.combination is None:
            return flat
        return flat @ np.linalg.pinv(self.combination).T


@dataclass(frozen=True)
class Monomials(LocalFunctions):
    """Complete polynomials of degree 0 to 3 in each component."""


@dataclass(frozen=True)
class RigidStrain(LocalFunctions):
    """DDA's block functions (u0, v0, r0, ex, ey, gxy) about the centre (Shi 1988).

    ``u = u0 - r0 y + ex x + gxy y / 2``, ``v = v0 + r0 x + ey y + gxy x / 2``.
    """

    any_degree: ClassVar[bool] = False
    enriched: ClassVar[bool] = False
    degree: int = 1

    @property
    def physical_length(self) -> bool:
        """The unknowns are metres, radians and strains."""
        return True

    @cached_property
    def combination(self) -> Floats:
        """The columns u0, v0, r0, ex, ey, gxy over (1, x, y) in two components."""
        return np.array(
            [
                [1, 0, 0, 0, 0, 0],
                [0, 1, 0, 0, 0, 0],
                [0, 0, 0, 1, 0, 0],
                [0, 0, 1, 0, 0, 0.5],
                [0, 0, -1, 0, 0, 0.5],
                [0, 0, 0, 0, 1, 0],
            ],
            dtype=np.float64,
        )


@dataclass(frozen=True)
class Rigid(RigidStrain):
    """Rigid motion alone (u0, v0, r0): the block of a rigid-body-spring model (Kawai 1978)."""

    @cached_property
    def combination(self) -> Floats:
        """The first three columns of the block basis."""
        return RigidStrain().combination[:, :3]


@dataclass(frozen=True)
class Kinds:
    """Local functions of covers.

    Attributes
    ----------
    functions
        The distinct local functions.
    which
        (C,) number of those of each physical cover.
    """

    functions: tuple[LocalFunctions, ...]
    which: Ints

    def each(self, of: Callable[[LocalFunctions], Any]) -> Any:
        """Return an array (C,) of a property of the functions of each physical cover."""
        return np.array([of(item) for item in self.functions])[self.which]
