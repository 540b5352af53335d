"""What a material bears at a crack tip: K_Ic, or the fracture energy that stands for it."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats


@dataclass(frozen=True)
class Toughness:
    """Toughness of a material.

    Attributes
    ----------
    intensity
        K_Ic (Pa m^1/2); None where the energy is given.
    energy
        G_c (J/m2); None where the intensity is given.

    Raises
    ------
    ValueError
        Both given, or none, or one that is not above zero.
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
        """K_Ic (n,) at tips where E' is ``stiff`` (n,) (Pa): sqrt(E' G_c) (Irwin 1957)."""
        if self.intensity is not None:
            return np.full_like(stiff, self.intensity)
        assert self.energy is not None
        return np.sqrt(stiff * self.energy)

    def energies(self, stiff: Floats) -> Floats:
        """G_c (n,) at tips where E' is ``stiff`` (n,) (Pa): K_Ic^2 / E'."""
        if self.energy is not None:
            return np.full_like(stiff, self.energy)
        assert self.intensity is not None
        return np.asarray(self.intensity**2 / stiff)
