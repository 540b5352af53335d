"""What is summed over the steps of a run."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from nmm.assembly.state import State
from nmm.stepping.reports.ledger import Ledger
from nmm.stepping.reports.lengths import StepLengths
from nmm.stepping.reports.output import EventWatch


@dataclass(frozen=True)
class Totals:
    """What a recorder knows of the run so far.

    Attributes
    ----------
    ledger
        Energies, and the number of accepted steps.
    passes, frames
        Linear systems solved, and frames stored.
    residual, penetration, stiffest
        Largest relative out-of-balance force, overlap (m) that forces go with, and stiffness of a
        contact (N/m).
    borne
        Largest sum of the sizes of the forces (N) of all contacts.
    overlap
        Largest overlap of bodies where steps end, over the size (root of the area) of the smaller.
    deepest
        How deep that was, of which bodies, and when, in words; empty before any overlapped.
    rebound, thrown
        Largest energy (J) with which an exact enforcement parts bodies in a step that does not
        resolve their impact (`rebounds`), and which these are, how fast, and when, in words.
    ways, alike
        Most ways in which a step along a path was not stable, and the load factor of the first step
        with more than one; None before any.
    largest, counts
        Contact points in each state: most of all steps, and after the last.
    watch
        What tells the events of a step.
    taken, periods
        Steps of this stretch of the run, and periods between frames that have passed.
    stored
        Whether the last state was stored as a frame.
    changes
        What events have changed so far, in words.
    since
        The state that the last change of what is solved has left; None before any.
    lengths
        Of the steps, where their error chooses them; else None.
    """

    ledger: Ledger = field(default_factory=Ledger)
    passes: int = 0
    frames: int = 0
    residual: float = 0.0
    penetration: float = 0.0
    overlap: float = 0.0
    deepest: str = ""
    rebound: float = 0.0
    thrown: str = ""
    stiffest: float = 0.0
    borne: float = 0.0
    ways: int = 0
    alike: float | None = None
    largest: Mapping[str, int] = field(default_factory=dict)
    counts: Mapping[str, int] = field(default_factory=dict)
    watch: EventWatch = field(default_factory=EventWatch)
    taken: int = 0
    periods: int = 0
    stored: bool = True
    changes: tuple[str, ...] = ()
    since: State | None = None
    lengths: StepLengths | None = None
