"""Dampers beside the normal springs of contacts, in one step."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats, Ints


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

    def loss(
        self, spring: Floats, gap: tuple[Floats, Floats], force: tuple[Floats, Floats]
    ) -> float:
        """Energy (J) taken in a step.

        Mean force times way, less what the springs have gained; ``gap`` and ``force`` are those at
        the start and the end, ``spring`` (m,) the stiffness beside the damper.
        """
        work = (force[0] + force[1]) / 2 * (gap[1] - gap[0])
        before, after = (np.minimum(one, 0.0) for one in gap)
        return float((work - spring * (after**2 - before**2) / 2)[self.stiffness > 0].sum())


def meeting_mass(rows: csr_array, pair: Ints, rigid_modes: csc_array, ease: Floats) -> Floats:
    """Mass (m,) in kg that two rigid bodies put against each other at each contact.

    ``1 / (G M^-1 G^T 1)`` with the normal rows ``G`` in rigid motions: all contacts of one pair of
    bodies close together, as two do when faces meet.

    Parameters
    ----------
    rows
        (m, n) normal rows.
    pair
        (m,) which pair of bodies each contact belongs to.
    rigid_modes, ease
        (n, 3 B) rigid motions, (3 B,) inverse of mass and moment of inertia; 0 for held bodies.
    """
    along = csr_array(rows @ rigid_modes)
    _, number = np.unique(pair, return_inverse=True)
    m = len(number)
    members = csr_array((np.ones(m), (number, np.arange(m))), shape=(number.max(initial=-1) + 1, m))
    together = csr_array(members @ along)[number]
    eased = np.maximum(along.multiply(together) @ ease, 0.0)
    return np.asarray(np.divide(1.0, eased, out=np.zeros_like(eased), where=eased > 0))
