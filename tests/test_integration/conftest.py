"""Polygons and exact integrals shared by the tests."""

from fractions import Fraction
from math import comb, factorial

import numpy as np
import pytest

from integration.polygons import Polygons

EXTERIOR = [(0, 0), (4, 0), (4, 3), (2, 1), (0, 3)]
HOLE = [(1.5, 0.25), (2.5, 0.25), (2.5, 0.75), (1.5, 0.75)]


@pytest.fixture
def holed() -> Polygons:
    """The notched polygon with a rectangular hole of benchmark D1."""
    return Polygons.from_rings([[EXTERIOR, HOLE]])


@pytest.fixture
def assorted() -> Polygons:
    """Convex, notched with a hole, clockwise, spiral-like and collinear polygons."""
    return Polygons.from_rings(
        [
            [[(0, 0), (1, 0), (1, 1), (0, 1)]],
            [EXTERIOR, HOLE],
            [[(0, 0), (0, 2), (1, 2), (3, 0)]],
            [[(0, 0), (3, 0), (3, 3), (0, 3), (0, 1), (1, 1), (1, 2), (2, 2), (2, 0.5), (0, 0.5)]],
            [[(0, 0), (1, 1), (2, 2)]],
        ]
    )


def star(rng: np.random.Generator, number: int) -> np.ndarray:
    """A random ring about the origin, not convex as a rule."""
    angles = 2 * np.pi * (np.arange(number) + rng.uniform(-0.3, 0.3, number)) / number
    return rng.uniform(0.3, 1.0, (number, 1)) * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def exact_moment(ring: np.ndarray, a: int, b: int) -> Fraction:
    """Integral of x^a y^b over a counter-clockwise ring in rational arithmetic (Shi 1988)."""
    points = [(Fraction(float(x)), Fraction(float(y))) for x, y in ring]
    total = Fraction(0)
    for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1], strict=True):
        inner = sum(
            comb(a, k)
            * comb(b, j)
            * factorial(k + j)
            * factorial(a + b - k - j)
            * x0**k
            * x1 ** (a - k)
            * y0**j
            * y1 ** (b - j)
            for k in range(a + 1)
            for j in range(b + 1)
        )
        total += (x0 * y1 - x1 * y0) * Fraction(inner) / factorial(a + b + 2)
    return total


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(20261121)


@pytest.fixture
def exact():
    return exact_moment


@pytest.fixture
def random_star():
    return star
