"""What accuracy costs in time: a scene under formulations and sizes, error against seconds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from nmm.errors import NmmError
from nmm.formulation import Formulation
from nmm.progress import Progress
from nmm.scene import Scene
from nmm.study.cases.measure import measure
from nmm.study.cases.quantities import check_quantity_name
from nmm.study.cases.record import Record
from nmm.study.cases.running import SKFEM
from nmm.study.cases.variants import cases_of
from nmm.study.cost.front import front
from nmm.study.cost.reference import Reference, by_name, extrapolated_reference, stated_reference

ELEMENTS = ("P1", "P2", "P3", "P4")
# Keys of a scene that say how finely it is divided: its answer tends to a limit with them.
FINENESS = (".blocks", ".spacing")


@dataclass(frozen=True)
class CostStudy:
    """Measured records and the reference their errors are taken against.

    ``exponent`` is that of the strongest singularity of the solution, None where it is smooth or
    not known; theory's orders depend on it.
    """

    title: str
    records: list[Record]
    reference: Reference
    exponent: float | None = None

    def by_formulation(self) -> dict[str, list[Record]]:
        """Return the records of each formulation, in the order given."""
        return by_name(self.records)

    def error(self, record: Record) -> float:
        """Return the relative error of a record."""
        return self.reference.error(record)

    @property
    def floor(self) -> float:
        """Relative error below which the reference says nothing."""
        reference = self.reference
        if not reference.extrapolated:
            return 0.0
        return reference.uncertainty / (abs(reference.value) or 1.0)

    def errors(self, records: Sequence[Record]) -> list[float]:
        """Errors, nan for failed runs; none below what the reference can tell."""
        return [max(self.error(one), self.floor) if one.valid else np.nan for one in records]

    def points(self, cost: str) -> dict[str, tuple[list[float], list[float]]]:
        """Return a cost ("median_seconds", "unknowns") and error of the runs of formulations."""
        return {
            name: ([float(getattr(one, cost) or np.nan) for one in many], self.errors(many))
            for name, many in self.by_formulation().items()
        }

    def front(self) -> list[Record]:
        """Return the records that none beats in both seconds and error."""
        seconds = [one.median_seconds for one in self.records]
        best = front(seconds, self.errors(self.records)).tolist()
        return [one for one, on in zip(self.records, best, strict=True) if on]


def cost_study(
    scene: Scene,
    formulations: Mapping[str, Formulation],
    vary: Mapping[str, Sequence[Any]],
    name: str | None = None,
    repeats: int = 3,
    progress: Progress | None = None,
    memory: bool = True,
    exponent: float | None = None,
    reference: Reference | None = None,
) -> CostStudy:
    """Run a scene under every formulation at every setting.

    The scene's own reference is for the scene as it stands: where ``vary`` divides it into more
    blocks, errors are measured against an extrapolated value.

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
    exponent
        Of the strongest singularity: displacements are like r^exponent there. 1/2 at crack tips.
    reference
        What errors are taken against, in place of the scene's own or an extrapolated value.

    Raises
    ------
    NmmError
        When ``vary`` changes the answer of the scene, or no reference can be found.
    """
    divided = _divided(vary)
    cases = cases_of(scene, formulations, vary)
    stated = reference or stated_reference(scene, name)
    quantity = name or (stated.quantity if stated else "energy")
    check_quantity_name(scene, quantity)
    records = measure(cases, [quantity], repeats, memory, progress)
    if not any(one.valid for one in records):
        raise NmmError(f"all {len(records)} runs failed; {records[0].label}: {records[0].sentence}")
    usable = None if divided else stated
    found = usable or extrapolated_reference(records, quantity)
    return CostStudy(scene.title, records, found, exponent)


def yardsticks(names: Sequence[str]) -> dict[str, Formulation]:
    """Return formulations of the finite elements of scikit-fem, ``P1`` to ``P4``, by title.

    Raises
    ------
    NmmError
        When a name is another one.
    """
    found = {}
    for name in names:
        if name not in ELEMENTS:
            raise NmmError(
                f"--yardstick {name}: expected some of {', '.join(ELEMENTS)}: choose one"
            )
        cover = {"type": SKFEM, "degree": int(name[1])}
        title = f"scikit-fem {name}"
        found[title] = Formulation.model_validate({"title": title, "cover": cover})
    return found


def _divided(vary: Mapping[str, Sequence[Any]]) -> bool:
    """Whether values change how finely the scene is divided; refuse what changes its answer."""
    changed = [key for key in vary if not key.startswith("formulation.")]
    for key in changed:
        if not key.endswith(FINENESS):
            raise NmmError(
                f"--vary {key}: changes the scene and so its answer, and errors have nothing in "
                "common to be measured against: expected keys of the formulation, or a number of "
                "blocks: use nmm study"
            )
    return bool(changed)


def write_records(records: Sequence[Record], path: Path) -> None:
    """Write records, one line of JSON each."""
    path.write_text("".join(one.to_json() + "\n" for one in records), encoding="utf-8")


def read_records(path: Path) -> list[Record]:
    """Read records back."""
    return [Record.from_json(line) for line in path.read_text(encoding="utf-8").splitlines()]
