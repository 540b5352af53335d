"""What accuracy costs in time: a scene under formulations and sizes, error against seconds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from nmm.formulation import Formulation
from nmm.scene import Scene
from nmm.study.measure import Progress, measure
from nmm.study.record import Record
from nmm.study.reference import Reference, by_name, extrapolated_reference, stated_reference
from nmm.study.variants import cases_of


@dataclass(frozen=True)
class CostStudy:
    """Measured records and the reference their errors are taken against."""

    title: str
    records: list[Record]
    reference: Reference

    def by_formulation(self) -> dict[str, list[Record]]:
        """Return the records of each formulation, in the order given."""
        return by_name(self.records)

    def error(self, record: Record) -> float:
        """Return the relative error of a record."""
        return self.reference.error(record)


def cost_study(
    scene: Scene,
    formulations: Mapping[str, Formulation],
    vary: Mapping[str, Sequence[Any]],
    name: str | None = None,
    repeats: int = 3,
    progress: Progress | None = None,
    memory: bool = True,
) -> CostStudy:
    """Run a scene under every formulation at every setting.

    Parameters
    ----------
    scene
        What happens.
    formulations
        By the name they get in tables and figures.
    vary
        Values by dotted key, such as ``formulation.cover.size`` or ``formulation.integrator.step``;
        all combinations are run.
    name
        The quantity; the scene's first ``[[reference]]`` when not given, else the elastic energy.
        One that no ``[[reference]]`` names is measured against an extrapolated value.
    repeats
        Counted repeats of each run.
    progress
        Called with the share done and what is run.
    memory
        Whether memory is measured, in a process of its own for each case.
    """
    stated = stated_reference(scene, name)
    quantity = name or (stated.quantity if stated else "energy")
    cases = cases_of(scene, formulations, vary)
    records = measure(cases, [quantity], repeats, memory, progress)
    reference = stated or extrapolated_reference(records, quantity)
    return CostStudy(scene.title, records, reference)


def write_records(records: Sequence[Record], path: Path) -> None:
    """Write records, one line of JSON each."""
    path.write_text("".join(one.to_json() + "\n" for one in records), encoding="utf-8")


def read_records(path: Path) -> list[Record]:
    """Read records back."""
    return [Record.from_json(line) for line in path.read_text(encoding="utf-8").splitlines()]
