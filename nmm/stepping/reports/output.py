"""Which accepted states of a run become frames: by time, by steps, by what happened in a step."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import floor, inf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nmm.scene.output import OutputTable

# Frames of a dynamic run and of the motion after failure; the last state is among them.
FRAMES, FRAMES_AFTER_FAILURE = 60, 30
TOUCHING = ("stick", "slide")
# Bytes of a contact point in a frame, and of the headers of a file.
CONTACT, HEADERS = 72, 4096
CHANGING = ("stick", "slide", "bonded", "broken")


@dataclass(frozen=True)
class FrameChoice:
    """What is stored of one stretch of a run.

    Attributes
    ----------
    begin
        Time at which the stretch begins (s).
    period
        Time between frames (s); None when time does not count.
    steps
        Steps between frames; None when they do not count.
    events
        What happens in a step that is stored.
    """

    begin: float
    period: float | None = None
    steps: int | None = None
    events: frozenset[str] = frozenset()

    def takes(self, time: float, steps: int, periods: int, happened: frozenset[str]) -> bool:
        """Return whether the state after so many ``steps`` of the stretch is stored.

        ``periods`` had passed when this was asked last.
        """
        due = self.steps is not None and steps % self.steps == 0
        due |= self.periods(time) > periods
        return due or not self.events.isdisjoint(happened)

    def next(self, periods: int) -> float:
        """Return the time (s) of the frame after so many periods; infinite where none counts."""
        return inf if self.period is None else self.begin + (periods + 1) * self.period

    def periods(self, time: float) -> int:
        """Return how many periods have passed."""
        return 0 if self.period is None else floor((time - self.begin) / self.period + 1e-9)


def choice_in_time(
    asked: "OutputTable | None", begin: float, duration: float, frames: int = FRAMES
) -> FrameChoice:
    """Return what is stored of a stretch in time."""
    if asked is None or not asked.chooses:
        return FrameChoice(begin, duration / frames)
    return FrameChoice(begin, asked.every_time, asked.every_steps, frozenset(asked.events))


def choice_under_loads(asked: "OutputTable | None") -> FrameChoice:
    """Return what is stored while loads grow, where there is no time."""
    if asked is None or (asked.every_steps is None and not asked.events):
        return FrameChoice(0.0, steps=1)
    return FrameChoice(0.0, None, asked.every_steps, frozenset(asked.events))


@dataclass(frozen=True)
class EventWatch:
    """What tells the events of the next step from the numbers of contact points in each state."""

    before: Mapping[str, int] = field(default_factory=dict)
    touched: bool = False
    slipped: bool = False

    def seen(self, counts: Mapping[str, int]) -> tuple["EventWatch", frozenset[str]]:
        """Return the watch after a step that leaves so many contacts in each state; its events."""
        touches = any(counts.get(name, 0) for name in TOUCHING)
        slips = counts.get("slide", 0) > 0
        found = {
            "first_contact": touches and not self.touched,
            "first_slip": slips and not self.slipped,
            "bond_breaks": counts.get("broken", 0) > self.before.get("broken", 0),
            "state_changes": any(
                counts.get(name, 0) != self.before.get(name, 0) for name in CHANGING
            ),
        }
        now = EventWatch(dict(counts), self.touched or touches, self.slipped or slips)
        return now, frozenset(name for name, true in found.items() if true)


@dataclass(frozen=True)
class Storage:
    """How much the frames of a run take.

    Attributes
    ----------
    frames
        How many at most, those of events left out; None when the run decides.
    bytes
        Of one frame without contacts in memory; on disk, where it is packed, it takes less.
    events
        Whether there is a frame for each event too.
    """

    frames: int | None
    bytes: int
    events: bool = False

    def __str__(self) -> str:
        one = (
            f"{_size(self.bytes)} each in memory, and {CONTACT} bytes a contact point, less on disk"
        )
        more = " and one for each event" if self.events else ""
        if self.frames is None:
            return f"frames: as many as the run comes to, {one}"
        whole = _size(self.frames * self.bytes)
        return f"frames: {self.frames:,} at most{more}, {one}; {whole} in all"


def storage(
    choice: FrameChoice, times: tuple[float, float | None] | None, points: int, elements: int
) -> Storage:
    """Return what frames of a run take; ``times`` are its duration and step, None under loads.

    The step is None where errors choose it.
    """
    size = 8 * (6 * points + 3 * elements) + HEADERS
    if times is None or (times[1] is None and choice.steps is not None):
        return Storage(None, size)
    duration, step = times
    steps, count = inf if step is None else duration / step, 2.0
    if choice.period is not None:
        count += min(duration / choice.period, steps)
    if choice.steps is not None:
        count += steps / choice.steps
    return Storage(int(min(count, steps + 2)), size, bool(choice.events))


def _size(count: float) -> str:
    for unit in ("bytes", "KiB", "MiB", "GiB"):
        if count < 1024 or unit == "GiB":
            break
        count /= 1024
    return f"{count:.3g} {unit}"
