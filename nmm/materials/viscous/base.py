"""What laws of creep share: a step of any length, exact where strain grows at a constant rate.

The deviator is that of a spring beside Maxwell's branches, a spring and a dashpot in series each.
Over a step in which strain grows at a constant rate a branch keeps ``exp(-dt/tau)`` of its stress
and gains ``2 G phi`` times the strain, ``phi = (1 - exp(-dt/tau)) tau / dt`` (Taylor, Pister and
Goudreau 1970). Stress under given strain is exact then; strain under given stress nears its limit
from one side however long the step.
"""

from abc import abstractmethod
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.materials.base import History, Response
from nmm.materials.elastic import Elastic
from nmm.materials.return_mapping.radial_return import TWICE

MEAN = np.array([1.0, 1.0, 0.0, 1.0])
# From strain (xx, yy, 2 xy, zz) to the deviator (xx, yy, xy, zz) of the tensor.
SHAPE = np.diag([1.0, 1.0, 0.5, 1.0]) - np.outer(MEAN, MEAN) / 3


class Rheology(NamedTuple):
    """Springs and dashpots of the deviator.

    Attributes
    ----------
    spring
        Shear modulus (Pa) that is left for good.
    moduli, times
        (k,) shear moduli (Pa) of Maxwell's branches, and times of their relaxation (s).
    """

    spring: float
    moduli: Floats
    times: Floats


@dataclass(frozen=True)
class Viscous(Elastic):
    """Base of laws of creep: Young's modulus and Poisson's ratio are those of an instant.

    Notes
    -----
    Internal variables: ``strain_deviator`` (4: xx, yy, xy, zz of the tensor), ``branch_stress``
    (4 for each branch, Pa), ``stress_zz`` (Pa). Dashpots lose what the springs do not store.
    """

    @property
    @abstractmethod
    def branches(self) -> Rheology:
        """What the deviator is made of."""

    @property
    def shear(self) -> float:
        """Shear modulus of the spring of an instant (Pa)."""
        return self.young_modulus / 2 / (1 + self.poisson_ratio)

    @property
    def bulk(self) -> float:
        """Bulk modulus (Pa)."""
        return self.young_modulus / 3 / (1 - 2 * self.poisson_ratio)

    def stiff(self, step: float) -> float:
        """Return the shear modulus (Pa) against strain that grows over a step (s)."""
        spring, moduli, times = self.branches
        return float(spring + moduli @ _share(step / times))

    def stiffness(self, plane: str) -> Floats:
        """Return the plane stiffness of an instant."""
        return _tangent(self.stiff(0.0), self.bulk, _across(self.stiff(0.0), self.bulk, plane))

    @property
    def swells(self) -> bool:
        return True

    def variables(self, plane: str) -> History:
        return {
            "strain_deviator": np.zeros(4),
            "branch_stress": np.zeros(4 * len(self.branches.times)),
            "stress_zz": np.zeros(1),
        }

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        spring, moduli, times = self.branches
        stiff, before = self.stiff(step), history["strain_deviator"]
        old = history["branch_stress"].reshape(len(strain), len(times), 4)
        kept = old * np.exp(-step / times)[:, None]
        known = 2 * spring * before + kept.sum(axis=1) - 2 * stiff * before
        share = _across(stiff, self.bulk, plane)
        swelling: float | Floats = 0.0
        if "swelling" in history:
            strain = strain - history["swelling"] * MEAN[:3]
            swelling = 0.0 if plane == "stress" else history["swelling"][:, 0]
        across = share * (strain[:, 0] + strain[:, 1]) - swelling
        if plane == "stress":
            across = across - known[:, 3] / (4 / 3 * stiff + self.bulk)
        whole = np.column_stack([strain, across])
        shape = whole @ SHAPE
        mean = self.bulk * (whole @ MEAN)
        stress = known + 2 * stiff * shape + mean[:, None] * MEAN
        gains = (2 * moduli * _share(step / times))[:, None] * (shape - before)[:, None, :]
        variables = {
            "strain_deviator": shape,
            "branch_stress": (kept + gains).reshape(len(strain), 4 * len(times)),
            "stress_zz": stress[:, 3:],
        }
        tangent = np.broadcast_to(_tangent(stiff, self.bulk, share), (len(strain), 3, 3))
        return Response(stress[:, :3], tangent, variables)

    def energy(self, stress: Floats, history: History, plane: str) -> Floats:
        """Return what volume and springs store (J/m3)."""
        spring, moduli, times = self.branches
        mean = (stress[:, 0] + stress[:, 1] + history["stress_zz"][:, 0]) / 3
        shape = (TWICE * history["strain_deviator"] ** 2).sum(axis=1)
        branch = history["branch_stress"].reshape(len(stress), len(times), 4)
        delayed = (TWICE * branch**2).sum(axis=2) @ (1 / 4 / moduli)
        return np.asarray(mean**2 / 2 / self.bulk + spring * shape + delayed)


def above_zero(**constants: float) -> None:
    """Refuse constants of springs and dashpots that are not above zero."""
    for name, value in constants.items():
        if not value > 0:
            raise FormulationError(f"{name}: {value}: expected a number above 0: correct it")


def _share(ratio: Floats) -> Floats:
    """Return ``(1 - exp(-r)) / r`` of steps over times (k,)."""
    some = ratio > 0
    return np.where(some, -np.expm1(-ratio) / np.where(some, ratio, 1.0), 1.0)


def _across(stiff: float, bulk: float, plane: str) -> float:
    """Return how strain across grows with ``xx + yy`` where nothing holds it, else 0."""
    return 0.0 if plane == "strain" else (2 / 3 * stiff - bulk) / (4 / 3 * stiff + bulk)


def _tangent(stiff: float, bulk: float, across: float) -> Floats:
    """Return the plane matrix (3, 3) of two moduli."""
    solid = 2 * stiff * SHAPE + bulk * np.outer(MEAN, MEAN)
    return np.asarray(solid[:3, :3] + across * np.outer(solid[:3, 3], MEAN[:3]))
