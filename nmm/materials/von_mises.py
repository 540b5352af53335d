"""Von Mises plasticity with linear isotropic hardening."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.materials.base import History, Response
from nmm.materials.plasticity import Plastic, flowed
from nmm.materials.projected_return import projected_return
from nmm.materials.radial_return import radial_return


@dataclass(frozen=True)
class VonMisesPlasticity(Plastic):
    """Yield where ``sqrt(3/2 s : s)`` reaches ``yield_stress + hardening_modulus * p``.

    The step is implicit (backward Euler): the radial return in plane strain, the return projected
    on plane stress there (Simo and Taylor 1985, 1986), each with its consistent tangent.

    Attributes
    ----------
    yield_stress
        In uniaxial tension (Pa).
    hardening_modulus
        Slope of the uniaxial stress over the plastic strain (Pa); 0 is perfectly plastic.

    Notes
    -----
    Internal variables: ``plastic_strain`` (4: xx, yy, 2 xy, zz), ``accumulated_plastic_strain`` p,
    and ``stress_zz`` (Pa).
    """

    yield_stress: float
    hardening_modulus: float = 0.0

    def __post_init__(self) -> None:
        if not self.yield_stress > 0:
            raise FormulationError(
                f"yield_stress: {self.yield_stress}: expected a stress in Pa, > 0: correct it"
            )
        if not self.hardening_modulus >= 0:
            raise FormulationError(
                f"hardening_modulus: {self.hardening_modulus}: expected a modulus in Pa, >= 0: "
                "0 is perfectly plastic; softening needs a law that knows the size of cells"
            )

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        """See `Law.update`."""
        found = (projected_return if plane == "stress" else radial_return)(
            strain,
            history["plastic_strain"],
            history["accumulated_plastic_strain"][:, 0],
            (self.young_modulus, self.poisson_ratio, self.yield_stress, self.hardening_modulus),
        )
        return flowed(found.stress, found.tangent, found.plastic_strain, found.accumulated)

    def energy(self, stress: Floats, history: History, plane: str) -> Floats:
        """Return the elastic energy and what hardening stores, ``H p^2 / 2``."""
        hard = self.hardening_modulus * history["accumulated_plastic_strain"][:, 0] ** 2
        return np.asarray(super().energy(stress, history, plane) + hard / 2)
