"""What time integration and contact take of the energy in a step, each told from the other.

A step's equations, multiplied by its increment ``d``, are a balance of work: inertia took ``i``,
contact forces ``N`` did ``N d``, and elastic, holding and applied forces act with the weight ``w``
at the end. What springs and matter lose by it beside the mean of both ends is the integrator's own,
and so is what the velocity does not show of ``i``. Applied forces do the work of those that acted
where the motion has them (`Integrator.late`): a rule of order 2 has the mean of both ends.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.solvers.unchecked import product

if TYPE_CHECKING:
    from nmm.contact.solution.record import ContactSolution
    from nmm.stepping.step.linear.equations import Equations


@dataclass(frozen=True)
class BookedWork:
    """Work in one step in time (J).

    Attributes
    ----------
    inertia
        Taken by inertia as the step's equations have it.
    beyond
        What forces at the end of a step take more than the mean of both ends.
    contact
        Work of contact forces on the bodies.
    contact_factor
        `Integrator.contact_factor`.
    late
        What applied forces and driven supports do more than `Effect.work` says, which does not know
        the rule: see `Integrator.late`.
    damping
        Taken by dampers, by effect.
    """

    inertia: float
    beyond: float
    contact: float
    contact_factor: float
    late: float = 0.0
    damping: Mapping[str, float] = field(default_factory=dict)

    def integration_loss(self, kinetic_gain: float) -> float:
        """Energy (J) that the integrator took, but for contact; negative if it gave some."""
        more = (self.contact_factor - 1) * self.contact
        return self.inertia - kinetic_gain + self.beyond + self.late - more

    def contact_loss(self, stored_gain: float, loss: float) -> float:
        """Energy (J) that contact springs lost beyond the ``loss`` of friction; negative: made."""
        return -self.contact - stored_gain - loss


def booked(
    equations: "Equations",
    increment: Floats,
    solved: "ContactSolution | None",
    missed: float = 0.0,
    work_correction: float = 0.0,
    driven: float = 0.0,
) -> BookedWork | None:
    """Return the work in a step in time, None in statics.

    ``missed`` (J) is what the mean force of matter at both ends does beyond what it stores,
    ``work_correction`` what forces of effects seem to do and do not (`Effect.work_correction`),
    and ``driven`` what `Supports.late_work` says.
    """
    terms = equations.inertia
    if terms is None:
        return None
    heavy = terms.factor * float(increment @ product(terms.mass, increment))
    taken = heavy - float(increment @ (terms.momentum + terms.outwards))
    beyond, late = missed, 0.0
    lost: Mapping[str, float] = {}
    damped = added = 0.0
    if terms.damping is not None:
        lost, damped, added = terms.damping.taken(increment, terms.factor, terms.rates)
    more = 0.0 if terms.gain is None else float(increment @ terms.gain)
    if terms.elastic is not None:
        beyond += (more - float(increment @ (terms.elastic @ increment))) / 2
    elif terms.weight != 0.5:
        share = terms.contact_factor
        # The matrix is that of inertia and, weighted, of all that is elastic, over the share.
        whole = share * float(increment @ product(equations.matrix, increment))
        elastic = whole - heavy - damped - added
        beyond += (terms.weight - 0.5) * (elastic / terms.weight - work_correction - more)
        applied = 0.0 if terms.applied is None else float(increment @ terms.applied)
        late = equations.rule.late * applied + driven
    work = 0.0
    if solved is not None and solved.rows is not None:
        work = -float(solved.push @ increment)
    return BookedWork(taken, beyond, work, terms.contact_factor, late, lost)
