"""A run as a sequence of states, until a verdict ends it."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol, TypeVar

from nmm.assembly.state import State
from nmm.errors import NmmError, StorageError
from nmm.stepping.drive.verdict import FAILED, SPENT, RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.budget import BudgetSpentError

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints


class Position(Protocol):
    """Where a run stands: its last state, and the contacts as they were left."""

    @property
    def state(self) -> State:
        """The last accepted state."""

    @property
    def contacts(self) -> "ContactPoints | None":
        """Its contacts; None without any."""


P = TypeVar("P", bound=Position)


def until_verdict(
    at: P,
    step: Callable[[P], P | RunVerdict],
    recorder: Recorder,
    stopped: str = "stopped, last in equilibrium",
) -> tuple[State, RunVerdict]:
    """Continue a run until a step ends it, or its budget is spent.

    ``stopped`` says what a budget that is spent leaves behind, once a step was accepted.

    Returns
    -------
    The last accepted state, which is recorded as the last, and the verdict.
    """
    try:
        while not isinstance(found := step(at), RunVerdict):
            at = found
        verdict = found
    except BudgetSpentError as spent:
        where = f"{stopped} at load factor {at.state.load_factor:.6g}"
        how = where if recorder.steps else "stopped before the first equilibrium"
        verdict = RunVerdict(SPENT, f"{how}: {spent}")
    except NmmError as fault:
        verdict = broken_off(recorder, f"load factor {at.state.load_factor:.6g}", fault)
    recorder.last(at.state, "load", at.contacts)
    return at.state, verdict


def broken_off(recorder: Recorder, where: str, fault: NmmError) -> RunVerdict:
    """Return the verdict on a run that a fault has ended, and ``where`` its last step ends.

    Raises
    ------
    NmmError
        The fault, before the first step, and where it is of what is written.
    """
    if not recorder.steps or isinstance(fault, StorageError):
        raise fault
    told = " ".join(str(fault).split())
    return RunVerdict(FAILED, f"broken off at {where}, after {recorder.steps} steps: {told}")
