"""Von Mises plasticity with linear isotropic hardening."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from integration.arrays import Bools, Floats
from nmm.errors import FormulationError
from nmm.materials.base import History, Response
from nmm.materials.crack_band import SofteningPlasticity, check_residual
from nmm.materials.plasticity import flowed, inelastic
from nmm.materials.return_mapping.projected_return import projected_return
from nmm.materials.return_mapping.radial_return import RadialReturn, radial_return


@dataclass(frozen=True)
class VonMisesPlasticity(SofteningPlasticity):
    """Yield where ``sqrt(3/2 s : s)`` reaches ``yield_stress + hardening_modulus * p``.

    The step is implicit (backward Euler): the radial return in plane strain, the return projected
    on plane stress there (Simo and Taylor 1985, 1986), each with its consistent tangent.

    Attributes
    ----------
    yield_stress
        In uniaxial tension (Pa).
    hardening_modulus
        Slope of the uniaxial stress over the plastic strain (Pa); 0 is perfectly plastic.
    softening_energy
        J/m2 that a band of flow takes for its area until its yield stress is the residual one,
        beyond what that takes; None is no softening.
    residual_stress
        Yield stress that is left (Pa).

    Notes
    -----
    The yield stress falls along a line over the accumulated plastic strain. A band is as wide as a
    cell of size ``h``: the slope ``-(s_y - s_r)^2 h / (2 G)`` makes it take the energy ``G``
    whatever its width (crack band; Bazant and Oh 1983).

    Internal variables: ``plastic_strain`` (4: xx, yy, 2 xy, zz), ``accumulated_plastic_strain`` p,
    and ``stress_zz`` (Pa).
    """

    yield_stress: float
    hardening_modulus: float = 0.0
    residual_stress: float = 0.0

    def __post_init__(self) -> None:
        if not self.yield_stress > 0:
            raise FormulationError(
                f"yield_stress: {self.yield_stress}: expected a stress in Pa, > 0: correct it"
            )
        if not self.hardening_modulus >= 0:
            raise FormulationError(
                f"hardening_modulus: {self.hardening_modulus}: expected a modulus in Pa, >= 0: "
                "0 is perfectly plastic; softening is given by softening_energy"
            )
        energy = self.softening_energy
        if energy is not None and (self.hardening_modulus or not energy > 0):
            raise FormulationError(
                f"softening_energy: {energy}: expected an energy in J/m2, > 0, of a "
                "law that does not harden: correct it, or remove hardening_modulus"
            )
        left = "residual_stress", self.residual_stress
        check_residual(energy, left, self.yield_stress, "a stress from 0 to below the yield stress")

    def cell_limit(self, energy: float) -> tuple[float, str]:
        """Return the size at which plastic strain would exceed the elastic strain released."""
        shear = self.young_modulus / 2 / (1 + self.poisson_ratio)
        return 3 * shear / self._slope(1.0), ""

    def _slope(self, size: float | Floats) -> Any:
        """Slope by which the yield stress decreases with plastic strain in cells of a size (Pa)."""
        assert self.softening_energy is not None
        return (self.yield_stress - self.residual_stress) ** 2 * size / (2 * self.softening_energy)

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        if self.softening_energy is not None:
            return self._softened(strain, history)
        found = (projected_return if plane == "stress" else radial_return)(
            strain,
            inelastic(history),
            history["accumulated_plastic_strain"][:, 0],
            (self.young_modulus, self.poisson_ratio, self.yield_stress, self.hardening_modulus),
        )
        return _flowed(history, found)

    def _softened(self, strain: Floats, history: History) -> Response:
        """Return the response in plane strain during softening, and after it."""
        slope = self._slope(history["cell_size"][:, 0])
        last = (self.yield_stress - self.residual_stress) / slope
        before = history["accumulated_plastic_strain"][:, 0]

        def returned(left: Bools) -> RadialReturn:
            yields = np.where(left, self.residual_stress, self.yield_stress)
            falls = np.where(left, 0.0, -slope)
            constants = self.young_modulus, self.poisson_ratio, yields, falls
            return radial_return(strain, inelastic(history), before, constants)

        found = returned(before >= last)
        if (found.accumulated > last).any():  # some came to the end of the line in this step
            found = returned(found.accumulated > last)
        return _flowed(history, found)

    def energy(self, stress: Floats, history: History, plane: str) -> Floats:
        """Return the elastic energy and the energy of hardening, ``H p^2 / 2``."""
        hard = self.hardening_modulus * history["accumulated_plastic_strain"][:, 0] ** 2
        return np.asarray(super().energy(stress, history, plane) + hard / 2)


def _flowed(history: History, found: RadialReturn) -> Response:
    return flowed(history, found.stress, found.tangent, found.plastic_strain, found.accumulated)
