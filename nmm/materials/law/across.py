"""Restraint across the plane: what a law does there, of what it does in the plane."""

from abc import ABC, abstractmethod

import numpy as np

from integration.arrays import Floats
from nmm.materials.law.responses import FiniteResponse, History


class AcrossThePlane(ABC):
    """Strains and stresses of a law by restraint across the plane, by default those of elasticity.

    ``plane`` is "stress" or "strain" everywhere.
    """

    @abstractmethod
    def stiffness(self, plane: str) -> Floats:
        """See `nmm.materials.base.Law.stiffness`."""

    @abstractmethod
    def potential(self, strain: Floats, plane: str) -> FiniteResponse:
        """See `nmm.materials.base.Law.potential`."""

    @property
    @abstractmethod
    def modulus(self) -> float:
        """See `nmm.materials.base.Law.modulus`."""

    def free_strain(self, plane: str) -> Floats:
        """Return the strain (3,) in the plane of a free body under a unit isotropic thermal strain.

        In plane strain it is larger, as the third direction is fixed (Timoshenko and Goodier 1951):
        ``1 + nu`` for an isotropic `stiffness`; an anisotropic law overrides it.
        """
        restrained = 0.0
        if plane == "strain":
            along, across = self.stiffness(plane)[0, :2]
            restrained = float(across / (along + across))
        return np.array([1 + restrained, 1 + restrained, 0.0])

    def pore_share(self, plane: str) -> Floats:
        """Return the in-plane stress (3,) that a unit pore pressure carries.

        It is 1 in plane strain. In plane stress the free expansion out of the plane reduces it to
        ``(1 - 2 nu) / (1 - nu)`` for an isotropic `stiffness`; an anisotropic law overrides it.
        """
        share = 1.0
        if plane == "stress":
            along, across = self.stiffness(plane)[0, :2]
            share = float((along - 2 * across) / (along - across))
        return np.array([share, share, 0.0])

    def across_share(self, plane: str) -> Floats:
        """Return the elastic stress across the plane (1) of unit stresses (3,) in it.

        ``-S_3j / S_33`` of the compliance ``S`` in plane strain, ``nu`` if isotropic: the share by
        which restraint raises `free_strain`, whatever the axes.
        """
        if plane == "stress":
            return np.zeros(3)
        return self.free_strain("strain") - self.free_strain("stress")

    def stress_across(self, stress: Floats, history: History, plane: str) -> Floats:
        """Return the stress across the plane (m,) at a stress (m, 3) with internal variables (Pa).

        It is the variable ``stress_zz`` of laws that keep one. By default it is the elastic one,
        less that of the thermal strain that is held across.
        """
        if "stress_zz" in history:
            return history["stress_zz"][:, 0]
        found = stress @ self.across_share(plane)
        if plane == "strain" and "swelling" in history:
            found = found - self.modulus_across * history["swelling"][:, 0]
        return np.asarray(found)

    def potential_across(self, strain: Floats, plane: str) -> Floats:
        """Return the second Piola-Kirchhoff stress across (m,) at Green strains (m, 3) (Pa)."""
        return np.asarray(self.potential(strain, plane).stress @ self.across_share(plane))

    @property
    def modulus_across(self) -> float:
        """Young's modulus across the plane (Pa), by default that in it."""
        return self.modulus
