"""Runs that are compared: scenes of one case, each under one formulation, seen at common points."""

from collections.abc import Sequence
from dataclasses import dataclass
from time import process_time

from nmm.errors import NmmError, in_a_line
from nmm.progress import Progress
from nmm.stepping.drive.verdict import status_code
from nmm.stepping.run import Run, run
from nmm.study.cases.families import family_of
from nmm.study.cases.measure import method_of
from nmm.study.cases.memory import added_memory
from nmm.study.cases.variants import StudyCase
from nmm.study.samples import Raster, SampledFields, fields, raster

# Seconds beside which what a process does once, imports and compiled functions, is nothing.
LONG = 20.0


@dataclass(frozen=True)
class Compared:
    """A case and what it came to; ``run`` is None when it could not be run.

    ``method`` is its cover with the degree, by which every figure gives it one colour; ``in_time``
    says whether time passes in its scene.
    """

    name: str
    family: str
    method: str
    run: Run | None
    fields: SampledFields | None
    seconds: float
    memory: int | None
    fault: str = ""
    in_time: bool = False


@dataclass(frozen=True)
class Comparison:
    """Runs and the points at which they are compared."""

    title: str
    raster: Raster
    runs: list[Compared]

    @property
    def made(self) -> list[tuple[Compared, Run, SampledFields]]:
        """The runs that could be made."""
        return [
            (one, one.run, one.fields)
            for one in self.runs
            if one.run is not None and one.fields is not None
        ]


def compare_cases(
    cases: Sequence[StudyCase], memory: bool = True, progress: Progress | None = None
) -> Comparison:
    """Run every case, once to warm up and once for the time; what is long needs no warming up.

    The points at which fields are seen lie in the blocks of the first.

    Raises
    ------
    NmmError
        When none of them can be run.
    """
    from nmm.geometry.regions import regions

    grid = raster(regions(cases[0].scene).polygons)
    tell = progress or (lambda share, text: None)
    found = []
    for number, case in enumerate(cases):
        tell(number / len(cases), case.name)
        found.append(_compared(case, grid, memory))
    if all(one.run is None for one in found):
        raise NmmError(f"{found[0].name}: {found[0].fault}")
    return Comparison(cases[0].scene.title, grid, found)


def exit_code(study: Comparison) -> int:
    """Return 1 where a case could not be run, else what the first run that ended badly leaves."""
    if any(one.run is None for one in study.runs):
        return 1
    codes = (status_code(run.summary.status) for _, run, _ in study.made)
    return next((code for code in codes if code), 0)


def _timed(case: StudyCase) -> tuple[Run, float]:
    started = process_time()
    return run(case.scene, case.formulation), process_time() - started


def _compared(case: StudyCase, grid: Raster, memory: bool) -> Compared:
    family = family_of(case.formulation.cover)
    method = method_of(case.formulation)["cover"]
    try:
        done, seconds = _timed(case)
        if seconds < LONG:
            done, seconds = _timed(case)
        peak = added_memory(case) if memory else None
        seen = fields(done, grid.points)
        passes = case.scene.in_time
        return Compared(case.name, family, method, done, seen, seconds, peak, in_time=passes)
    # Whatever breaks in one case is told on the page beside the others.
    except Exception as fault:
        told = in_a_line(fault)
        return Compared(case.name, family, method, None, None, float("nan"), None, told)
