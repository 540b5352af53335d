"""Intensities at the tips of branched cracks, against dislocations along their arms."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.places import on_edges
from nmm.materials.elastic import Elastic
from nmm.scene.methods.cover_tables import CoverTable
from nmm.verification.base import Case, Check, Checks

NU = 0.3
UP = np.array([[0.0, 0.0], [0.0, 1.0]])
SKEW = np.array([[0.3, 0.5], [0.5, 1.0]])
"""Tension, and tension with shear, far away."""


@dataclass(frozen=True)
class BranchedCrack(Case):
    """A stem of 1 with two branches to either side in a wide plate."""

    name = "GR15"
    title = "Branched crack, intensities at all tips"
    source = (
        "Dislocations along the arms at Chebyshev's points (Erdogan and Gupta 1972), in an "
        "infinite plane; a cross by them has the 0.8636 of Rooke and Sneddon (1969)"
    )
    degrees: float = 45.0
    branch: float = 0.5
    skew: bool = False
    turn: float = 0.0
    slow = True

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return angles, a shorter branch, shear, and a turned net."""
        return [cls(), cls(30.0), cls(60.0), cls(branch=0.25), cls(skew=True), cls(turn=0.4)]

    @property
    def variant(self) -> str:
        said = f"{self.degrees:g} degrees, branches of {self.branch:g}"
        turned = f", turned by {self.turn:g} rad" if self.turn else ""
        return said + ", with shear" * self.skew + turned

    def checks(self, formulation: str) -> Checks:
        angles = np.radians([180.0, self.degrees, -self.degrees])
        lengths, stress = np.array([1.0, self.branch, self.branch]), SKEW if self.skew else UP
        wanted = by_dislocations(angles, lengths, stress)
        radius = self.branch / 2
        found = by_manifold(angles, lengths, stress, radius / 5, radius, self.turn)
        largest = float(np.abs(wanted).max())
        reason = "domains of five cells, measured up to 4e-3; the square plate adds 0.3 %"
        parts = {"K_I": (found.real, wanted.real), "K_II": (found.imag, wanted.imag)}
        arms = ("stem", "left branch", "right branch")
        return {
            f"{name} of the {arm}": Check(float(one), float(right), 0.01, reason, largest)
            for name, (here, there) in parts.items()
            for arm, one, right in zip(arms, here, there, strict=True)
        }


def by_dislocations(angles: Floats, lengths: Floats, stress: Floats, n: int = 40) -> Floats:
    """K_I + i K_II at the ends of straight arms from the origin of an infinite plane.

    Dislocations along the arms, ``g(t) / sqrt(1 - t^2)`` at Chebyshev's points, free the faces of
    the stress far away (potentials of Muskhelishvili; Erdogan and Gupta 1972 for the rule). Those
    of all arms close in sum; at the crossing ``g`` vanishes on all arms but the last.
    """
    arms, out = len(angles), np.exp(1j * angles)
    t = np.cos((2 * np.arange(1, n + 1) - 1) * np.pi / (2 * n))
    x = np.cos(np.arange(1, n) * np.pi / n)
    share = np.pi / n * lengths / 2
    matrix, side = np.zeros((2 * arms * n, 2 * arms * n)), np.zeros(2 * arms * n)
    for m in range(arms):
        z, first = lengths[m] * (1 + x) / 2 * out[m], 2 * m * (n - 1)
        normal = 1j * out[m]
        far = complex(*(stress @ [normal.real, normal.imag])) / normal
        side[first : first + n - 1] = -far.real
        side[first + n - 1 : first + 2 * (n - 1)] = far.imag
        for q in range(arms):
            z0 = lengths[q] * (1 + t) / 2 * out[q]
            d = z[:, None] - z0
            for part, size in enumerate((1.0, 1j)):
                inner = -size / d**2 * np.conj(z)[:, None]
                inner = inner + np.conj(size) / d + size * np.conj(z0) / d**2
                pull = share[q] * (2 * (size / d).real + out[m] ** 2 * inner)
                columns = slice((2 * q + part) * n, (2 * q + part + 1) * n)
                matrix[first : first + n - 1, columns] = pull.real
                matrix[first + n - 1 : first + 2 * (n - 1), columns] = pull.imag
    powers = np.arange(n)
    weights = np.where(powers == 0, 1.0, 2.0)[:, None] / n * np.cos(powers[:, None] * np.arccos(t))
    last = 2 * arms * (n - 1)
    for part in (0, 1):
        for q in range(arms):
            matrix[last + part, (2 * q + part) * n : (2 * q + part + 1) * n] = share[q]
    for q in range(2 * (arms - 1)):
        matrix[last + 2 + q, q * n : (q + 1) * n] = (-1.0) ** powers @ weights
    g = np.linalg.solve(matrix, side).reshape(arms, 2, n) @ weights.sum(axis=0)
    # The traction at a distance r ahead of an end is pi g sqrt(l / r).
    found = np.pi * np.sqrt(2 * np.pi * lengths) * (g[:, 0] + 1j * g[:, 1]) / out
    return np.asarray(found.conj())


def by_manifold(
    angles: Floats, lengths: Floats, stress: Floats, size: float, radius: float, turn: float
) -> Floats:
    """K_I + i K_II at the ends of the arms in a square thirty times as wide as the first arm."""
    from nmm.fracture.stress_intensity import stress_intensity
    from nmm.model.from_polygons import solid
    from nmm.stepping.drive.linear_statics import equilibrium, traction

    c, s = np.cos(turn), np.sin(turn)
    axes = np.array([[c, -s], [s, c]])
    ring = 15.0 * np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])
    ends = (lengths * np.array([np.cos(angles), np.sin(angles)])).T @ axes.T
    focus = [[0.0131, 0.0072], *ends.tolist()]
    cover = CoverTable(type="graded", size=size, degree=1, options={"focus": focus})
    cracks = [[[0, 0], end] for end in ends.tolist()]
    model = solid(
        Polygons.from_vertices([ring]), cover, [Elastic(1.0, NU)], "strain", cracks=cracks
    )
    outer = on_edges(model.manifold, model.cut.boundary.crack < 0, 8)
    pull = axes @ stress @ axes.T
    unknowns = equilibrium(model, [traction(model, outer, lambda p, n: n @ pull)]).state.deformation
    found = np.zeros(len(ends), dtype=complex)
    for tip in range(len(ends)):
        one = stress_intensity(model, unknowns, tip, radius, kappa=3 - 4 * NU)
        arm = np.hypot(*(ends - one.point).T).argmin()
        found[arm] = one.opening + 1j * one.sliding
    return found
