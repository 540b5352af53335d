"""Gauss rules of the unit interval and of triangles."""

from __future__ import annotations

from functools import cache

import numpy as np

from integration.arrays import Floats

_TABLES_END = 19
_NEGATIVE = (3, 7)


@cache
def interval(number: int) -> tuple[Floats, Floats]:
    """Nodes and weights of the Gauss rule of [0, 1], exact to degree ``2 number - 1``."""
    nodes, weights = np.polynomial.legendre.leggauss(number)
    return _frozen(0.5 * (1.0 + nodes)), _frozen(0.5 * weights)


@cache
def triangle(order: int) -> tuple[Floats, Floats]:
    """Barycentric points (Q, 3) and weights (Q,), sum one, exact to degree ``order``.

    All weights are positive and all points inside: the tables of orders 3 and 7 are passed over
    for the next ones. Above the tables the square rule is collapsed on the triangle.
    """
    if order > _TABLES_END:
        x, y, weights = _collapsed(order // 2 + 1)
    else:
        from skfem.quadrature import get_quadrature  # half a second that exact moments do not pay
        from skfem.refdom import RefTri

        (x, y), weights = get_quadrature(RefTri, order + 1 if order in _NEGATIVE else order)
    return _frozen(np.stack([1.0 - x - y, x, y], axis=1)), _frozen(weights / weights.sum())


def _collapsed(number: int) -> tuple[Floats, Floats, Floats]:
    """Conical product of Gauss-Legendre and Gauss-Jacobi rules (Stroud 1971, section 2.5)."""
    from scipy.special import roots_jacobi

    t, wt = interval(number)
    s, ws = roots_jacobi(number, 1.0, 0.0)
    x = np.repeat(0.5 * (1.0 + s), number)
    return x, (1.0 - x) * np.tile(t, number), np.repeat(ws, number) * np.tile(wt, number)


def _frozen(values: Floats) -> Floats:
    values.flags.writeable = False
    return values
