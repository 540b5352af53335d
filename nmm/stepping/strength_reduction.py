"""The factor of safety of a scene, by strength reduction (Zienkiewicz et al. 1975).

Each factor is a run of its own from the unloaded scene, as Griffiths and Lane (1999) do it: it
holds where the run finds equilibrium under all loads.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import atan, tan
from time import perf_counter
from typing import TYPE_CHECKING, Any

from nmm.results.sink import MemorySink
from nmm.results.summary import Safety
from nmm.stepping.drive.verdict import COLLAPSED, CONVERGED
from nmm.stepping.simulation import Progress, Simulation, prepare

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.results.summary import Summary
    from nmm.scene.model import Scene
    from nmm.scene.tables.strength_reduction import StrengthReductionTable

# While no bracket is known factors go up and down by this.
STRIDE = 2.0


@dataclass(frozen=True)
class FactorTried:
    """A run with strengths over a factor: its status, and its verdict in words."""

    factor: float
    status: str
    sentence: str

    @property
    def holds(self) -> bool:
        """Whether it found equilibrium."""
        return self.status == CONVERGED


def reduced(scene: "Scene", formulation: "Formulation", progress: Progress) -> Simulation:
    """Return the simulation of a scene at its factor of safety, which is sought first.

    Raises
    ------
    NmmError
        When the scene cannot be run at all.
    """
    table = scene.strength_reduction
    assert table is not None
    begun, tried = perf_counter(), list[FactorTried]()
    quick = formulation if _grows(scene) else _at_once(formulation)

    def run(factor: float) -> FactorTried:
        found = _run(weakened(scene, factor), quick)
        tried.append(FactorTried(factor, found.status, found.sentence))
        says = "equilibrium" if tried[-1].holds else "none"
        progress(min(len(tried) / 12, 1.0), f"strength / {factor:.5g}: {says}")
        return tried[-1]

    low, high = bracket(run, table)
    shown = high is None or high.status == COLLAPSED
    safety = Safety(
        None if low is None else low.factor,
        None if high is None else high.factor,
        shown,
        "" if high is None else high.sentence,
        len(tried),
    )
    at = prepare(weakened(scene, tried[-1].factor if low is None else low.factor), formulation)
    at.stepper.seconds["strength reduction"] = (
        perf_counter() - begun - sum(at.stepper.seconds.values())
    )
    return replace(at, scene=scene, begun=begun, safety=safety)


def bracket(
    run: Callable[[float], FactorTried], table: "StrengthReductionTable"
) -> tuple[FactorTried | None, FactorTried | None]:
    """Return the largest factor that holds and the smallest that fails; None where there is none.

    From 1 factors are doubled or halved within the bounds until one of each is known; then the
    bracket is halved to its tolerance.
    """
    first = run(min(max(1.0, table.lowest), table.highest))
    low, high = (first, None) if first.holds else (None, first)
    while high is None and low is not None and low.factor < table.highest:
        low, high = _sorted(run(min(STRIDE * low.factor, table.highest)), low, high)
    while low is None and high is not None and high.factor > table.lowest:
        low, high = _sorted(run(max(high.factor / STRIDE, table.lowest)), low, high)
    while low is not None and high is not None and high.factor - low.factor > table.tolerance:
        low, high = _sorted(run((low.factor + high.factor) / 2), low, high)
    return low, high


def weakened(scene: "Scene", factor: float) -> "Scene":
    """Return a scene whose strengths are divided by a factor.

    Tangents of friction angles are, not the angles. Dilation stays as it is up to the friction.
    """
    tables = {
        key: {name: _weaker(one, factor) for name, one in getattr(scene, key).items()}
        for key in ("materials", "interfaces")
    }
    return scene.model_copy(update=tables)


def _weaker(part: Any, factor: float) -> Any:
    """Return a material or an interface with its strengths divided."""
    given: dict[str, float] = {
        name: getattr(part, name)
        for name in type(part).model_fields
        if isinstance(getattr(part, name), float)
    }
    over = ("cohesion", "tensile_strength", "yield_stress")
    found = {name: given[name] / factor for name in over if name in given}
    for name in ("friction_angle", "residual_friction_angle"):
        if name in given:
            found[name] = atan(tan(given[name]) / factor)
    if "dilation_angle" in given:
        least = found.get("friction_angle", given["dilation_angle"])
        found["dilation_angle"] = min(given["dilation_angle"], least)
    return part.model_copy(update=found)


def _sorted(
    found: FactorTried, low: FactorTried | None, high: FactorTried | None
) -> tuple[FactorTried | None, FactorTried | None]:
    return (found, high) if found.holds else (low, found)


def _grows(scene: "Scene") -> bool:
    """Whether anything but weight acts, which the load factor brings on bit by bit."""
    moved = any(any(one.displacement) or one.field is not None for one in scene.supports)
    return bool(scene.loads or scene.water_pressures) or moved


def _at_once(formulation: "Formulation") -> "Formulation":
    """Return a formulation that tries no smaller increments, which have the same weight."""
    loading = formulation.loading.model_copy(update={"tolerance": 1.0})
    return formulation.model_copy(update={"loading": loading})


def _run(scene: "Scene", formulation: "Formulation") -> "Summary":
    memory = MemorySink()
    prepare(scene, formulation).run([memory], lambda share, text: None)
    return memory.summary
