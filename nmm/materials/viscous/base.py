"""What laws of creep share: a step of any length, exact where strain grows at a constant rate.

The deviator is that of a spring beside Maxwell's branches, a spring and a dashpot in series each.
Over a step in which strain grows at a constant rate a branch keeps ``exp(-dt/tau)`` of its stress
and gains ``2 G phi`` times the strain, ``phi = (1 - exp(-dt/tau)) tau / dt`` (Taylor, Pister and
Goudreau 1970). Stress under given strain is exact then; strain under given stress nears its limit
from one side however long the step.
"""

from abc import abstractmethod
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.materials.base import History, Response
from nmm.materials.elastic import Elastic
from nmm.materials.tensors import ISOTROPIC, SPHERICAL, TWICE

# From strain (xx, yy, 2 xy, zz) to the deviator (xx, yy, xy, zz) of the tensor.
SHAPE = np.diag([1.0, 1.0, 0.5, 1.0]) - np.outer(SPHERICAL, SPHERICAL) / 3


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
        return _of_step(self, plane, 0.0)[:3, :3].T

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
        known = [strain, history["strain_deviator"], history["branch_stress"]]
        if "swelling" in history:
            known.append(history["swelling"])
        given, matrix = np.concatenate(known, axis=1), _of_step(self, plane, step)
        found = given @ matrix[: given.shape[1]]
        variables = {
            "strain_deviator": found[:, 4:8],
            "branch_stress": found[:, 8:],
            "stress_zz": found[:, 3:4],
        }
        tangent = np.broadcast_to(matrix[:3, :3].T, (len(strain), 3, 3))
        return Response(found[:, :3], tangent, variables)

    def energy(self, stress: Floats, history: History, plane: str) -> Floats:
        """Return what volume and springs store (J/m3)."""
        spring, moduli, _ = self.branches
        mean = (stress[:, 0] + stress[:, 1] + history["stress_zz"][:, 0]) / 3
        shape = history["strain_deviator"] ** 2 @ TWICE
        delayed = history["branch_stress"] ** 2 @ np.outer(1 / 4 / moduli, TWICE).ravel()
        return np.asarray(mean**2 / 2 / self.bulk + spring * shape + delayed)


@lru_cache(maxsize=16)
def _of_step(law: Viscous, plane: str, step: float) -> Floats:
    """Return what a step (s) makes of a strain and of what the law remembers, which is linear.

    A matrix from strain (3), its deviator before (4), stress of k branches (4 k) and swelling (1)
    to stress (4), deviator (4) and stress of branches (4 k): the answer to one of each at a time.
    """
    spring, moduli, times = law.branches
    stiff, n = law.stiff(step), len(times)
    strain, before, old, swelling = np.split(np.eye(8 + 4 * n), [3, 7, 7 + 4 * n], axis=1)
    kept = old.reshape(len(old), n, 4) * np.exp(-step / times)[:, None]
    known = 2 * spring * before + kept.sum(axis=1) - 2 * stiff * before
    strain = strain - swelling * ISOTROPIC
    if plane == "strain":  # what swells is held across
        across = -swelling[:, 0]
    else:
        pressed = (2 / 3 * stiff - law.bulk) * (strain[:, 0] + strain[:, 1])
        across = (pressed - known[:, 3]) / (4 / 3 * stiff + law.bulk)
    whole = np.column_stack([strain, across])
    shape = whole @ SHAPE
    stress = known + 2 * stiff * shape + law.bulk * np.outer(whole @ SPHERICAL, SPHERICAL)
    gains = (2 * moduli * _share(step / times))[:, None] * (shape - before)[:, None]
    return np.hstack([stress, shape, (kept + gains).reshape(len(old), 4 * n)])


def above_zero(**constants: float) -> None:
    """Refuse constants of springs and dashpots that are not above zero."""
    for name, value in constants.items():
        if not value > 0:
            raise FormulationError(f"{name}: {value}: expected a number above 0: correct it")


def _share(ratio: Floats) -> Floats:
    """Return ``(1 - exp(-r)) / r`` of steps over times (k,)."""
    some = ratio > 0
    return np.where(some, -np.expm1(-ratio) / np.where(some, ratio, 1.0), 1.0)
