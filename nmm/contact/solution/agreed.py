"""A solution with which the interface laws agree, and what an accepted step tells of it."""

from dataclasses import dataclass

from integration.arrays import Floats, Ints
from nmm.contact.laws.history_iteration import HistoryIteration
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.problem.step_problem import StepAnswer
from nmm.contact.solution.posed_step import PosedStep
from nmm.contact.solution.record import ContactSolution
from nmm.frozen import with_parts


@dataclass(frozen=True)
class Agreed:
    """A solution with which the laws agree, its problem, and the slip (m,) under load."""

    iteration: HistoryIteration
    posed: PosedStep
    answer: StepAnswer
    sliding: Floats
    passes: int

    def told(
        self,
        found: ContactSolution,
        start: ContactPoints,
        rows: ContactRows,
        body: Ints | None,
    ) -> ContactSolution:
        """Return the solution as an accepted step from ``start``, with the loss to friction.

        ``body`` (e,) are the bodies of edges, in statics.
        """
        answer, sliding = self.answer, self.sliding
        losses = self.iteration.losses(answer, sliding)
        rubbed = losses.energy(static=body is not None) + self.posed.loss(start, answer)
        friction = None if body is None else losses.friction(body)
        # Loads that grow do more where bonds begin to soften within a step. Less is what a jump
        # frees, and stays out of balance.
        between = 0.0 if body is None else max(losses.softened_beyond_means, 0.0)
        missed, loss = self.posed.missed(answer), found.loss + rubbed
        told = {"friction": friction, "sliding": sliding, "rows": rows, "missed": missed}
        return with_parts(found, loss=loss, between=between, **told)
