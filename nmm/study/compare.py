"""One scene under several formulations: one page of pictures and a table."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import process_time

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.formulation import Formulation
from nmm.progress import Progress
from nmm.results.frame import Frame
from nmm.results.storage.writing import told, write_text
from nmm.scene import Scene
from nmm.stepping.run import Run, run
from nmm.study.cases.block_covers import blocks_of
from nmm.study.cases.measure import machine, method_of
from nmm.study.cases.memory import added_memory
from nmm.study.cases.variants import StudyCase
from nmm.study.samples import Raster, SampledFields, fields, raster


@dataclass(frozen=True)
class Compared:
    """A formulation and what it came to; ``run`` is None when it could not be run.

    ``method`` is its cover with the degree, by which every figure gives it one colour.
    """

    name: str
    family: str
    method: str
    run: Run | None
    fields: SampledFields | None
    seconds: float
    memory: int | None
    fault: str = ""


@dataclass(frozen=True)
class Comparison:
    """Runs of one scene and the points at which they are compared."""

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


def compare_formulations(
    scene: Scene,
    formulations: Mapping[str, Formulation],
    memory: bool = True,
    progress: Progress | None = None,
) -> Comparison:
    """Run a scene under every formulation, once to warm up and once for the time.

    Raises
    ------
    NmmError
        When no formulation can be run.
    """
    from nmm.geometry.regions import regions

    grid = raster(regions(scene).polygons)
    tell = progress or (lambda share, text: None)
    found = []
    for number, (name, formulation) in enumerate(formulations.items()):
        tell(number / len(formulations), name)
        found.append(_compared(StudyCase(name, scene, formulation), grid, memory))
    if all(one.run is None for one in found):
        raise NmmError(f"{found[0].name}: {found[0].fault}")
    return Comparison(scene.title, grid, found)


def _compared(case: StudyCase, grid: Raster, memory: bool) -> Compared:
    family = "manifold" if blocks_of(case.formulation.cover) is None else "DDA"
    method = method_of(case.formulation)["cover"]
    try:
        run(case.scene, case.formulation)
        started = process_time()
        done = run(case.scene, case.formulation)
        seconds = process_time() - started
        peak = added_memory(case) if memory else None
        seen = fields(done, grid.points)
        return Compared(case.name, family, method, done, seen, seconds, peak)
    # Whatever breaks under one formulation is told on the page beside the others.
    except Exception as fault:
        kind = "" if isinstance(fault, NmmError) else f"{type(fault).__name__}: "
        sentence = " ".join(f"{kind}{fault}".split())
        return Compared(case.name, family, method, None, None, float("nan"), None, sentence)


def write_comparison(study: Comparison, out: Path) -> list[Path]:
    """Write ``compare.md`` and ``compare.png`` into a folder; return their paths."""
    with told(out):
        out.mkdir(parents=True, exist_ok=True)
    page, picture = out / "compare.md", out / "compare.png"
    draw(study, picture)
    write_text(page, comparison_page(study, picture.name))
    return [page, picture]


def draw(study: Comparison, path: Path) -> None:
    """Draw the page's figure."""
    from nmm.plots.results.comparison import Shown, comparison
    from nmm.results.viewing.paraview import contact_vectors

    made, image = study.made, study.raster.image
    x, y = curve_columns(made[0][1])
    shown = [
        Shown(
            one.name,
            one.family,
            one.method,
            image(np.hypot(*values.displacement.T)),
            image(values.mises),
            last_frame(done).contact_position,
            contact_vectors(last_frame(done)),
            done.history.get(x, np.empty(0)),
            done.history.get(y, np.empty(0)),
        )
        for one, done, values in made
    ]
    differences = [
        (one.displacement - shown[0].displacement, one.stress - shown[0].stress)
        for one in shown[1:]
    ]
    comparison(shown, differences, study.raster.extent, title=study.title, curve=(x, y), path=path)


def last_frame(run: Run) -> Frame:
    """Return the last frame of a run in equilibrium; what moves after failure is not compared."""
    return next((one for one in reversed(run.frames) if one.stage != "failure"), run.frames[-1])


