"""Fracture toughness of a material: K_Ic, or the fracture energy G_c."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats


@dataclass(frozen=True)
class Toughness:
    """Fracture toughness; one of both attributes is given.

    Attributes
    ----------
    intensity
        K_Ic (Pa m^1/2); None where the energy is given.
    energy
        G_c (J/m2); None where the intensity is given.

    Raises
    ------
    ValueError
        Both or none are given, or the one given is not positive and finite.
    """

    intensity: float | None = None
    energy: float | None = None

    def __post_init__(self) -> None:
        if (self.intensity is None) == (self.energy is None):
            raise ValueError("toughness: expected K_Ic or G_c, one of them: give one")
        given = self.energy if self.intensity is None else self.intensity
        if not (given is not None and 0 < given < np.inf):
            raise ValueError(f"toughness: {given}: expected a finite number above zero")

    def intensities(self, stiff: Floats) -> Floats:
        """K_Ic = sqrt(E' G_c) (n,) at tips of effective modulus E' ``stiff`` (Pa) (Irwin 1957)."""
        if self.intensity is not None:
            return np.full_like(stiff, self.intensity)
        assert self.energy is not None
        return np.sqrt(stiff * self.energy)

    def energies(self, stiff: Floats) -> Floats:
        """G_c = K_Ic^2 / E' (n,) at tips of effective modulus E' ``stiff`` (n,) (Pa)."""
        if self.energy is not None:
            return np.full_like(stiff, self.energy)
        assert self.intensity is not None
        return np.asarray(self.intensity**2 / stiff)
