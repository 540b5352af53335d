"""What a scene will cost before it runs: seconds and memory from counts, fitted on this machine."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.study.cost.run_size import Size


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


def _fit(rows: Sequence[Floats], values: Sequence[float]) -> tuple[float, ...]:
    from scipy.optimize import nnls

    terms, target = np.array(rows), np.array(values)
    relative = terms / target[:, None]
    scale = np.where((top := relative.max(axis=0)) > 0, top, 1.0)
    found, _ = nnls(relative / scale, np.ones(len(target)))
    return tuple(float(value) for value in found / scale)
