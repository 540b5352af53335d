"""Intensities of cracks that start at a hole."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from integration.polygons import Polygons
from nmm.assembly.places import on_edges
from nmm.formulation import Formulation
from nmm.verification.base import Check, Checks, limit
from nmm.verification.continuum import Problem, load, middles, pin, traction_of
from nmm.verification.problems.cracks.hole_with_cracks import HoleWithCracks
from nmm.verification.problems.cracks.stationary_cracks import CrackedBody, Line

HALF = 3.0
"""Half of the side of the square that is cut out of the plane, in radii of the hole."""

CORNERS = 256
"""Corners of the hole."""

RADIUS = 0.15
"""Of the domain of the interaction integrals."""


@dataclass(frozen=True)
class CracksAtHole(CrackedBody):
    """A square of three radii about a hole with one crack or two, under its exact tractions."""

    name = "A10 holes"
    title = "Cracks from a hole in tension"
    source = (
        "Singular integral equation of dislocations beside a free circle (Erdogan and Gupta 1972). "
        "Two cracks agree with Newman (1971) to 0.1 %; for one crack of a fifth of the radius "
        "Bowie's 2.30 (1956) is 3 % low"
    )
    size = 0.125
    both: bool = False
    length: float = 0.2
    parameters: ClassVar = {"both": (False, True), "length": (0.2, 0.5)}

    @property
    def variant(self) -> str:
        return f"{'two cracks' if self.both else 'one crack'}, length {self.length:g}"

    @property
    def cracks(self) -> Sequence[Line]:
        """From within the hole to the tips."""
        sides = (1.0, -1.0) if self.both else (1.0,)
        return [[[0.9 * side, 0.0], [(1 + self.length) * side, 0.0]] for side in sides]

    def problem(self, formulation: Formulation) -> Problem:
        """Return the square with three pins on its sides."""
        turn = 2 * np.pi * np.arange(CORNERS) / CORNERS
        hole = np.stack([np.cos(turn), np.sin(turn)], axis=1)
        outer = HALF * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
        region = Polygons.from_rings([[outer, hole]]).oriented()
        model = self.cracked(formulation, region, *self.cracks)
        far = np.abs(middles(model)).max(axis=1) > HALF - 1e-9
        exact = HoleWithCracks(self.length, self.both)
        pins = [pin(model, [HALF, HALF]), pin(model, [HALF, -HALF], (True, False))]
        place = on_edges(model.manifold, far, 16)
        pull = load(model, place, lambda p, n: traction_of(exact.stress(p), n))
        return Problem(model, pins, [pull])

    def checks(self, formulation: str) -> Checks:
        expected = HoleWithCracks(self.length, self.both).intensity
        checks: Checks = {}
        for number, tip in enumerate(self.tips(formulation, 0, RADIUS)):
            checks |= {
                f"K_I at tip {number} (Pa m^0.5)": Check(
                    tip.opening, expected, 5e-3, "aim 1 %; measured 3e-3"
                ),
                f"|K_II| / K_I at tip {number}": limit(
                    abs(tip.sliding) / tip.opening, 5e-3, "an unsymmetric mesh"
                ),
            }
        return checks
