"""Polynomials in two variables as rows of coefficients over graded monomials.

The monomials are 1, x, y, x2, xy, y2, x3, x2y, ...: grade ``g`` (total degree) holds the columns
``count(g - 1):count(g)``, and x^a y^b is the ``b``-th of its grade. Multiplication by x or y thus
moves a whole grade by a slice, which is what every function here uses: the loops run over grades,
never over rows.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from integration.arrays import Floats, Ints


def count(degree: int) -> int:
    """Number of monomials up to a total degree; zero below degree 0."""
    return (degree + 1) * (degree + 2) // 2 if degree >= 0 else 0


@cache
def exponents(degree: int) -> Ints:
    """Exponents (K, 2) of x and y of the monomials up to ``degree`` (read only)."""
    table = np.array(
        [(g - b, b) for g in range(degree + 1) for b in range(g + 1)], dtype=np.int64
    ).reshape(-1, 2)
    table.flags.writeable = False
    return table


def grade(g: int) -> slice:
    """Columns of the monomials of total degree ``g``."""
    return slice(count(g - 1), count(g))


def evaluate(xi: Floats, degree: int) -> Floats:
    """Values (..., K) of the monomials at points ``xi`` (..., 2)."""
    x, y = xi[..., 0], xi[..., 1]
    return _rows_last(powers(x, y, degree))


def powers(x: Floats, y: Floats, degree: int) -> Floats:
    """Values (K, ...) of the monomials at coordinates ``x`` and ``y`` of one shape."""
    values = np.empty((count(degree), *x.shape))
    values[0] = 1.0
    for g in range(1, degree + 1):
        lower, upper = values[grade(g - 1)], values[grade(g)]
        np.multiply(lower, x, out=upper[:-1])
        np.multiply(lower[-1], y, out=upper[-1])
    return values


def multiply(a: Floats, deg_a: int, b: Floats, deg_b: int) -> Floats:
    """Coefficients (..., K(deg_a + deg_b)) of the products of the rows of ``a`` and ``b``.

    Parameters
    ----------
    a, b : (..., K(deg_a)), (..., K(deg_b))
        coefficients; leading axes broadcast.
    """
    if deg_a > deg_b:
        a, deg_a, b, deg_b = b, deg_b, a, deg_a
    one, two = _columns_first(a, deg_a), _columns_first(b, deg_b)
    out = np.zeros((count(deg_a + deg_b), *np.broadcast_shapes(one.shape[1:], two.shape[1:])))
    for i, (p, q) in enumerate(exponents(deg_a).tolist()):
        for g in range(deg_b + 1):
            begin = count(g + p + q - 1) + q
            out[begin : begin + g + 1] += one[i] * two[grade(g)]
    return _rows_last(out)


def differentiate(a: Floats, degree: int, axis: int) -> Floats:
    """Coefficients (..., K(degree - 1)), at least one column, of the derivative along ``axis``."""
    source, factor = _derivative(degree, axis)
    return np.take(a, source, axis=-1) * factor


def affine(a: Floats, degree: int, matrix: Floats, shift: Floats) -> Floats:
    """Coefficients (n, K) in x of the polynomials ``a`` of ``matrix @ x + shift``.

    Taylor shift by repeated synthetic division (Shaw and Traub 1974), then the linear map grade
    by grade with Horner's scheme for binary forms.

    Parameters
    ----------
    a : (n, K)
        coefficients of total degree ``degree``.
    matrix, shift : (n, 2, 2), (n, 2)
        the map of each row; a single (2, 2) or (2,) serves all rows.
    """
    matrix = np.broadcast_to(matrix, (*a.shape[:-1], 2, 2))
    out = _columns_first(a, degree).copy()
    moved = shift_coefficients(out, degree, shift[..., 0], shift[..., 1])
    return _rows_last(_linear(moved, degree, matrix))


def shift_coefficients(columns: Floats, degree: int, dx: Floats, dy: Floats) -> Floats:
    """Replace p(x, y) by p(x + dx, y + dy) in place, coefficients stored (K, ...)."""
    for j in range(degree):
        for g in range(degree - 1, j - 1, -1):
            columns[grade(g)][: g - j + 1] += dx * columns[grade(g + 1)][: g - j + 1]
    for j in range(degree):
        for g in range(degree - 1, j - 1, -1):
            columns[grade(g)][j:] += dy * columns[grade(g + 1)][j + 1 :]
    return columns


def shift_moments(columns: Floats, degree: int, dx: Floats, dy: Floats) -> Floats:
    """Replace integrals of x^a y^b by those of (x + dx)^a (y + dy)^b in place, stored (K, ...)."""
    for j in range(1, degree + 1):
        for g in range(degree, j - 1, -1):
            columns[grade(g)][: g - j + 1] += dx * columns[grade(g - 1)][: g - j + 1]
    for j in range(1, degree + 1):
        for g in range(degree, j - 1, -1):
            columns[grade(g)][j:] += dy * columns[grade(g - 1)][j - 1 :]
    return columns


def _linear(columns: Floats, degree: int, matrix: Floats) -> Floats:
    """Coefficients (K, n) of p(matrix @ x): each grade is a form in u = m00 x + m01 y and v."""
    u, v = matrix[..., 0, :], matrix[..., 1, :]
    out = np.empty_like(columns)
    power = [np.ones((1, *u.shape[:-1]))]
    for g in range(degree):
        power.append(_times_line(power[g], u))
    for g in range(degree + 1):
        form = columns[grade(g)]
        value = form[g:]
        for j in range(1, g + 1):
            value = _times_line(value, v)
            value += form[g - j] * power[j]
        out[grade(g)] = value
    return out


def _times_line(form: Floats, line: Floats) -> Floats:
    """A binary form (g + 1, n) times ``line[..., 0] x + line[..., 1] y``."""
    out = np.zeros((len(form) + 1, *form.shape[1:]))
    np.multiply(form, line[..., 0], out=out[:-1])
    out[1:] += form * line[..., 1]
    return out


@cache
def _derivative(degree: int, axis: int) -> tuple[Ints, Floats]:
    if degree == 0:
        return np.zeros(1, dtype=np.int64), np.zeros(1)
    kept = exponents(degree - 1).copy()
    kept[:, axis] += 1
    g = kept.sum(axis=1)
    return g * (g + 1) // 2 + kept[:, 1], kept[:, axis].astype(float)


def _columns_first(a: Floats, degree: int) -> Floats:
    if a.shape[-1] != count(degree):
        raise ValueError(
            f"coefficients: {a.shape[-1]} columns: {count(degree)} expected for degree {degree}: "
            "pass the degree that the rows were built with"
        )
    return np.ascontiguousarray(np.moveaxis(a, -1, 0))


def _rows_last(columns: Floats) -> Floats:
    return np.ascontiguousarray(np.moveaxis(columns, 0, -1))
