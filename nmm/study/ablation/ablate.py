"""A scene with each of its effects left out in turn: what changes, and the seconds saved."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from nmm.errors import FormulationError, NmmError, in_a_line
from nmm.formulation import Formulation
from nmm.model.called_for import called_for
from nmm.progress import Progress
from nmm.scene import Scene, build_scene
from nmm.scene.document import build
from nmm.scene.faults import Source
from nmm.study.ablation.omissions import Omission, omissions
from nmm.study.cases.measure import measure
from nmm.study.cases.quantities import check_quantity_name
from nmm.study.cases.record import Record
from nmm.study.cases.variants import StudyCase

MOTIONS = ("monitor:", "max:monitor:", "min:monitor:")
"""Beginnings of names of displacements."""
WHOLE = "the whole scene"
SOLVED, ROUNDED = 1e-9, 1e-12
"""Rounding of quantities: of what they are parts of in the whole scene; and of the largest of that
in any run, that of displacements of the largest coordinate too."""
LONG = 5.0
"""Seconds from which runs are not repeated for what their first one compiles."""


@dataclass(frozen=True)
class AblationRow:
    """A scene without one of its effects.

    Attributes
    ----------
    name
        What was left out.
    values
        Quantities, nan where the run has none.
    seconds
        Processor seconds, the best of the repeats; nan where it did not run.
    verdict
        How the run ended, or why it could not begin.
    """

    name: str
    values: tuple[float, ...]
    seconds: float
    verdict: str


@dataclass(frozen=True)
class Ablation:
    """The whole scene first, then without each of its effects.

    Attributes
    ----------
    quantities
        Names of what is compared.
    whole, rows
        The runs.
    span
        Largest coordinate of the scene (m).
    """

    quantities: tuple[str, ...]
    whole: AblationRow
    rows: tuple[AblationRow, ...]
    span: float = 0.0

    def rounding(self, name: str) -> float:
        """Size of a quantity up to which it is rounding, in its unit."""
        runs = [_largest(self._by_name(row), name) for row in (self.whole, *self.rows)]
        moves = self.span if name.startswith(MOTIONS) else 0.0
        largest = max([moves, *(size for size in runs if math.isfinite(size))])
        return max(ROUNDED * largest, SOLVED * runs[0] if math.isfinite(runs[0]) else 0.0)

    def _by_name(self, row: AblationRow) -> Mapping[str, float]:
        return dict(zip(self.quantities, row.values, strict=True))

    def changes(self, row: AblationRow) -> tuple[float, ...]:
        """Changes of the quantities, as shares of what they are parts of in the whole scene.

        Components of one vector, whose names differ in what follows the last colon, are shares of
        the largest of them. A change that is `rounding` is zero, that of what is so infinite.
        """
        return tuple(self._change(name, value) for name, value in self._by_name(row).items())

    def _change(self, name: str, value: float) -> float:
        whole, least = self._by_name(self.whole), self.rounding(name)
        change, size = value - whole[name], _largest(whole, name)
        if abs(change) <= least:
            return 0.0
        return math.copysign(math.inf, change) if size <= least else change / size

    def ends(self, row: AblationRow) -> bool:
        """Whether a run came to another end than the whole scene, without the quantities."""
        ran = not math.isnan(row.seconds) and row.verdict != self.whole.verdict
        return ran and any(math.isnan(value) for value in row.values)

    def saved(self, row: AblationRow) -> float:
        """Share of the seconds of the whole scene that is saved."""
        return 1.0 - row.seconds / self.whole.seconds if self.whole.seconds > 0 else math.nan


def ablate(
    scene: Scene,
    formulation: Formulation,
    quantities: Sequence[str] = (),
    repeats: int = 1,
    progress: Progress | None = None,
) -> Ablation:
    """Run a scene whole and without each of its effects.

    Parameters
    ----------
    quantities
        What is compared, see `nmm.study.cases.quantities`; else those of the scene's references,
        the factor of safety or the failure load that it asks for, displacements of its monitors, or
        the elastic energy.
    repeats
        Counted runs of each, after a warm-up where they are short.

    Raises
    ------
    NmmError
        When no run has a quantity, or the whole scene cannot be run.
    """
    # Numbers of summary and history are compared; frames may be asked for by what is left out.
    scene = scene.model_copy(update={"output": None})
    names = tuple(quantities) or _asked(scene)
    for name in names:
        check_quantity_name(scene, name)
    tables = scene.model_dump(mode="json", by_alias=True, exclude_defaults=True)
    method = formulation.model_dump(mode="json", exclude_defaults=True)
    whole = StudyCase(WHOLE, scene, formulation)
    cases, refused, called = [whole], [], called_for(scene)
    for omission in omissions(tables, method):
        if not called.get(omission.name, True):  # of two effects of one table
            continue
        try:
            cases.append(_case(omission, scene))
        except NmmError as fault:
            nothing = (math.nan,) * len(names)
            why = f"cannot be left out alone: {in_a_line(fault)}"
            refused.append(AblationRow(omission.name, nothing, math.nan, why))
    records = measure(cases, names, repeats, memory=False, progress=progress, long=LONG)
    if records[0].status == "error":
        raise NmmError(records[0].sentence)
    first, *rest = [_row(record, names) for record in records]
    return Ablation(names, first, (*rest, *refused), _span(scene))


def _span(scene: Scene) -> float:
    outlines = [one.vertices for one in scene.blocks]
    outlines += [one.region for one in scene.tessellations]
    return max((float(np.abs(ring).max()) for ring in outlines), default=0.0)


def _largest(values: Mapping[str, float], name: str) -> float:
    vector = name.rpartition(":")[0]
    parts = [other for other in values if vector and other.rpartition(":")[0] == vector]
    return max(abs(values[other]) for other in parts or [name])


def _asked(scene: Scene) -> tuple[str, ...]:
    stated = tuple(dict.fromkeys(one.quantity for one in scene.references))
    moved = tuple(f"monitor:{one.name}:u{axis}" for one in scene.monitors for axis in "xy")
    if scene.strength_reduction is not None:
        return stated or ("factor_of_safety",)
    if scene.loading is not None and scene.loading.until == "failure":
        return stated or ("failure_load", *moved)
    return stated or moved or ("energy",)


def _case(omission: Omission, scene: Scene) -> StudyCase:
    name = scene.source.name
    return StudyCase(
        omission.name,
        build_scene(omission.scene, name),
        build(omission.formulation, Formulation, Source(name), FormulationError),
    )


def _row(record: Record, names: Sequence[str]) -> AblationRow:
    values = tuple(record.quantities.get(name, math.nan) for name in names)
    seconds = min(record.seconds, default=math.nan)
    told = record.status if record.status != "error" else f"does not run: {record.sentence}"
    return AblationRow(record.name, values, seconds, told)
