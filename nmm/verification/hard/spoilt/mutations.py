"""Spoilt files by the thousands: each is read and prepared, or refused by line; nothing else."""

import re
import signal
import traceback
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from random import Random
from time import process_time
from tomllib import loads
from types import FrameType

from nmm import capacity
from nmm.errors import NmmError
from nmm.formulation import Formulation, parse_formulation
from nmm.scene import Scene, parse_scene
from nmm.verification.base import Check, Checks, limit
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.oracles.echoes import lost
from nmm.verification.hard.spoilt.mutators import keys_of, mutated
from nmm.verification.hard.spoilt.sound_files import examples, formulations, minimal

PLACE = "file.toml"
# Processor seconds that a file may take to be refused or prepared, and bytes that it may ask for.
LONGEST, MEMORY = 10.0, 2e8
COUNT = 50

REFUSED, SOUND = "refused", "sound"


@dataclass(frozen=True)
class MutationVerdict:
    """What came of one text.

    Attributes
    ----------
    outcome
        "refused", "sound", or what is wrong: the last call of a traceback, "late", "lost KEY",
        "told badly".
    words
        More of it.
    seconds
        Processor time.
    """

    outcome: str
    words: str
    seconds: float

    @property
    def good(self) -> bool:
        """Whether the text was refused in words, or read and prepared as it stands."""
        return self.outcome in (REFUSED, SOUND)


class LateError(BaseException):
    """Raised by the clock; no handler of ordinary errors catches it."""


def verdict(text: str, kind: str = "scene", longest: float = LONGEST) -> MutationVerdict:
    """Read a text and prepare its run under a limit of time and memory.

    Parameters
    ----------
    text
        Of a file.
    kind
        "scene", or "formulation", which is prepared with a small scene.
    longest
        Seconds of processor time.
    """
    began = process_time()
    try:
        with _clock(longest), capacity.limited(MEMORY), warnings.catch_warnings():
            warnings.simplefilter("error")
            outcome, words = _read(text, kind)
    except NmmError as error:
        outcome, words = _told(error), str(error)
    except LateError:
        outcome, words = "late", f"not done in {longest:g} s"
    except Exception as error:  # a traceback is what is looked for
        last = traceback.extract_tb(error.__traceback__)[-1]
        outcome = f"{type(error).__name__} in {last.name} of {last.filename.rpartition('/')[2]}"
        words = f"{error}"
    return MutationVerdict(outcome, words, process_time() - began)


def _read(text: str, kind: str) -> tuple[str, str]:
    from nmm.stepping.prepare import prepare

    model: Scene | Formulation
    if kind == "scene":
        model = scene = parse_scene(text, PLACE)
        method = scene.formulation or Formulation()
    else:
        model = method = parse_formulation(text, PLACE)
        scene = parse_scene(minimal()["dynamic"])
    for path in lost(loads(text.removeprefix("\ufeff")), model):
        return f"lost {path}", "the file says it and the model does not"
    prepare(scene, method).identity()
    return SOUND, ""


def _told(error: NmmError) -> str:
    """Say whether the faults are lines that name a place, a value and what to do."""
    lines = str(error).splitlines()
    if len(lines) != len(error.faults):
        return "told badly: more than a line a fault"
    if not all(line.isprintable() for line in lines):
        return "told badly: signs that move a terminal"
    if not all(re.match(rf"{PLACE}.*: .*: ", line) for line in lines):
        return "told badly: no place or no remedy"
    return REFUSED


@contextmanager
def _clock(seconds: float) -> Iterator[None]:
    """Raise `LateError` when the time is over; only where the system has such a clock."""

    def ring(number: int, frame: FrameType | None) -> None:
        raise LateError

    before = signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def spoilt(base: str, seed: int, number: int) -> tuple[str, str]:
    """Return a spoilt text and its kind: the ``number``-th of a seed from the sound file ``base``.

    The same three always give the same text.
    """
    kind, text = sound_files()[base]
    keys = keys_of(Scene if kind == "scene" else Formulation)
    return mutated(text, Random(f"{base} {seed} {number}"), keys), kind


@cache
def sound_files() -> Mapping[str, tuple[str, str]]:
    """Return the kind and the text of every file that is spoilt, by name."""
    scenes = {**minimal(), **examples()}
    return {
        **{name: ("scene", text) for name, text in scenes.items()},
        **{f"formulation {name}": ("formulation", text) for name, text in formulations().items()},
    }


def bases(fast: bool = True) -> list[str]:
    """Return names of sound files; not those of examples that take a second or more if ``fast``."""
    small = [*minimal(), "formulation method"]
    return small if fast else [*small, *(name for name in sound_files() if name not in small)]


def shrunk(text: str, kind: str, outcome: str, longest: float = LONGEST) -> str:
    """Return a text with as few tables and lines as still give the same outcome."""

    def same(parts: list[str]) -> bool:
        return verdict("".join(parts), kind, longest).outcome == outcome

    tables = re.split(r"^(?=\[)", text, flags=re.MULTILINE)
    return "".join(_fewest("".join(_fewest(tables, same)).splitlines(keepends=True), same))


def _fewest(parts: list[str], same: Callable[[list[str]], bool]) -> list[str]:
    """Leave out one part after the other, again while that helps."""
    before = len(parts) + 1
    while len(parts) < before:
        before, at = len(parts), 0
        while at < len(parts):
            fewer = parts[:at] + parts[at + 1 :]
            if fewer and same(fewer):
                parts = fewer
            else:
                at += 1
    return parts


class Mutations(HardClass):
    """Files with one to three small faults."""

    name = "mutations"
    title = f"sound files spoilt in one to three places, {COUNT} a case"
    oracle = "refused by line or prepared as they stand, in time; no traceback, nothing dropped"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield a case for each sound file; those of the examples are slow."""
        quick = bases()
        for base in bases(fast=False):
            scene = {"base": base, "seed": seed, "numbers": list(range(COUNT))}
            label = f"{base}, seed {seed}"
            yield HardCase(label, scene, judged, {"base": base}, slow=base not in quick)


def judged(scene: Document) -> Checks:
    """Spoil a sound file in the ways of a case and count what is wrong."""
    found: list[tuple[int, MutationVerdict]] = []
    for number in scene["numbers"]:
        text, kind = spoilt(scene["base"], scene["seed"], number)
        found.append((number, verdict(text, kind)))
    wrong = {number: one for number, one in found if not one.good}
    words = "; ".join(f"number {n}: {one.outcome}: {one.words}"[:300] for n, one in wrong.items())
    slowest = max(one.seconds for _, one in found)
    return {
        "silent faults": Check(float(len(wrong)), 0.0, 0.0, words or "none is allowed"),
        "slowest (s)": limit(slowest, LONGEST, "a person waits"),
    }
