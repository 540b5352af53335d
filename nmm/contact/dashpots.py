"""Dampers beside the normal springs of contacts, in one step."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats


@dataclass(frozen=True)
class Dashpots:
    """``N = k gap + c d(gap)/dt`` while pressed, as a stiffer spring from a shifted gap.

    Attributes
    ----------
    stiffness
        (m,) ``c / dt`` (N/m), added to that of the springs.
    lag
        (m,) taken from the gap at the start of the step (m).
    """

    stiffness: Floats
    lag: Floats

    @classmethod
    def of(cls, coefficient: Floats, step: float, spring: Floats, gap: Floats) -> "Dashpots":
        """Dampers ``coefficient`` (N s/m) over a step from ``gap``; an open one starts at zero."""
        stiffness = coefficient / step
        return cls(stiffness, stiffness * np.minimum(gap, 0.0) / (spring + stiffness))

    def loss(self, before: Floats, after: Floats, force: Floats) -> float:
        """Energy (J) taken in a step from gap ``before`` to ``after`` that ended with ``force``."""
        way = np.minimum(after, 0.0) - np.minimum(before, 0.0)
        return float((self.stiffness * way**2)[force < 0].sum())


def meeting_mass(rows: csr_array, rigid_modes: csc_array, mass: csc_array) -> Floats:
    """Mass (m,) in kg that two rigid bodies put against each other at a contact.

    ``1 / (g M^-1 g^T)`` with the normal row ``g`` in rigid motions, whose mass is diagonal about
    the centroids.
    """
    rigid = (rigid_modes.T @ (mass @ rigid_modes)).diagonal()
    ease = np.divide(1.0, rigid, out=np.zeros_like(rigid), where=rigid > 0)
    along = rows @ rigid_modes
    eased = along.multiply(along) @ ease
    return np.asarray(np.divide(1.0, eased, out=np.zeros_like(eased), where=eased > 0))
