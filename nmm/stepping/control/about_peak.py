"""The largest load of a path by shorter steps: followed anew from the place before the peak.

The peak lies between two places of a path, and is missed by the square of a step.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from nmm.controls.base import Control
from nmm.stepping.control.position import OnPath
from nmm.stepping.drive.verdict import FAILURE, RunVerdict

if TYPE_CHECKING:
    from nmm.contact.solution.record import ContactRecord

# Share of the steps by which a path is followed anew, and how often at most.
FINER, ROUNDS = 0.25, 3
# Share of the largest load by which it falls to the places beside it where it is the peak: a corner
# between them is missed by half of that.
FLAT = 4e-4
# Share of the way from the peak that a step goes behind it.
ONWARD = 0.25

Follow = Callable[[OnPath, "ContactRecord | None", Control, "AboutPeak"], RunVerdict]
"""From a place on a path, with its contact record, by a control; the third is told the places."""


@dataclass
class AboutPeak:
    """The places of a path before and behind its largest load.

    Attributes
    ----------
    begin, record
        The place before the one of the largest load, and its contact record.
    most, behind
        The largest load factor, and that of the place behind.
    top
        How far what is controlled has come at the place of the largest.
    end
        How far what is controlled has come at the place behind; None before there is one.
    peak
        The largest load factor of all places and of events between them.
    unstable
        The same up to the first place that is unstable; None before there is one.
    """

    begin: OnPath
    record: "ContactRecord | None"
    most: float = field(init=False)
    behind: float = field(init=False, default=0.0)
    top: float = field(init=False)
    end: float | None = field(init=False, default=None)
    peak: float = field(init=False, default=0.0)
    unstable: float | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        self.most, self.top = self.begin.state.load_factor, self.begin.gone
        self._last = self.begin, self.record

    def see(self, at: OnPath, record: "ContactRecord | None", ways: int = 0) -> None:
        """Take the next place of the path; so far one was unstable in ``ways`` at most."""
        self.peak = at.peak
        if ways and self.unstable is None:
            self.unstable = at.peak
        if at.state.load_factor > self.most:
            (self.begin, self.record), self.end = self._last, None
            self.most, self.top = at.state.load_factor, at.gone
        elif self.end is None:
            self.end, self.behind = at.gone, at.state.load_factor
        self._last = at, record

    def onward(self, at: OnPath) -> OnPath:
        """Return a place behind the peak, from where a step is longer the farther the peak is.

        Stiff bodies store little beside what it takes to bring the load down. Not where steps had
        to be cut.
        """
        if at.lost or at.state.load_factor >= self.most:
            return at
        return replace(at, advance=max(at.advance, ONWARD * (at.gone - self.top)))

    @property
    def through(self) -> float | None:
        """Load factor of an unstable place from which the load grows on; None without one.

        The place of the largest load is none: it may lie a little behind the peak.
        """
        return self.unstable if self.unstable is not None and self.unstable < self.peak else None

    @property
    def coarse(self) -> bool:
        """Whether the load falls by more than `FLAT` to a place beside its largest."""
        lowest = min(self.begin.state.load_factor, self.behind)
        further = self.end is not None and self.end > self.begin.gone
        return further and lowest < (1 - FLAT) * self.most


def refined(seen: AboutPeak, control: Control, follow: Follow) -> float:
    """Return the largest load factor of a path that has passed it, by shorter and shorter steps.

    Where shorter steps find no balance, or no peak, it is that of the longer ones.
    """
    most = seen.most
    for _ in range(ROUNDS):
        if not seen.coarse or seen.end is None:
            break
        control = replace(control, increment=FINER * control.increment, end=seen.end)
        at = replace(seen.begin, advance=control.increment, lost=0)
        seen = AboutPeak(at, seen.record)
        if follow(at, seen.record, control, seen).code != FAILURE:
            break
        most = max(most, seen.most)
    return most
