"""The work of a run, counted: what a machine's speed and load do not change.

Passes are linear systems solved in contact, as the history has them; factorisations, sparse
matrices made and Python calls are counted by the profiler of Python's standard library.

python benchmarks/counted_work.py --record  # the small races anew, for `tests/test_counted_work.py`

Without it they are printed. What a process has run before changes its calls: counts are those of a
process of its own.
"""

import cProfile
import gc
import json
import platform
import pstats
import sys
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from importlib import metadata
from pathlib import Path

from race_scenes import SMALL, Race

from nmm.results.sink import MemorySink
from nmm.stepping.prepare import prepare
from nmm.stepping.simulation import Simulation

FACTORISED = ("nmm/solvers/factor.py", "of")
"""File and function that each factorisation goes through."""
SPARSE = ("scipy/sparse/_compressed.py", "__init__")
"""The same of a sparse matrix that is made."""
RECORD = Path(__file__).with_suffix(".json")
LIBRARIES = ("numpy", "scipy", "numba", "shapely")


@dataclass(frozen=True)
class Work:
    """Of a whole run, a step.

    Attributes
    ----------
    passes
        Linear systems of contact solved.
    factorisations
        Matrices factorised, but for full ones within compiled Newton.
    sparse
        Sparse matrices made.
    calls
        Python functions called, those of libraries and built-in ones among them.
    """

    passes: float
    factorisations: float
    sparse: float
    calls: float


@dataclass(frozen=True)
class Raced:
    """A run: what it found, and its work."""

    memory: MemorySink
    work: Work


def run(made: Simulation) -> MemorySink:
    """Run to the end."""
    memory = MemorySink()
    made.run([memory], lambda share, text: None)
    return memory


def raced(race: Race) -> Raced:
    """Run and count; the run is slowed down by its profiler."""
    made, profile = prepare(*race.made()), cProfile.Profile()
    gc.collect()
    gc.disable()  # what it finds of earlier runs would be counted as this one's
    try:
        memory = profile.runcall(run, made)
    finally:
        gc.enable()
    assert isinstance(memory, MemorySink)
    steps, found = max(len(memory.rows), 1), pstats.Stats(profile)
    counts = found.stats.items()  # type: ignore[attr-defined]

    def of(place: tuple[str, str]) -> float:
        file, name = place
        called = (
            row[0] for (path, _, function), row in counts if function == name and _is(path, file)
        )
        return sum(called) / steps

    passes = sum(row["passes"] for row in memory.rows) / steps
    calls = found.total_calls / steps  # type: ignore[attr-defined]
    return Raced(memory, Work(passes, of(FACTORISED), of(SPARSE), calls))


def lost(found: Work, recorded: Work, share: float) -> Iterable[str]:
    """Say which counts are more than ``share`` above those recorded."""
    for name, value in asdict(found).items():
        was = getattr(recorded, name)
        if value > (1 + share) * was + 1e-9:
            yield f"{name} a step: {value:.4g}, recorded {was:.4g}"


@dataclass(frozen=True)
class Recorded:
    """Work of the small races, by name, and what it was counted with."""

    made_with: dict[str, str]
    work: dict[str, Work]

    @property
    def comparable(self) -> bool:
        """Whether counts of this process may be held against it."""
        return self.made_with == made_with()


def recorded(text: str | None = None) -> Recorded:
    """Return what is on file, or in the text that `counts` made."""
    found = json.loads(RECORD.read_text() if text is None else text)
    return Recorded(found["made_with"], {name: Work(**row) for name, row in found["work"].items()})


def made_with() -> dict[str, str]:
    """Versions that counts depend on: other ones call other functions and round otherwise."""
    found = {"python": platform.python_version(), "machine": platform.machine()}
    return found | {name: metadata.version(name) for name in LIBRARIES}


def counts() -> str:
    """Count the small races, each the second time it runs; return them as they stand on file."""
    work = {}
    for name, race in SMALL.items():
        raced(race)
        work[name] = asdict(raced(race).work)
    rounded = {name: {key: round(v, 3) for key, v in row.items()} for name, row in work.items()}
    return json.dumps({"made_with": made_with(), "work": rounded}, indent=1) + "\n"


def _is(path: str, file: str) -> bool:
    return Path(path).as_posix().endswith(file)


if __name__ == "__main__":
    if "--record" in sys.argv:
        RECORD.write_text(counts())
    else:
        print(counts(), end="")
