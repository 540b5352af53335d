"""Energy that friction and softening took in a step, from what its contacts went through."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.contraction import some, summed
from nmm.contact.detection.surface import unordered_key
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.laws.step_friction import StepFriction
from nmm.contact.points.contact_points import AT_ENDS, ContactPoints
from nmm.contact.problem.coulomb import shear_bound
from nmm.contact.problem.step_problem import Limits, StepAnswer
from nmm.frozen import MadeOnce
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.passage import Passage
from nmm.interfaces.response import InterfaceResponse

AT_LIMIT = 1e-6
"""Shear forces within this share of their limit are at it: rounding of a solution."""


@dataclass(frozen=True)
class ContactLosses:
    """What contacts went through in a step.

    Attributes
    ----------
    laws, start
        Of the contacts, and these at the start.
    after
        The contacts with the history at the end.
    responses
        Of the laws under the history at both ends.
    softening
        (m,) bonds that lose their strength in the course of steps.
    answer, sliding
        The solution, and the slip (m,) under load.
    """

    laws: ContactLaws
    start: ContactPoints
    after: ContactPoints
    responses: tuple[InterfaceResponse, InterfaceResponse]
    softening: Bools
    answer: StepAnswer
    sliding: Floats

    def energy(self, static: bool) -> float:
        """Energy (J) that friction and softening took.

        Bonds that soften took what their law says. Elsewhere the force of a step in time acts all
        through it. In statics loads grow within a step: what slides from its start does so against
        the mean of the limits at both ends, what slides later against that at the end. The work of
        dilation against pressure is not lost.
        """
        rubbed = self._rubbed
        if self.laws.evolving:
            before, after = self.responses
            lifting = self.answer.normal_force * (after.rise - before.rise)
            rubbed = rubbed + np.where(self.start.bonded, 0.0, lifting)
        if static:
            rubbed = rubbed * self._mean_share
        taken = (area @ dissipated for _, _, area, dissipated in self._softened)
        return float(summed(rubbed[~self.softening]) + sum(taken))

    def friction(self, body: Ints) -> StepFriction:
        """Return the friction of a step of statics, of edges of a ``body`` each (e,)."""
        start, slides = self.start, ~self.softening
        limit, from_start = self._limits
        one, other = (body[edge] for edge in (start.edge_a, start.edge_b))
        pair = unordered_key(one, other, int(body.max(initial=0)) + 1)
        counted = self._rubbed * self._mean_share
        return StepFriction(
            start.key[slides],
            pair[slides],
            limit[slides],
            from_start[slides],
            np.abs(self.answer.shear_force[slides]),
            np.abs(start.slid + self.sliding)[slides],
            float(summed(counted[slides])),
        )

    def beyond_means(self) -> float:
        """Energy (J) of a step of statics beyond what mean forces of both ends say.

        That is of softening, and of friction that reaches its limit within the step: nothing slides
        before.
        """
        means = (self.start.shear_force + self.answer.shear_force) / 2 * self.sliding
        late = ~self.softening & ~self._limits[1]
        return self.softened_beyond_means + float(summed((self._rubbed - means)[late]))

    @MadeOnce
    def softened_beyond_means(self) -> float:
        """Energy (J) of a step of statics that softening takes beyond what mean forces say."""
        beyond = (
            area @ (dissipated - law.dissipated_by_means(passage))
            for law, passage, area, dissipated in self._softened
        )
        return float(sum(beyond))

    @MadeOnce
    def _softened(self) -> list[tuple[InterfaceLaw, Passage, Floats, Floats]]:
        """Laws, what their bonds that soften went through, areas (m2), energies taken (J/m2)."""
        soft = self.softening
        if not some(soft):
            return []
        ended = {name: getattr(self.answer, name)[soft] for name in AT_ENDS}
        after = replace(self.after.take(soft), **ended)
        parts = _passages(self.laws, self.start.take(soft), after)
        return [(law, way, area, law.dissipated(way)) for law, way, area in parts]

    @MadeOnce
    def _rubbed(self) -> Floats:
        """Shear force at the end times slip (m,), in J."""
        slid = self.start.slid
        way = np.abs(slid + self.sliding) - np.abs(slid)
        return np.asarray(np.abs(self.answer.shear_force) * way)

    @MadeOnce
    def _limits(self) -> tuple[Floats, Bools]:
        """Limits (m,) of shear at the start (N), and where shear forces are at them."""
        start = self.start
        bound = shear_bound(start.normal_force, start.normal_force != 0, self.responses[0].limits)
        return bound, np.asarray(np.abs(start.shear_force) >= (1 - AT_LIMIT) * bound)

    @MadeOnce
    def _mean_share(self) -> Floats:
        """Mean shear force (m,) of a step of statics over that at its end, where contacts slide."""
        end, (bound, from_start) = np.abs(self.answer.shear_force), self._limits
        mean = (bound + end) / 2
        return np.divide(mean, end, out=np.ones_like(end), where=from_start & (end > 0))


def softening(laws: ContactLaws, contacts: ContactPoints, limits: Limits) -> Bools:
    """Return which contacts (m,) are bonds that lose their strength in the course of steps."""
    if not laws.hold(contacts):
        return np.zeros(contacts.gap.shape, dtype=bool)
    return contacts.bonded & ~contacts.tied & np.isfinite(limits.tension)


def _passages(
    laws: ContactLaws, before: ContactPoints, after: ContactPoints
) -> Iterator[tuple[InterfaceLaw, Passage, Floats]]:
    """Yield each law with what its joints went through in a step, and their areas (m2)."""
    areas, springs = laws.areas(before), laws.springs(before)[:2]
    ends = zip(laws.by_law(before), laws.by_law(after), strict=True)
    for (law, index, start), (_, _, end) in ends:
        area = areas[index]
        gap, slip, pull, shear = (
            (getattr(before, name)[index], getattr(after, name)[index]) for name in AT_ENDS
        )
        passage = Passage(
            history=(start, end),
            gap=gap,
            slip=slip,
            pull=(pull[0] / area, pull[1] / area),
            shear=(shear[0] / area, shear[1] / area),
            stiffness=(springs[0][index] / area, springs[1][index] / area),
        )
        yield law, passage, area
