"""Which way goes first: the one that cost less in the last steps of the run, counted in solves.

Most steps of a scene are like the last one. Where the alternation (`alternation`) cost more than
the interior point, that goes first and straight to the end; the other is tried now and then with
what a quick success of it costs, at intervals that double while it fails. Costs are counted, not
timed: runs repeat to the last digit.
"""

from dataclasses import dataclass, replace

from nmm.contact.iteration.options.budgets import IterationBudget
from nmm.contact.iteration.options.springs import WayOptions


@dataclass
class Ways:
    """What is known of the ways from the last steps.

    Attributes
    ----------
    inside
        Cost of the interior point where it was taken last, in solves; None where it never was.
    leads
        Whether it goes first.
    finishes
        Whether the alternation, when tried last, finished what the interior point had found
        roughly.
    stay
        How many times longer than usual the alternation stays with its first factor.
    """

    inside: float | None = None
    leads: bool = False
    finishes: bool = True
    stay: float = 1.0
    _wait: int = 0
    _pause: int = 1

    def budget(
        self, whole: IterationBudget, near: bool, options: WayOptions
    ) -> IterationBudget | None:
        """Begin a step: what the alternation may cost before the interior point; None: left out.

        ``near`` says that the search starts near its end, where a few solves mostly do.
        """
        dear = options.guess if self.inside is None else self.inside
        if not self.leads:
            return replace(whole, cost=dear)
        if near:
            return replace(whole, cost=min(dear, options.near))
        self._wait -= 1
        return None if self._wait > 0 else replace(whole, cost=min(dear, options.trial))

    def alternation_met(self) -> None:
        """Learn from a step in which the alternation did what was asked within its budget."""
        self.leads, self._pause = False, 1

    def second_factor(self, paid: bool, longest: float) -> None:
        """Learn from a turn of the alternation's second factor whether it paid."""
        self.stay = max(self.stay / 2, 1.0) if paid else min(2 * self.stay, longest)

    def interior_took(self, cost: float, options: WayOptions) -> None:
        """Learn from a step that the interior point ended, at a ``cost`` of its own in solves."""
        self.inside = cost
        tried = not self.leads or self._wait <= 0
        self.leads = True
        if tried:
            self._wait, self._pause = self._pause, min(2 * self._pause, options.longest)
