"""What laws of plastic flow share: variables that remember it, and elastic energy beside them."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.materials.base import History, Response
from nmm.materials.elastic import Elastic, elastic_energy
from nmm.materials.tensors import SPHERICAL, TWICE


@dataclass(frozen=True)
class Plastic(Elastic):
    """Base of elastoplastic laws; they define `update`.

    Notes
    -----
    Internal variables: ``plastic_strain`` (4: xx, yy, 2 xy, zz), ``accumulated_plastic_strain``
    and ``stress_zz`` (Pa).
    """

    @property
    def swells(self) -> bool:
        return True

    @property
    def rests(self) -> bool:
        return True

    def variables(self, plane: str) -> History:
        return {
            "plastic_strain": np.zeros(4),
            "accumulated_plastic_strain": np.zeros(1),
            "stress_zz": np.zeros(1),
        }

    def under(self, strain: Floats, stress: Floats, across: Floats) -> History:
        """See `Law.under`: strain that is not elastic is plastic from the start."""
        modulus, poisson = self.young_modulus, self.poisson_ratio
        direct = np.column_stack([stress[:, :2], across])
        elastic = ((1 + poisson) * direct - poisson * direct.sum(axis=1)[:, None]) / modulus
        sheared = 2 * (1 + poisson) / modulus * stress[:, 2]
        whole = np.column_stack([elastic[:, :2], sheared, elastic[:, 2]])
        given = np.column_stack([strain, np.zeros(len(strain))])
        return {"plastic_strain": given - whole, "stress_zz": across[:, None]}

    def energy(self, stress: Floats, history: History, plane: str) -> Floats:
        """Return the elastic energy."""
        zz = history["stress_zz"][:, 0]
        return elastic_energy(self.young_modulus, self.poisson_ratio, stress, zz)


def inelastic(history: History) -> Floats:
    """Return the inelastic strain (m, 4: xx, yy, 2 xy, zz): plastic and thermal."""
    flow, swelling = history["plastic_strain"], history.get("swelling")
    return flow if swelling is None else flow + swelling * SPHERICAL


def flowed(
    history: History, stress: Floats, tangent: Floats, strain: Floats, accumulated: Floats
) -> Response:
    """Return the response of points with a new `inelastic` strain (m, 4).

    Stress (m, 4) is xx, yy, xy, zz.
    """
    swelling = history.get("swelling")
    variables = {
        "plastic_strain": strain if swelling is None else strain - swelling * SPHERICAL,
        "accumulated_plastic_strain": accumulated[:, None],
        "stress_zz": stress[:, 3:],
    }
    return Response(stress[:, :3], tangent, variables)


def grown(history: History, strain: Floats) -> Floats:
    """Return the accumulated plastic strain (m,) at a new `inelastic` strain (m, 4).

    Only its deviatoric part counts.
    """
    before = inelastic(history)
    if strain is before:  # nothing flows
        return history["accumulated_plastic_strain"][:, 0]
    flow = strain - before
    flow = flow - flow[:, [0, 1, 3]].sum(axis=1)[:, None] / 3 * SPHERICAL
    size = np.sqrt(2 / 3 * (flow**2 / TWICE).sum(axis=1))
    return np.asarray(history["accumulated_plastic_strain"][:, 0] + size)
