"""Hooks by which effects report: in words, for frames and for the history."""

from collections.abc import Mapping

from nmm.assembly.state import State
from nmm.quantity import MemberSegments, Quantity


class ReportHooks:
    """What an effect reports."""

    @property
    def about(self) -> str:
        """How the formulation imposes the effect, in words; empty where there is no choice."""
        return ""

    @property
    def caution(self) -> str:
        """Known causes of wrong answers of it on this model, in words; empty without any."""
        return ""

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Quantities of a state by name, for frames, run folders, ParaView and plots."""
        raise NotImplementedError

    def segments(self, state: State) -> MemberSegments:
        """Members as segments with their forces, for frames, ParaView and plots."""
        raise NotImplementedError

    def history(self, state: State) -> Mapping[str, float]:
        """Numbers of a state by name, for a line of the history; called after each step."""
        raise NotImplementedError
