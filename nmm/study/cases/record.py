"""What is kept of one measured case: numbers, cost, and all that it can be repeated from."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, Self

import numpy as np

VALID = ("converged", "failure_load")
"""Verdicts of runs whose numbers may be used."""


@dataclass(frozen=True)
class Record:
    """One case of a study.

    Attributes
    ----------
    name, settings, key
        Formulation, what the case differs in, content hash.
    status, sentence
        Verdict of the run; a case that raised has status "error".
    quantities
        Numbers read off the run.
    seconds
        Processor seconds of every counted repeat.
    wall
        Wall-clock seconds of every counted repeat.
    phases, effects
        Wall-clock seconds by phase and by effect of the median repeat.
    unknowns, elements, steps, passes
        Sizes.
    memory
        Bytes that the run added to the process, at its peak; None when not measured.
    cover
        Type of the cover; "skfem" is the elements of scikit-fem.
    family
        "DDA" (one cover a block or sub-block), "elements" or "manifold".
    spanned
        Degree of the complete polynomials among the displacements; None where no order is known.
    method
        Cover and degree, enforcement, integrator in words.
    scene_hash, formulation_hash, seed, versions, machine, commit
        What was run, and with what it was measured; the commit when run from a checkout.
    """

    name: str
    settings: Mapping[str, Any]
    key: str
    status: str
    sentence: str
    quantities: Mapping[str, float] = field(default_factory=dict)
    seconds: tuple[float, ...] = ()
    wall: tuple[float, ...] = ()
    phases: Mapping[str, float] = field(default_factory=dict)
    effects: Mapping[str, float] = field(default_factory=dict)
    unknowns: int = 0
    elements: int = 0
    steps: int = 0
    passes: int = 0
    memory: int | None = None
    cover: str = ""
    family: str = "manifold"
    spanned: int | None = None
    method: Mapping[str, str] = field(default_factory=dict)
    scene_hash: str = ""
    formulation_hash: str = ""
    seed: int | None = None
    versions: Mapping[str, str] = field(default_factory=dict)
    machine: str = ""
    commit: str = ""

    @property
    def valid(self) -> bool:
        """Whether the run's numbers may be used."""
        return self.status in VALID

    @property
    def median_seconds(self) -> float:
        """Median processor seconds."""
        return float(np.median(self.seconds)) if self.seconds else float("nan")

    @property
    def by_effect(self) -> dict[str, float]:
        """Seconds by effect: the search is contact's, its solution is named as such."""
        found = dict(self.effects)
        if "contact" in found:
            found["contact"] += self.phases.get("search", 0.0)
            found["solution with contact"] = self.phases.get("solve", 0.0)
        return found

    @property
    def label(self) -> str:
        """Name and settings in words."""
        return labelled(self.name, self.settings)

    def to_json(self) -> str:
        """Return the record as one line of JSON; nan becomes null."""
        return json.dumps(_plain(asdict(self)), allow_nan=False)

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Read a record back; null among the numbers becomes nan."""
        values = json.loads(text)
        values["quantities"] = {
            name: float("nan") if value is None else value
            for name, value in values["quantities"].items()
        }
        for name in ("seconds", "wall"):
            values[name] = tuple(values[name])
        return cls(**values)


def labelled(name: str, settings: Mapping[str, Any]) -> str:
    """Return a name with settings in words."""
    words = ", ".join(f"{key} = {value}" for key, value in settings.items())
    return f"{name} ({words})" if words else name


def finest(records: Sequence[Record]) -> Record:
    """Return the dearest of records in processor seconds, a valid one where there is one."""
    valid = [one for one in records if one.valid and one.seconds] or list(records)
    return max(valid, key=lambda one: one.median_seconds if one.seconds else -1.0)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    if hasattr(value, "item"):
        value = value.item()
    return None if isinstance(value, float) and not np.isfinite(value) else value
