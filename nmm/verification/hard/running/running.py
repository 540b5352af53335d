"""Run hard cases and keep what came out."""

import signal
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from threading import current_thread, main_thread
from time import process_time

from nmm.errors import NmmError
from nmm.verification.base import Checks
from nmm.verification.hard.cases.base import Document, HardCase
from nmm.verification.hard.oracles.whole import GAVE_UP
from nmm.verification.hard.running.reducing import reduced
from nmm.verification.hard.running.registry import HARD


@dataclass(frozen=True)
class Finding:
    """What came out of one case.

    Attributes
    ----------
    group
        Name of its class.
    case
        The case.
    checks
        Quantities by name; empty where nothing could be run.
    fault
        Why nothing could be run: an error of the program's own, or a traceback's last line.
    crashed
        Whether that was no error raised on purpose.
    seconds
        Processor time.
    """

    group: str
    case: HardCase
    checks: Checks
    fault: str
    crashed: bool
    seconds: float

    @property
    def missed(self) -> list[str]:
        """Names of the quantities that miss."""
        return [name for name, check in self.checks.items() if not check.passed]

    @property
    def passed(self) -> bool:
        """Whether it ran and nothing misses."""
        return not self.fault and not self.missed

    @property
    def gave_up(self) -> str:
        """Why the solver gave up, which may be right; empty where it did not."""
        return self.checks[GAVE_UP].reason if GAVE_UP in self.checks else ""

    @property
    def words(self) -> str:
        """What misses, with figures; else why the solver gave up, or what was found."""
        if self.fault:
            return " ".join(self.fault.split())[:200]
        if self.gave_up and not self.missed:
            return f"{GAVE_UP}: {self.gave_up}"[:200]
        told = self.missed or list(self.checks)
        return "; ".join(f"{name} {self.checks[name].shown}" for name in told)


LONGEST = 120.0
"""Seconds of processor time after which a case is given up: that is a finding too."""


def judged(group: str, case: HardCase) -> Finding:
    """Run one case; whatever ends it is what is found."""
    started = process_time()
    checks: Checks = {}
    fault, crashed = "", False
    try:
        with _no_longer_than(LONGEST):
            checks = case.judge(case.scene)
    except NmmError as error:
        fault = str(error)
    except Exception as error:  # a traceback is a finding
        fault, crashed = f"{type(error).__name__}: {error}", True
    return Finding(group, case, checks, fault, crashed, process_time() - started)


@contextmanager
def _no_longer_than(seconds: float) -> Iterator[None]:
    """Raise `TimeoutError` in what takes longer; where timers are not to be had nothing is done."""
    if not hasattr(signal, "setitimer") or current_thread() is not main_thread():
        yield
        return

    def late(*_: object) -> None:
        raise TimeoutError(f"no end within {seconds:g} s of processor time")

    before = signal.signal(signal.SIGVTALRM, late)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)


def smallest(finding: Finding) -> tuple[Document, str]:
    """Return the smallest scene that fails as a finding does, and what it says then."""
    judge, wanted = finding.case.judge, _faults(finding)
    first = finding.fault.split(":")[0]

    def fails(scene: Document) -> bool:
        found = judged(finding.group, replace(finding.case, scene=scene))
        if finding.fault:
            return found.crashed == finding.crashed and found.fault.split(":")[0] == first
        return not found.fault and bool(wanted & _faults(found))

    scene = reduced(finding.case.scene, fails)
    words = judged(finding.group, replace(finding.case, scene=scene, judge=judge)).words
    return scene, words


def _faults(finding: Finding) -> set[str]:
    """Names of what misses; of a run that did not end, how its sentence begins."""
    return {f"{name} {finding.checks[name].reason[:25]}" for name in finding.missed}


def chosen_cases(
    classes: Iterable[str],
    seeds: Sequence[int],
    slow: bool = False,
    parts: Iterable[str] = (),
) -> Iterator[tuple[str, HardCase]]:
    """Yield the cases of classes with their class's name.

    Parameters
    ----------
    classes
        Names in `HARD` or ``module:Class``; all when empty.
    seeds
        What the generators draw from, one after the other; cheap classes go on from the first,
        several for each.
    slow
        Whether cases of more than a second or two are among them.
    parts
        Parts that a case must have, all of them; those of any when empty.
    """
    wanted = set(parts)
    for name in list(classes) or HARD.table:
        made = HARD.load_said(name)()
        for seed in range(seeds[0], seeds[0] + made.share * len(seeds)):
            for case in made.cases(seed):
                if wanted <= set(case.parts.values()) and (slow or not case.slow):
                    yield name, case
