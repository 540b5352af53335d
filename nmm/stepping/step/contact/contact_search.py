"""The contacts with which a step is solved, and those with which it is repeated.

Contacts are sought as far as points can move in a step. The first step has no motion to go by; one
that moves further is solved again, and so is one that lets points through an edge, or whose forces
act elsewhere half way.
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from nmm.assembly.moving.motion import middle
from nmm.assembly.state import State
from nmm.contact.candidates.held_back import joined
from nmm.contact.detection.tolerances import (
    CROSSING_SOLUTIONS,
    FIRST_REACH,
    FURTHER,
    MIDPOINT_SOLUTIONS,
)
from nmm.model.discretisation import CurrentDiscretisation
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.linear.equations import Equations, misjudged
from nmm.stepping.step.mover import Mover
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.candidates.held_back import Crossed
    from nmm.contact.detection.crossing import Motion
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.contact.points.half_way.mean_motion import Forces
    from nmm.contact.solution.record import BrokenBonds, ContactSolution
    from nmm.effects.contact import Contact


@dataclass(frozen=True)
class SoughtContacts:
    """The contacts with which a step is solved, and how often it was repeated, by cause.

    Attributes
    ----------
    reach
        How far contacts were sought (m).
    contacts
        Those that were found.
    midpoint, ahead
        Where contact forces act, and where they do as contacts are sought anew; None where the step
        begins.
    forces
        Those (m,) that the last solution found, normal and shear (N); None before one.
    crossed
        Pairs that are contacts because the step without them let them through; None without any.
    broken
        Bonds that broke where contacts were sought less far, and are whole in none of these; None
        where none did.
    crossings, midpoints
        Solutions for such pairs, and for forces that act elsewhere half way.
    held
        Whether pairs are contacts because they held bodies back in the step before.
    """

    reach: float
    contacts: "ContactPoints"
    midpoint: State | None
    ahead: State | None
    forces: "Forces | None" = None
    crossed: "Crossed | None" = None
    broken: "BrokenBonds | None" = None
    crossings: int = 0
    midpoints: int = 0
    held: bool = False

    def without(self, broken: "BrokenBonds | None") -> "SoughtContacts":
        """Return what was sought without bonds that broke in the same step, if any did."""
        if broken is None:
            return self
        return replace(self, contacts=broken.among(self.contacts), broken=broken)


class ContactSearch:
    """Searches for the contacts of steps.

    Parameters
    ----------
    size
        Diagonal of the domain (m).
    """

    def __init__(
        self, current: CurrentDiscretisation, mover: Mover, size: float, clock: Clock
    ) -> None:
        self._current, self._mover, self._size, self._clock = current, mover, size, clock
        self.forget()

    def forget(self) -> None:
        """Drop the contacts of the last step."""
        self._last: tuple[State, SoughtContacts] | None = None

    @property
    def contact(self) -> "Contact":
        """The contact effect."""
        contact = self._current.plan.contact
        assert contact is not None
        return contact

    def reach(self, motion: float = 0.0) -> float:
        """Return how far contacts are sought after a step that moved by ``motion`` (m)."""
        return max(2 * motion, FIRST_REACH * self._size)

    def turns(self, equations: Equations) -> bool:
        """Whether bodies turn in a step with inertia, of which alone velocity and momentum tell."""
        return equations.inertia is not None and self._mover.kinematics.turns

    def candidates(
        self,
        state: State,
        reach: float,
        step: float | None,
        crossed: "Crossed | None" = None,
        broken: "BrokenBonds | None" = None,
    ) -> "ContactPoints":
        """Return the contact points of a step in which no point moves further than ``reach``."""
        with self._clock.phase("search"):
            return self.contact.candidates(state, reach, step, crossed, broken)

    def first(
        self, equations: Equations, reach: float, again: bool, broken: "BrokenBonds | None" = None
    ) -> SoughtContacts:
        """Return the contacts of a step: those of its last iteration where it is solved ``again``.

        Forces that bend move bodies by little from one iteration to the next. Bonds that are
        ``broken`` broke in an attempt of the same step before.
        """
        state, last = equations.state, self._last
        if again and last is not None and last[0] is state and last[1].broken is None:
            return replace(last[1], crossings=0, midpoints=0).without(broken)
        contacts = self.candidates(state, reach, equations.step, broken=broken)
        ahead = self._ahead(equations, contacts)
        return SoughtContacts(reach, contacts, ahead, ahead).without(broken)

    def keep(self, state: State, sought: SoughtContacts) -> None:
        """Keep the contacts of a step from a state for its next iteration."""
        self._last = state, sought

    def again(
        self,
        equations: Equations,
        sought: SoughtContacts,
        solved: "ContactSolution",
        result: Attempt,
        motion: "Motion | None",
    ) -> SoughtContacts | None:
        """Return the contacts with which a step is repeated; None where its solution is accepted.

        ``motion`` is None where bodies moved beyond the reach of the search.
        """
        if solved.uncovered:
            return self._anew(equations, sought, solved.broken)
        if motion is None:
            reach = FURTHER * result.motion
            return self._anew(equations, replace(sought, reach=reach), solved.broken)
        contact = self.contact
        missed = contact.overlooked(sought.contacts, motion)
        if missed is not None and sought.crossings < CROSSING_SOLUTIONS:
            crossed, count = joined(sought.crossed, missed), sought.crossings + 1
            return self._anew(equations, replace(sought, crossed=crossed, crossings=count))
        if not self.turns(equations) or sought.midpoints == MIDPOINT_SOLUTIONS:
            return None
        given = solved, equations.state, result.state, sought.midpoint
        half = contact.momentum.midpoint(*given)
        meets = sought.contacts.gap.size > 0
        if half is None and not (meets and self._misjudged(equations, result.state)):
            return None
        half = half or sought.midpoint
        forces = solved.answer.normal_force, solved.answer.shear_force
        return replace(sought, midpoint=half, forces=forces, midpoints=sought.midpoints + 1)

    def held_back(self, equations: Equations, sought: SoughtContacts) -> SoughtContacts | None:
        """Return the contacts with which statics without a solution is solved again; else None.

        Corners that came to rest past one another hold each other back. Search finds such pairs by
        the motion of a solution without them, and there may be none.
        """
        held = self.contact.record.crossed
        if equations.step is not None or held is None or sought.held:
            return None
        crossed = joined(sought.crossed, held)
        return self._anew(equations, replace(sought, crossed=crossed, held=True))

    def _misjudged(self, equations: Equations, end: State) -> bool:
        inertia = self._current.plan.inertia
        assert inertia is not None
        return misjudged(equations, inertia, self._current.model, end)

    def _anew(
        self,
        equations: Equations,
        sought: SoughtContacts,
        broken: "BrokenBonds | None" = None,
    ) -> SoughtContacts:
        """Return the same with the contacts of a new search; bonds that are ``broken`` stay so.

        None of them was judged by a solution beyond the reach of the search.
        """
        given = equations.state, sought.reach, equations.step, sought.crossed, broken
        contacts = self.candidates(*given)
        found = replace(sought, contacts=contacts, midpoint=sought.ahead, forces=None, broken=None)
        return found.without(broken)

    def _ahead(self, equations: Equations, contacts: "ContactPoints") -> State | None:
        """Return where bodies are half way if they go on turning; None where they hardly turn.

        It depends on the state alone, so that a resumed run predicts the same.
        """
        state, step = equations.state, equations.step
        if step is None or not self.turns(equations):
            return None
        flight, half = step * state.velocity, 0.5 * step**2
        way = self.contact.momentum.foreseen(contacts, flight, state.acceleration, half)
        if way is None:
            return None
        return middle(state, self._mover.moved(state, way))
