"""Laws of the bond between a bar and the material around it: shear stress over slip.

A law is its curve under growing slip. Slip that is taken back goes with the initial stiffness, and
what has slid stays; the strength left is that of the slip so far, back and forth added.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import SceneError
from nmm.materials.uniaxial import Uniaxial
from nmm.registry import Registry

# Slip up to which the power law is a line, as a share of the slip at its peak, and points beyond:
# its own stiffness is infinite at no slip.
LINE, POINTS = 0.01, 40


@dataclass(frozen=True)
class BondLaw(ABC):
    """Base of bond laws.

    Attributes
    ----------
    stiffness
        Of the bond before it slides (Pa/m).
    strength
        Largest shear stress (Pa).
    slips
        Slips (m) where the curve changes, growing.
    residual_strength
        Shear stress that friction leaves (Pa).
    """

    stiffness: float | None = None
    strength: float | None = None
    slips: tuple[float, ...] = ()
    residual_strength: float = 0.0

    @property
    @abstractmethod
    def curve(self) -> tuple[Floats, Floats]:
        """Slips (k,), the first one 0, and shear stresses there (Pa); constant beyond."""

    def __post_init__(self) -> None:
        ways, values = self.curve
        if not (np.diff(ways) > 0).all():
            raise SceneError(
                f"{self._name}: slips {', '.join(f'{1e3 * s:.4g} mm' for s in ways[1:])}: expected "
                "each larger than the one before: sort and correct them"
            )
        if (values < 0).any() or values[1] <= 0:
            raise SceneError(
                f"{self._name}: stresses {', '.join(f'{1e-6 * s:.4g} MPa' for s in values[1:])}: "
                "expected none below zero: correct strength and residual_strength"
            )

    @property
    def uniaxial(self) -> Uniaxial:
        """The law in shear stress and slip."""
        ways, values = self.curve
        stiffness = float(values[1] / ways[1])
        flowed = np.maximum(ways[1:] - values[1:] / stiffness, 0.0)
        return Uniaxial(stiffness, tuple(flowed.tolist()), tuple(values[1:].tolist()))

    @property
    def _name(self) -> str:
        return f"bond law {type(self).__name__}"

    def _asked(self, slips: int, *names: str) -> None:
        """Refuse missing constants, and a wrong number of slips."""
        missing = [name for name in names if getattr(self, name) is None]
        if missing or len(self.slips) != slips:
            given = f"{len(self.slips)} slips" if not missing else f"no {missing[0]}"
            wanted = [*names, f"{slips} slips"] if slips else [*names, "no slips"]
            raise SceneError(
                f"{self._name}: {given}: expected {', '.join(wanted)}: give what the law needs"
            )


@dataclass(frozen=True)
class LinearBond(BondLaw):
    """``tau = k s`` without failure."""

    def __post_init__(self) -> None:
        self._asked(0, "stiffness")

    @property
    def curve(self) -> tuple[Floats, Floats]:
        return np.array([0.0, 1.0]), np.array([0.0, float(self.stiffness or 0.0)])

    @property
    def uniaxial(self) -> Uniaxial:
        return Uniaxial(float(self.stiffness or 0.0))


@dataclass(frozen=True)
class PlasticBond(BondLaw):
    """``tau = k s`` up to the strength, which is then kept."""

    def __post_init__(self) -> None:
        self._asked(0, "stiffness", "strength")
        super().__post_init__()

    @property
    def curve(self) -> tuple[Floats, Floats]:
        strength, stiffness = float(self.strength or 0.0), float(self.stiffness or 1.0)
        return np.array([0.0, strength / stiffness]), np.array([0.0, strength])


@dataclass(frozen=True)
class BilinearBond(BondLaw):
    """Linear to the strength at the first of two slips and to the residual one at the second."""

    def __post_init__(self) -> None:
        self._asked(2, "strength")
        super().__post_init__()

    @property
    def curve(self) -> tuple[Floats, Floats]:
        strength = float(self.strength or 0.0)
        return np.array([0.0, *self.slips]), np.array([0.0, strength, self.residual_strength])


@dataclass(frozen=True)
class ModelCodeBond(BondLaw):
    """The law of the CEB-FIP Model Code 1990, section 3.1.1, for ribbed bars.

    ``tau = strength (s / s1)^exponent`` up to the first of three slips, the strength up to the
    second, a line down to the residual at the third. Up to a hundredth of ``s1`` it is a line.
    """

    exponent: float = 0.4

    def __post_init__(self) -> None:
        self._asked(3, "strength")
        super().__post_init__()

    @property
    def curve(self) -> tuple[Floats, Floats]:
        share = np.geomspace(LINE, 1.0, POINTS)
        strength, (first, second, third) = float(self.strength or 0.0), self.slips
        ways = np.concatenate([[0.0], first * share, [second, third]])
        rising = strength * share**self.exponent
        return ways, np.concatenate([[0.0], rising, [strength, self.residual_strength]])


BOND_LAWS = Registry[type[BondLaw]](
    "bond law",
    BondLaw,
    {
        "linear": "nmm.interfaces.bond_slip:LinearBond",
        "plastic": "nmm.interfaces.bond_slip:PlasticBond",
        "bilinear": "nmm.interfaces.bond_slip:BilinearBond",
        "model_code": "nmm.interfaces.bond_slip:ModelCodeBond",
    },
)
