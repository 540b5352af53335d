"""Integrals of monomials over polygons: exact in rational arithmetic."""

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from integration.moments import moments
from integration.monomials import exponents
from integration.polygons import Polygons
from nmm.verification.base import Case, Check, Checks, limit

if TYPE_CHECKING:
    from pathlib import Path

OUTLINE = [(0, 0), (4, 0), (4, 3), (2, 1), (0, 3)]
HOLE = [(1.5, 0.25), (1.5, 0.75), (2.5, 0.75), (2.5, 0.25)]
INTEGRALS = {
    (0, 0): Fraction(15, 2),
    (1, 0): Fraction(15),
    (0, 1): Fraction(101, 12),
    (2, 0): Fraction(1039, 24),
    (1, 1): Fraction(101, 6),
    (0, 2): Fraction(1267, 96),
    (3, 0): Fraction(559, 4),
    (2, 1): Fraction(4057, 80),
    (3, 3): Fraction(2450529, 4480),
    (6, 0): Fraction(744729, 128),
    (0, 6): Fraction(13433787, 57344),
    (4, 2): Fraction(54132677, 53760),
}
"""Powers of x and y and the integral over the notched polygon less its hole."""

THIN = 1e-12
SLIVER = {
    (0, 0): THIN / 2,
    (1, 0): THIN / 3,
    (0, 1): THIN**2 / 6,
    (2, 0): THIN / 4,
    (1, 1): THIN**2 / 8,
    (0, 2): THIN**3 / 12,
}
"""Of the triangle (0, 0), (1, 0), (1, 1e-12)."""


def column(power: tuple[int, int]) -> int:
    """Place of a monomial among all."""
    return int(exponents(sum(power)).tolist().index(list(power)))


class Moments(Case):
    """Exact integrals over a notched polygon with a hole, a sliver and a square far away.

    The sense of the rings, and vertices that are twice there or on a line, must not matter.
    """

    name = "D1"
    title = "Integrals of monomials over polygons"
    source = "Rational arithmetic over the triangles of a fan"
    formulations = ("any cover",)

    def checks(self, formulation: str) -> Checks:
        found: Checks = {}
        digits = "13 digits of each integral by itself"
        holed = moments(Polygons.from_rings([[OUTLINE, HOLE]]), 6, origin=(0, 0))[0]
        for power, exact in INTEGRALS.items():
            name = "x^{} y^{} of the notched polygon".format(*power)
            found[name] = Check(float(holed[column(power)]), float(exact), 1e-13, digits)
        turned = moments(Polygons.from_rings([[OUTLINE[::-1], HOLE]]), 6, origin=(0, 0))[0]
        doubled = [*OUTLINE[:1], *OUTLINE[:2], (4, 1.5), *OUTLINE[2:]]
        more = moments(Polygons.from_rings([[doubled, HOLE]]), 6, origin=(0, 0))[0]
        for words, other in (("turned rings", turned), ("more vertices", more)):
            change = float(np.abs(other / holed - 1).max())
            found[f"change by {words}"] = limit(change, 1e-13, digits)
        thin = moments(Polygons.from_vertices([[(0, 0), (1, 0), (1, THIN)]]), 2, origin=(0, 0))[0]
        for power, value in SLIVER.items():
            name = "x^{} y^{} of the sliver".format(*power)
            found[name] = Check(float(thin[column(power)]), value, 1e-13, digits)
        square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
        far = moments(Polygons.from_vertices([square + 1e6]), 4)[0]
        reason = "the centroid itself is rounded to 1e-10 there"
        for power, value in {(0, 2): 1 / 12, (2, 2): 1 / 144}.items():
            name = "central x^{} y^{} of a square at (1e6, 1e6)".format(*power)
            found[name] = Check(float(far[column(power)]), value, 1e-9, reason)
        return found

    def sketch(self, path: "Path") -> bool:
        """Draw the notched polygon."""
        from nmm.verification.sketches import sketch_polygons

        sketch_polygons(Polygons.from_rings([[OUTLINE, HOLE]]), path)
        return True
