"""What a scene will cost before it runs: seconds and memory from counts, fitted on this machine."""

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError

if TYPE_CHECKING:
    from nmm.stepping.simulation import Simulation

FILE = "cost_model.json"


@dataclass(frozen=True)
class Size:
    """Counts that the cost of a run depends on.

    Attributes
    ----------
    elements, unknowns
        Of the manifold.
    entries
        Entries of all element matrices, ``sum L^2``.
    edges
        Boundary edges that contact is searched among; 0 without contact.
    steps
        Steps or load increments. Contact passes are not told beforehand; their usual number is in
        the coefficients.
    """

    elements: int
    unknowns: int
    entries: int
    edges: int
    steps: float

    @property
    def kind(self) -> str:
        """Runs with and without contact are fitted apart."""
        return "contact" if self.edges else "alone"

    def preparation(self) -> Floats:
        """Terms of the seconds of geometry, covers and effects."""
        return np.array([1.0, self.elements, self.entries, self.edges])

    def running(self) -> Floats:
        """Terms of the seconds of the run: once, and for each step.

        Factors of a plane mesh in nested dissection take ``N^1.5`` operations (George 1973).
        """
        n, s = float(self.unknowns), self.steps
        return np.array([1.0, s, s * self.entries, s * n, s * n**1.5, s * self.edges])

    def storage(self) -> Floats:
        """Terms of the memory; factors of a plane mesh hold ``N log N`` numbers (George 1973)."""
        n = float(self.unknowns)
        return np.array([1.0, self.elements, self.entries, n * np.log2(n + 2), self.edges])


@dataclass(frozen=True)
class MeasuredRun:
    """A run that was measured: its size, processor seconds, and bytes (None when not taken)."""

    name: str
    size: Size
    preparing: float
    running: float
    memory: int | None


@dataclass(frozen=True)
class Coefficients:
    """Coefficients of the terms of `Size`, none negative."""

    preparing: tuple[float, ...]
    running: tuple[float, ...]
    memory: tuple[float, ...]


@dataclass(frozen=True)
class CostModel:
    """Coefficients by kind of run, and how well they fit.

    Attributes
    ----------
    coefficients
        By `Size.kind`.
    spread_seconds, spread_memory
        Largest factor between fit and measurement.
    largest
        Unknowns of the largest scene of each kind it was fitted on.
    machine
        Where.
    """

    coefficients: Mapping[str, Coefficients]
    spread_seconds: float
    spread_memory: float
    largest: Mapping[str, int]
    machine: str

    def seconds(self, size: Size) -> float:
        """Processor seconds of a whole run."""
        of = self.coefficients[size.kind]
        return float(size.preparation() @ of.preparing) + float(size.running() @ of.running)

    def bytes(self, size: Size) -> float:
        """Bytes that a run adds to a fresh process at its peak."""
        return float(size.storage() @ self.coefficients[size.kind].memory)

    def to_json(self) -> str:
        """Return the model as JSON."""
        return json.dumps(asdict(self), indent=2) + "\n"

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Read a model back."""
        values: dict[str, Any] = json.loads(text)
        values["coefficients"] = {
            kind: Coefficients(**{name: tuple(many) for name, many in of.items()})
            for kind, of in values["coefficients"].items()
        }
        return cls(**values)


def fit(measured: Sequence[MeasuredRun], machine: str) -> CostModel:
    """Fit all coefficients so that relative errors are least.

    Raises
    ------
    NmmError
        When there are too few measurements of a kind.
    """
    kinds = {
        one.size.kind: [o for o in measured if o.size.kind == one.size.kind] for one in measured
    }
    coefficients = {kind: _coefficients(kind, many) for kind, many in kinds.items()}
    largest = {kind: max(one.size.unknowns for one in many) for kind, many in kinds.items()}
    model = CostModel(coefficients, 1.0, 1.0, largest, machine)
    seconds = [factor(model.seconds(one.size), one.preparing + one.running) for one in measured]
    factors = [factor(model.bytes(one.size), float(one.memory)) for one in measured if one.memory]
    return replace(model, spread_seconds=max(seconds), spread_memory=max(factors, default=1.0))


def _coefficients(kind: str, measured: Sequence[MeasuredRun]) -> Coefficients:
    if len(measured) < 4:
        raise NmmError(
            f"cost model, {kind}: {len(measured)} measurements: expected at least 4: run more"
        )
    stored = [one for one in measured if one.memory]
    return Coefficients(
        _fit([one.size.preparation() for one in measured], [one.preparing for one in measured]),
        _fit([one.size.running() for one in measured], [one.running for one in measured]),
        _fit([one.size.storage() for one in stored], [float(one.memory or 0) for one in stored]),
    )


def factor(one: float, other: float) -> float:
    """Return how many times the larger of two numbers is the smaller."""
    low, high = sorted((one, other))
    return high / low if low > 0 else float("inf")


def size_of(simulation: "Simulation", steps: float) -> Size:
    """Count what a compiled scene will cost."""
    manifold = simulation.stepper.model.manifold
    entries = sum(
        group.unknowns.shape[0] * group.unknowns.shape[1] ** 2 for group in manifold.groups
    )
    edges = len(manifold.boundary.start) if simulation.scene.contact is not None else 0
    return Size(len(manifold.elements), manifold.n_unknowns, int(entries), edges, steps)


def steps_of(simulation: "Simulation") -> float | None:
    """Return the number of steps of a run; None when the load at failure, or errors decide."""
    scene, formulation = simulation.scene, simulation.formulation
    if scene.inertia is not None and scene.duration is not None:
        step = formulation.integrator.fixed_step
        return None if step is None else float(np.ceil(scene.duration / step))
    if scene.loading is None:
        return 1.0
    if scene.loading.until == "failure":
        return None
    return float(np.ceil(float(scene.loading.until) / formulation.loading.increment))


def cache_folder() -> Path:
    """Return the user's cache folder of nmm."""
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "nmm"


def save_model(model: CostModel, folder: Path | None = None) -> Path:
    """Write the model where `load_model` finds it."""
    path = (folder or cache_folder()) / FILE
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(model.to_json(), encoding="utf-8")
    return path


def load_model(folder: Path | None = None) -> CostModel | None:
    """Return the model of this machine; None when it was never fitted."""
    try:
        return CostModel.from_json((folder or cache_folder()).joinpath(FILE).read_text())
    except (OSError, ValueError, TypeError, KeyError):
        return None


def _fit(rows: Sequence[Floats], values: Sequence[float]) -> tuple[float, ...]:
    from scipy.optimize import nnls

    terms, target = np.array(rows), np.array(values)
    relative = terms / target[:, None]
    scale = np.where((top := relative.max(axis=0)) > 0, top, 1.0)
    found, _ = nnls(relative / scale, np.ones(len(target)))
    return tuple(float(value) for value in found / scale)
