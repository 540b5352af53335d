"""Stress and energy of laws of finite strain under given deformation gradients."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.assembly.finite_strain.gradients import green, kirchhoff, strain_rates, volumes
from nmm.materials.elastic import Elastic
from nmm.materials.neo_hookean import NeoHookean
from nmm.verification.base import Case, Check, Checks, limit

if TYPE_CHECKING:
    from nmm.materials.base import Law

LAWS: "dict[str, Law]" = {
    "St Venant and Kirchhoff": Elastic(1.0, 0.3),
    "neo-Hooke": NeoHookean(1.0, 0.3),
}
# By law: amount of shear, Cauchy stress (xx, yy, xy) and energy.
SHEARED = {
    "St Venant and Kirchhoff": ((0.5, (0.3064903846, 0.1682692308, 0.2764423077), 0.05859375),),
    "neo-Hooke": (
        (0.5, (0.0961538462, 0.0, 0.1923076923), 0.0480769231),
        (1.0, (0.3846153846, 0.0, 0.3846153846), 0.1923076923),
    ),
}
# Nominal stress of a gradient without symmetry, and the energy.
SKEW = [[1.4, 0.3], [-0.2, 0.8]]
SKEWED = {
    "St Venant and Kirchhoff": (
        [[0.8632692308, 0.1720192308], [-0.0390384615, 0.0653846154]],
        0.15459375,
    ),
    "neo-Hooke": (
        [[0.3424437178, 0.0663801602], [-0.0034163942, -0.0353388785]],
        0.0846276283,
    ),
}
# Of neo-Hooke with free sides: stretch, lateral stretch and nominal stress.
PULLED = (
    (0.8, 1.0948760560, -0.2686315279),
    (1.25, 0.9038435519, 0.2294051796),
    (1.5, 0.8249236422, 0.4024361499),
)


def deformed(law: "Law", f: Floats) -> tuple[Floats, Floats, float]:
    """Return Cauchy stress (xx, yy, xy), nominal stress (2, 2) and energy in plane strain."""
    gradient = (np.asarray(f, dtype=float) - np.eye(2)).reshape(1, 4)
    found = law.potential(green(gradient), "strain")
    cauchy = (kirchhoff(gradient, found.stress) / volumes(gradient)[:, None])[0]
    nominal = np.einsum("mij,mi->mj", strain_rates(gradient), found.stress).reshape(2, 2)
    return cauchy, nominal, float(found.energy[0])


@dataclass(frozen=True)
class OfEachLaw(Case):
    """What is asked of every law alike, without a body."""

    law: str = "neo-Hooke"
    parameters: ClassVar = {"law": LAWS}
    label = "{0.law}"


class DeformedMatter(OfEachLaw):
    """Simple shear, a gradient without symmetry, and pull with free sides; no body is solved."""

    name = "FK3"
    title = "Laws of finite strain under given gradients"
    source = "E = 1, nu = 0.3: derivatives of the energies by computer algebra"

    def checks(self, formulation: str) -> Checks:
        law, digits = LAWS[self.law], "digits of the table"
        checks = {}
        for shear, stress, energy in SHEARED[self.law]:
            found, _, stored = deformed(law, np.array([[1, shear], [0, 1]]))
            off = float(np.abs(found - stress).max())
            checks[f"shear of {shear:g}: error of Cauchy's stress"] = limit(off, 1e-9, digits)
            checks[f"shear of {shear:g}: energy"] = Check(stored, energy, 1e-9, digits, 1.0)
        wanted, energy = SKEWED[self.law]
        _, nominal, stored = deformed(law, np.array(SKEW))
        off = float(np.abs(nominal - wanted).max())
        checks["no symmetry: error of the nominal stress"] = limit(off, 1e-9, digits)
        checks["no symmetry: energy"] = Check(stored, energy, 1e-9, digits, 1.0)
        for stretch, lateral, pull in PULLED if self.law == "neo-Hooke" else ():
            _, nominal, _ = deformed(law, np.diag([stretch, lateral]))
            off = float(np.abs(nominal - np.diag([pull, 0.0])).max())
            label = f"stretch of {stretch:g}, free sides: error of the nominal stress"
            checks[label] = limit(off, 1e-9, digits)
        return checks


class TurnedMatter(OfEachLaw):
    """A stressed body is turned: its energy stays, its stress turns, whatever the angle."""

    name = "FK6"
    title = "Laws of finite strain in a body that is turned"
    source = "Objectivity: W(R F) = W(F), s(R F) = R s(F) R^T"

    def checks(self, formulation: str) -> Checks:
        """Turn a gradient without symmetry by 30, 90 and 200 degrees in one step."""
        law, checks = LAWS[self.law], {}
        stress, _, energy = deformed(law, np.array(SKEW))
        full = stress[[[0, 2], [2, 1]]]
        for degrees in (30.0, 90.0, 200.0):
            c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
            turn = np.array([[c, -s], [s, c]])
            turned, _, stored = deformed(law, turn @ SKEW)
            off = np.abs(turned[[[0, 2], [2, 1]]] - turn @ full @ turn.T).max()
            checks[f"{degrees:g} degrees: change of energy"] = limit(
                abs(stored / energy - 1), 1e-12, "rounding"
            )
            checks[f"{degrees:g} degrees: error of stress"] = limit(float(off), 1e-12, "rounding")
        return checks