def curve_columns(run: Run) -> tuple[str, str]:
    """Return what grows in a run, and the monitor that moved most, else the elastic energy."""
    known = run.history
    clock = "load_factor" if np.ptp(known.get("load_factor", np.zeros(1))) > 0 else "time"
    moved = [name for name in known if name.startswith("monitor:")]
    most = max(moved, key=lambda name: float(np.nanmax(np.abs(known[name]))), default="")
    return clock, most or "strain_energy"


def comparison_page(study: Comparison, picture: str) -> str:
    """Return the page in Markdown."""
    names = [one.name for one in study.runs]
    lines = [
        f"# {study.title or 'scene'}: {', '.join(names)}",
        "",
        f"![{' and '.join(names)}]({picture})",
        "",
        f"| | {' | '.join(names)} |",
        f"|---|{'---|' * len(names)}",
        *(_row(words, study.runs, read) for words, read in ROWS),
        "",
        *_distances(study),
        "",
        *(f"- {one.name}: {one.fault or _sentence(one)}" for one in study.runs),
        "",
        f"Displacement and stress are taken at {len(study.raster.points):,} common points. Colour "
        "scales hold 99.5 % of the values. Seconds are processor seconds of one run after a "
        "warm-up; memory is what a run adds to a fresh process at its peak. "
        f"{machine()}.",
    ]
    return "\n".join(lines) + "\n"


def _row(
    words: str, runs: Sequence[Compared], read: "Callable[[Compared], float | int | str | None]"
) -> str:
    return f"| {words} | {' | '.join(_text(read(one)) for one in runs)} |"


def _of(name: str) -> "Callable[[Compared], float | int | str | None]":
    """Return what reads a number off the summary."""
    return lambda one: None if one.run is None else getattr(one.run.summary, name)


def _energy(one: Compared) -> float | None:
    return None if one.run is None else _last(one.run.history.get("strain_energy"))


def _largest_contact(one: Compared) -> float | None:
    if one.run is None or not len(force := last_frame(one.run).contact_force):
        return None
    return float(np.hypot(*force.T).max())


ROWS: tuple[tuple[str, "Callable[[Compared], float | int | str | None]"], ...] = (
    ("family", lambda one: one.family),
    ("verdict", lambda one: "error" if one.run is None else one.run.summary.status),
    ("failure load (N)", _of("failure_load")),
    ("failure load factor", _of("failure_factor")),
    ("elastic energy at the end (J)", _energy),
    ("largest contact force at the end (N)", _largest_contact),
    ("elements", _of("elements")),
    ("unknowns", _of("unknowns")),
    ("steps", _of("steps")),
    ("contact passes", _of("passes")),
    ("processor seconds", lambda one: one.seconds),
    ("memory (MiB)", lambda one: None if one.memory is None else one.memory / 2**20),
)


def _text(value: float | int | str | None) -> str:
    if value is None or value != value:
        return "-"
    if isinstance(value, float):
        return f"{value:.5g}"
    return value if isinstance(value, str) else f"{value:,}"


def _sentence(one: Compared) -> str:
    return "" if one.run is None else one.run.summary.sentence


def _distances(study: Comparison) -> list[str]:
    """Root mean square difference from the first run over the root mean square of the first."""
    made = study.made
    first, _, base = made[0]
    lines = []
    for one, _, other in made[1:]:
        moved = _distance(other.displacement, base.displacement)
        stress = _distance(other.stress, base.stress)
        lines.append(
            f"- {one.name} differs from {first.name} by {100 * moved:.3g} % in displacement and "
            f"{100 * stress:.3g} % in stress (root mean square over the common points)"
        )
    return lines


def _distance(other: Floats, base: Floats) -> float:
    size = np.sqrt(np.nanmean(base**2))
    return float(np.sqrt(np.nanmean((other - base) ** 2)) / size) if size else float("nan")


def _last(column: Floats | None) -> float | None:
    return None if column is None or not len(column) else float(column[-1])
