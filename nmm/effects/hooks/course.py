"""Hooks of the course of a run: its start, accepted steps, events, changes and checkpoints."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from integration.arrays import Floats
from nmm.assembly.state import State

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.effects.event import Event
    from nmm.effects.motion.reactions import Reactions
    from nmm.effects.view import View


class CourseHooks:
    """What an effect does between steps."""

    def begin(self, state: State) -> State:
        """Return the state at the start of the run, as the effect changes it."""
        raise NotImplementedError

    def join_run(self, state: State) -> None:
        """Receive the state in which the effect joins a run that began without it."""
        raise NotImplementedError

    def accepted(self, state: State) -> None:
        """Receive the end of an accepted step, before `event` is called.

        What the effect remembers of it must be part of `carried`.
        """
        raise NotImplementedError

    def event(self, view: "View") -> "Event | None":
        """Return the change of geometry that an accepted state calls for; None for none.

        It is called once after every accepted step and must not change the effect: a step that
        ends beyond the event may be taken again with a smaller increment. What the effect remembers
        of the change it learns in `follow`, and must be part of `carried`.
        """
        raise NotImplementedError

    def take_over(self, left: "Sequence[Reactions]") -> None:
        """Receive the reactions of supports that a change removes, on the new model."""
        raise NotImplementedError

    def receive_residual(self, change: "Change", force: Floats) -> None:
        """Receive the out-of-balance force (n,) on the new model as a change begins to act."""
        raise NotImplementedError

    def carried(self) -> Any:
        """Return the state of the effect beside that of the bodies, from step to step.

        Checkpoints store it: arrays, numbers, texts, None, and tuples and mappings of these by
        name, or dataclasses of them that `nmm.results.storage.values` knows.
        """
        raise NotImplementedError

    def carry(self, carried: Any) -> None:
        """Restore what `carried` returned."""
        raise NotImplementedError

    def forget(self) -> None:
        """Drop caches; answers may change within their tolerance only."""
        raise NotImplementedError
