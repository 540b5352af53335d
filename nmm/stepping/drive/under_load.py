"""Progress of growing loads: the state, the target, and the result of an increment."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.stepping.drive.changes import Asked
from nmm.stepping.drive.equilibrium.settling import SettledStep
from nmm.stepping.drive.verdict import LimitPoint

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.scene.methods.step_tables import LoadSteps

# From a state and a load factor to the limit point between, if one is seen.
Beyond = Callable[[State, float], LimitPoint | None]


def unseen(state: State, factor: float) -> LimitPoint | None:
    """Return no limit point: where paths cannot be followed."""
    return None


@dataclass(frozen=True)
class LoadSchedule:
    """How far and how finely the loads grow.

    Attributes
    ----------
    target
        Load factor at which to stop.
    until_failure
        Whether failing before the target is the result sought.
    increment
        Largest increment of the load factor.
    tolerance
        Relative width of the bracket of the failure load.
    at_once
        Whether what acts does so in full from the start: smaller increments are not tried, and
        blocks that do not come to rest near where they stand have failed.
    followed
        Whether fields that change by themselves take their steps with the load.
    begin, stops
        Time at load factor 0, and whether time stops there: in statics of a scene that has no
        clock, time is the load factor, counted over stages.
    """

    target: float
    until_failure: bool
    increment: float
    tolerance: float
    begin: float = 0.0
    stops: bool = False
    at_once: bool = False
    followed: bool = False

    @classmethod
    def brought_on(
        cls, steps: "LoadSteps", begin: float, stops: bool, followed: bool = False
    ) -> "LoadSchedule":
        """Return the schedule of full loads: at once, unless increments are requested.

        So they are where a field is ``followed``.
        """
        stepped = followed or "increment" in steps.model_fields_set
        increment = steps.increment if stepped else 1.0
        given = increment, steps.tolerance, begin, stops
        return cls(1.0, False, *given, followed=followed)

    def instant(self, factor: float) -> Instant:
        """Return the end of a step to a load factor."""
        return Instant(self.begin if self.stops else self.begin + factor, factor)


@dataclass(frozen=True)
class Rest:
    """How loose blocks were brought to rest: steps of relaxation, and the way they took (m).

    ``lost`` (J) is what friction, bonds and matter took on it.
    """

    steps: int
    way: float
    lost: float = 0.0


@dataclass(frozen=True)
class UnderLoad:
    """Progress of growing loads.

    Attributes
    ----------
    state, contacts
        The last state in equilibrium, and its contacts as left.
    increment
        Of the load factor, which is tried next.
    rest
        How loose blocks were brought to rest; None when they were not.
    changed
        What has changed in this state, which is not in equilibrium again yet, in words.
    cuts
        Number of increments that were cut so far.
    """

    state: State
    contacts: "ContactPoints | None"
    increment: float
    rest: Rest | None = None
    changed: str = ""
    cuts: int = 0

    @property
    def rise(self) -> float:
        """Of the load factor, to the state that is sought next."""
        return 0.0 if self.changed else self.increment

    @classmethod
    def at_start(cls, state: State, schedule: LoadSchedule) -> "UnderLoad":
        """Return the start of a run from ``state``."""
        return cls(state, None, min(schedule.increment, schedule.target))


@dataclass(frozen=True)
class Trial:
    """An increment that was tried.

    Attributes
    ----------
    factor
        Load factor at its end.
    fine
        Whether it is within the tolerance of the load.
    last
        Whether no smaller one would be tried before loose blocks are held or brought to rest.
    found, broke
        What came of it, and whether bonds broke in it.
    events
        Changes of what is solved that what was found calls for.
    """

    factor: float
    fine: bool
    last: bool
    found: SettledStep
    broke: bool
    events: Asked

    @property
    def located(self) -> bool:
        """Whether the load is sought at which an event happens."""
        return any(event.exact for _, event in self.events)
