"""What an interface law is to contact: limits of force, and when a bond breaks."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from integration.arrays import Floats
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
    fracture_energy, shear_fracture_energy
        J/m2 of an opening and of a sliding bond; None is brittle, or for shear the same as opening.
    residual_friction_angle
        rad, where a bond is broken; None is ``friction_angle``.
    dilation_angle
        rad: sliding by ``s`` lifts the faces apart by ``s tan(dilation_angle)``.
    dilation_slip
        m of sliding after which nothing lifts any more.
    damping
        Share of critical damping of the normal spring while it is pressed, >= 0.
    """

    friction_angle: float
    cohesion: float = 0.0
    tensile_strength: float = 0.0
    bonded: bool = False
    normal_stiffness: float | None = None
    shear_stiffness: float | None = None
    fracture_energy: float | None = None
    shear_fracture_energy: float | None = None
    residual_friction_angle: float | None = None
    dilation_angle: float = 0.0
    dilation_slip: float = float("inf")
    damping: float = 0.0

    softens: ClassVar[bool] = False
    """Whether strength is lost by and by; such a law defines `secant` and `damaged`."""

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

    def friction(self, damage: Floats) -> Floats:
        """Return the tangent (m,) of the friction angle: residual where the bond is broken."""
        intact, residual = np.tan(self.friction_angle), np.tan(self._residual_angle)
        held = ~np.asarray(self.bonded) | (damage < 1)
        return np.asarray(np.where(held, intact, residual), dtype=float)

    def secant(self, damage: Floats, stiffness: Floats) -> Floats:
        """Return the share (m,) of the normal stiffness (Pa/m) left to bonds that are open."""
        raise NotImplementedError

    def damaged(
        self, damage: Floats, opening: Floats, sliding: Floats, stiffness: Floats
    ) -> Floats:
        """Return the damage (m,) after an opening and a sliding from bonds with ``damage``.

        Parameters
        ----------
        damage
            (m,) at the start of the step.
        opening
            (m,) gap of the bond at the end of it, elastic part and crack (m).
        sliding
            (m,) by how much it slid in the step beyond its elastic stretch, >= 0 (m).
        stiffness
            (m,) of the whole bond in the normal direction (Pa/m).
        """
        raise NotImplementedError

    @property
    def _residual_angle(self) -> float:
        residual = self.residual_friction_angle
        return self.friction_angle if residual is None else residual


INTERFACE_LAWS = Registry[type[InterfaceLaw]](
    "interface law",
    InterfaceLaw,
    {
        "mohr_coulomb": "nmm.interfaces.mohr_coulomb:MohrCoulomb",
        "linear_softening": "nmm.interfaces.softening:LinearSoftening",
        "bilinear_softening": "nmm.interfaces.softening:BilinearSoftening",
    },
)
