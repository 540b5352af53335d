"""What an interface law is to contact: limits of force, and when a bond breaks."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from integration.arrays import Bools, Floats
from nmm.interfaces.limits import Limits
from nmm.registry import Registry


@dataclass(frozen=True)
class InterfaceLaw(ABC):
    """Base of interface laws; a frozen set of parameters in SI units.

    Attributes
    ----------
    friction_angle
        rad.
    cohesion, tensile_strength
        Pa.
    bonded
        Whether strength acts from the start and is lost for good at the first failure.
    normal_stiffness, shear_stiffness
        Pa/m of the joint itself; None leaves a numerical penalty.
    fracture_energy
        J/m2; None is brittle.
    """

    friction_angle: float
    cohesion: float = 0.0
    tensile_strength: float = 0.0
    bonded: bool = False
    normal_stiffness: float | None = None
    shear_stiffness: float | None = None
    fracture_energy: float | None = None

    @property
    def makes_joints(self) -> bool:
        """Whether shared edges are followed as joints from the start."""
        return self.bonded or self.cohesion > 0 or self.normal_stiffness is not None

    @abstractmethod
    def limits(self, length: Floats, damage: Floats, thickness: float) -> Limits:
        """Return the largest forces of contacts with ``length`` and ``damage`` (m,)."""

    @abstractmethod
    def overload(
        self, normal_force: Floats, shear_force: Floats, length: Floats, thickness: float
    ) -> Floats:
        """Return force over strength (m,) of intact bonds; above 1 a bond cannot hold."""

    def breaks_in_tension(self, normal_force: Floats, length: Floats, thickness: float) -> Bools:
        """Say which overloaded bonds (m,) fail by pull rather than by shear."""
        return normal_force >= self.tensile_strength * length * thickness


INTERFACE_LAWS = Registry[type[InterfaceLaw]](
    "interface law", {"mohr_coulomb": "nmm.interfaces.mohr_coulomb:MohrCoulomb"}
)
