"""Springs of contacts as they act on the mean over one step.

A spring of stiffness ``k`` whose gap goes from ``g0`` to ``g1`` pushes through the whole step with

    N = k min(w g1 + (1 - w) min(g0, 0), 0),        1/2 <= w <= 1.

Its work ``N (g1 - g0)`` never exceeds what the spring gives back, ``k min(g0, 0)^2 / 2`` less
``k min(g1, 0)^2 / 2``: closed at both ends it misses it by ``(w - 1/2) k (g1 - g0)^2``, closing by
at least ``w k |g1| g0``, opening by the rest of what was stored. So no step gains energy, however
stiff the spring and long the step, and with ``w = 1/2`` a contact that stays closed keeps all of
it. The same holds of shear springs that slide at a limit. ``w = 1`` is Shi's spring.
"""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.laws.dashpots import Dashpots
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import BROKEN, OPEN, StepAnswer


@dataclass(frozen=True)
class MeanSprings:
    """Springs from a shifted gap and slip: ``N = normal (g1 - lag)``, ``T = shear (s1 + lead)``.

    Attributes
    ----------
    normal, shear
        (m,) stiffnesses (N/m).
    lag, lead
        (m,) shifts (m).
    weight
        (m,) share of the end of the step.
    """

    normal: Floats
    shear: Floats
    lag: Floats
    lead: Floats
    weight: Floats

    @classmethod
    def of(
        cls,
        contacts: ContactPoints,
        springs: tuple[Floats, Floats],
        weight: Floats,
        lift: Floats,
        dashpots: Dashpots,
    ) -> "MeanSprings":
        """Weight springs (normal and shear, N/m) and add dampers.

        Parameters
        ----------
        contacts
            At the start of the step; intact bonds pull, the others push alone.
        weight
            (m,) share of the end of the step.
        lift
            (m,) taken from the gap at the start (m).
        """
        normal, shear = springs
        gap = contacts.gap - lift
        held = contacts.is_joint & (contacts.damage < 1)
        earlier = (1 - weight) * normal * np.where(held, gap, np.minimum(gap, 0.0))
        total = weight * normal + dashpots.stiffness
        damped = dashpots.lag * (normal + dashpots.stiffness)
        return cls(
            total,
            weight * shear,
            (damped - earlier) / total,
            (1 / weight - 1) * contacts.slip,
            weight,
        )

    def unshifted(self, answer: StepAnswer, shift: Floats) -> StepAnswer:
        """Return the answer with the gap and the elastic slip at the end of the step."""
        parted = (answer.state == OPEN) | (answer.state == BROKEN)
        slip = np.where(parted, answer.slip, answer.slip - self.lead)
        return replace(answer, gap=answer.gap + shift, slip=slip)


def end_shares(weight: float, exact: bool, own: Bools, soft: Bools) -> Floats:
    """Share (m,) of the end of the step in the stretch of each contact.

    What is not a spring, an exact contact, or is one that is being lost, a bond that softens, acts
    as at the end of the step.
    """
    return np.where(soft | (exact & ~own), 1.0, weight)
