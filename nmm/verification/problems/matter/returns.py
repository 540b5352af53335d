"""Stresses beyond a yield surface that return to it, whichever of the three is across the plane."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.materials.drucker_prager import DruckerPragerPlasticity
from nmm.materials.mohr_coulomb import MohrCoulombPlasticity
from nmm.verification.base import Case, Check, Checks, limit

if TYPE_CHECKING:
    from nmm.materials.base import Law

# kPa: E = 1e5, nu = 0.25, c = 20, phi = 30 degrees.
ELASTIC, COHESION, PHI = (1e5, 0.25), 20.0, np.radians(30)
PYRAMID = {
    30: (
        ((-50, -120, -400), (-110.239323, -135.059831, -400)),
        ((30, -60, -200), (-43.572656, -78.393164, -200)),
        ((-20, -20, -300), (-76.905989, -76.905989, -300)),
        ((-10, -250, -260), (-64.162771, -261.770346, -261.770346)),
        ((40, 30, 10), (26.427344, 26.427344, 10)),
        ((80, 75, 60), (34.641016, 34.641016, 34.641016)),
    ),
    10: (
        ((-50, -120, -400), (-101.864065, -126.684573, -374.874226)),
        ((-20, -20, -300), (-64.247086, -64.247086, -262.023291)),
        ((-10, -250, -260), (-59.002062, -246.288218, -246.288218)),
        ((40, 30, 10), (28.334356, 28.334356, 15.721037)),
        ((25, 20, -10), (20.489117, 19.418608, -7.814683)),
        ((60, -10, -40), (16.745605, -15.574903, -19.045218)),
    ),
}
"""By the dilation angle (degrees): principal stresses of the trial, and those it returns to."""
CONE = (
    ((-50, -120, -400), (-120.876615, -165.214321, -342.565144)),
    ((80, 75, 60), (34.641016, 34.641016, 34.641016)),
    ((25, 20, -10), (18.119222, 14.950725, -4.060261)),
)
"""The same for a dilation of 10 degrees."""
DIGITS = "six digits behind the point"


def returned(law: "Law", trial: Sequence[float], turn: float = 0.0) -> Floats:
    """Principal stresses (3,), the largest first, that a trial returns to.

    Parameters
    ----------
    law
        With a history of plastic strain, of elastic constants `ELASTIC`.
    trial
        Principal stresses; the last is across the plane.
    turn
        Angle of the first from x (rad).
    """
    stress = np.array(trial, dtype=float)
    e, nu = ELASTIC
    strain = ((1 + nu) * stress - nu * stress.sum()) / e
    history = {name: np.tile(one, (1, 1)) for name, one in law.variables("strain").items()}
    history["plastic_strain"][0, 3] = -strain[2]
    c, s = np.cos(turn), np.sin(turn)
    axes = np.array([[c, -s], [s, c]])
    flat = axes @ np.diag(strain[:2]) @ axes.T
    given = np.array([[flat[0, 0], flat[1, 1], 2 * flat[0, 1]]])
    found = law.update(given, history, "strain", 0.0)
    xx, yy, xy = found.stress[0]
    flat = np.linalg.eigvalsh([[xx, xy], [xy, yy]])
    return np.sort([*flat, found.history["stress_zz"][0, 0]])[::-1]


def compared(law: "Law", table: Sequence[tuple[Sequence[float], Sequence[float]]]) -> Checks:
    """Compare what trials return to, each of their stresses across in turn, turned by 0.4 rad."""
    checks = {}
    for trial, expected in table:
        every = [returned(law, np.roll(trial, across).tolist(), 0.4) for across in range(3)]
        off = float(np.abs(np.array(every) - np.sort(expected)[::-1]).max())
        label = ", ".join(f"{value:g}" for value in trial)
        checks[f"({label}): error (kPa)"] = limit(off, 1e-6, DIGITS)
    return checks


@dataclass(frozen=True)
class PyramidReturns(Case):
    """Trials return to planes, edges and the apex of Mohr-Coulomb's pyramid."""

    dilation: int = 30
    name = "PL1c"
    title = "Stresses return to the pyramid of Mohr and Coulomb"
    source = "Enumeration of active planes with the conditions of Kuhn and Tucker"
    parameters: ClassVar = {"dilation": PYRAMID}  # flow that is associated, and that is not
    label = "dilation of {0.dilation} degrees"

    def checks(self, formulation: str) -> Checks:
        law = MohrCoulombPlasticity(*ELASTIC, COHESION, PHI, float(np.radians(self.dilation)))
        return compared(law, PYRAMID[self.dilation])


class ConeReturns(Case):
    """Drucker and Prager's cone meets Mohr-Coulomb in plane strain; trials return to it."""

    name = "PL6"
    title = "The cone of Drucker and Prager, matched in plane strain"
    source = "eta = 3 tan phi / sqrt(9 + 12 tan^2 phi), xi = 3 / sqrt(9 + 12 tan^2 phi)"

    def checks(self, formulation: str) -> Checks:
        checks = {}
        for match, degrees, known in (
            ("plane_strain", 30, (0.4803844614, 0.8320502943)),
            ("plane_strain", 20, (0.3355408953, 0.9218910330)),
            ("compression", 30, (0.6928203230, 1.2)),
        ):
            law = DruckerPragerPlasticity(*ELASTIC, COHESION, 0.1, match=match)
            found = law.slopes(float(np.radians(degrees)))
            for what, one, wanted in zip(("eta", "xi"), found, known, strict=True):
                label = f"{what} at {degrees} degrees, {match.replace('_', ' ')}"
                checks[label] = Check(float(one), wanted, 1e-10, "digits of the table", 1.0)
        law = DruckerPragerPlasticity(*ELASTIC, COHESION, PHI, float(np.radians(10)))
        return checks | compared(law, CONE)
