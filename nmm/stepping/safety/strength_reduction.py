"""The factor of safety of a scene, by strength reduction (Zienkiewicz et al. 1975).

Each factor is a run of its own from the unloaded scene, as Griffiths and Lane (1999) do it: it
holds where the run finds equilibrium under all loads. Once one holds the static theorem says of
blocks which factors cannot, in a few linear programmes; the next run is one just below these.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from math import atan, tan
from time import perf_counter
from typing import TYPE_CHECKING, Any

from nmm.errors import NmmError
from nmm.progress import Progress
from nmm.results.safety import Safety
from nmm.results.sink import MemorySink
from nmm.stepping.bounds.safety_bound import FINE, safety_bound
from nmm.stepping.bounds.static_theorem import CarriedLoad
from nmm.stepping.drive.verdict import COLLAPSED, CONVERGED
from nmm.stepping.prepare import prepare
from nmm.stepping.safety.tried_factors import TriedFactors
from nmm.stepping.simulation import Simulation

if TYPE_CHECKING:
    from nmm.assembly.state import State
    from nmm.formulation import Formulation
    from nmm.scene.model import Scene
    from nmm.scene.tables.strength_reduction import StrengthReductionTable
    from nmm.stepping.step.stepper import Stepper

Bound = Callable[[float, float], float | None]
"""From the highest factor and the width of the bracket to one that fails; None is none shown."""

FRICTION = ("friction_angle", "residual_friction_angle")
# While no bracket is known factors go up and down by this.
STRIDE = 2.0


@dataclass(frozen=True)
class FactorTried:
    """A run with strengths over a factor: its status, and its verdict in words.

    A factor that the static theorem shows to fail, without a run, has no verdict.
    ``bound`` seeks a factor that fails from where the run ended (`safety_bound`).
    """

    factor: float
    status: str
    sentence: str
    bound: Bound = lambda highest, width: None

    @property
    def holds(self) -> bool:
        """Whether it found equilibrium."""
        return self.status == CONVERGED


@dataclass
class _Factors:
    """Runs of a scene over factors, one after the other.

    Attributes
    ----------
    at_once
        Whether all loads are there from the start of each.
    tried
        What was found of each.
    """

    scene: "Scene"
    formulation: "Formulation"
    progress: Progress
    known: TriedFactors
    at_once: bool
    tried: list[FactorTried] = field(default_factory=list)
    _stands: dict[float, "tuple[Stepper, State]"] = field(default_factory=dict)

    def run(self, factor: float) -> FactorTried:
        """Try a factor."""
        self._stands.clear()
        answer = self.known.tried(factor, self._solved)
        found = FactorTried(factor, *answer, partial(self._bound, factor))
        self.tried.append(found)
        says = "equilibrium" if found.holds else "none"
        self.progress(min(len(self.tried) / 12, 1.0), f"strength / {factor:.5g}: {says}")
        return found

    def _solved(self, factor: float) -> tuple[str, str]:
        made = self._prepared(factor)
        memory = MemorySink()
        state = replace(made, at_once=self.at_once).run([memory], lambda share, text: None)
        self._stands[factor] = made.stepper, state
        return memory.summary.status, memory.summary.sentence

    def _prepared(self, factor: float) -> Simulation:
        try:
            return prepare(_unstored(weakened(self.scene, factor)), self.formulation)
        except NmmError as fault:
            if factor == 1.0:
                raise
            # Its numbers are none of the file: without the factor nobody finds them there.
            raise NmmError(
                f"strength_reduction: strengths over {factor:.6g} are refused, their numbers "
                f"divided: {fault}; or keep such factors out by [strength_reduction] lowest and "
                "highest"
            ) from fault

    def _bound(self, factor: float, highest: float, width: float) -> float | None:
        """See `FactorTried.bound`."""

        def sought() -> float | None:
            if factor not in self._stands:
                self._solved(factor)
            return safety_bound(*self._stands[factor], factor, highest, width)

        return self.known.bounded(sought)


def reduced(
    scene: "Scene", formulation: "Formulation", progress: Progress, known: TriedFactors
) -> Simulation:
    """Return the simulation of a scene at its factor of safety, which is sought first.

    What is ``known`` of factors is not tried again.

    Raises
    ------
    NmmError
        When the scene cannot be run at all.
    """
    table, begun = scene.strength_reduction, perf_counter()
    assert table is not None
    factors = _Factors(scene, formulation, progress, known, at_once=not _grows(scene))
    low, high = bracket(factors.run, table)
    shown = high is None or high.status == COLLAPSED
    last = factors.tried[-1].factor if low is None else low.factor
    at = prepare(weakened(scene, last), formulation)
    proven = CarriedLoad(None, 1.0, members=bool(at.stepper.plan.having("resistance")))
    safety = Safety(
        None if low is None else low.factor,
        None if high is None else high.factor,
        shown,
        "" if high is None else high.sentence or proven.sentence,
        len(factors.tried),
        min((one for one in known.bounds if one is not None), default=None),
    )
    at.stepper.seconds["strength reduction"] = (
        perf_counter() - begun - sum(at.stepper.seconds.values())
    )
    return replace(at, scene=scene, begun=begun, safety=safety, at_once=factors.at_once)


def _unstored(scene: "Scene") -> "Scene":
    """Return a scene whose run stores nothing to go on from."""
    output = scene.output
    if output is None or output.checkpoint is None:
        return scene
    return scene.model_copy(update={"output": output.model_copy(update={"checkpoint": None})})


def bracket(
    run: Callable[[float], FactorTried], table: "StrengthReductionTable"
) -> tuple[FactorTried | None, FactorTried | None]:
    """Return the largest factor that holds and the smallest that fails; None where there is none.

    From 1 factors are halved within the bounds until one holds. Where the static theorem then shows
    one that fails, the next is that less the tolerance; else factors are doubled until one fails.
    What bracket is left is halved to its tolerance.
    """
    first = run(min(max(1.0, table.lowest), table.highest))
    low, high = (first, None) if first.holds else (None, first)
    while low is None and high is not None and high.factor > table.lowest:
        low, high = _sorted(run(max(high.factor / STRIDE, table.lowest)), low, high)
    if low is not None:
        most = table.highest if high is None else high.factor
        fails = low.bound(most, table.tolerance)
        if fails is not None:
            high = FactorTried(fails, COLLAPSED, "")
            below = fails - (1 - FINE) * table.tolerance
            if below > low.factor:
                low, high = _sorted(run(below), low, high)
    while high is None and low is not None and low.factor < table.highest:
        low, high = _sorted(run(min(STRIDE * low.factor, table.highest)), low, high)
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
    over = (
        *("cohesion", "tensile_strength", "yield_stress"),
        *("softening_energy", "residual_stress", "residual_cohesion"),
    )
    found = {name: given[name] / factor for name in over if name in given}
    for name in FRICTION:
        if name in given:
            found[name] = atan(tan(given[name]) / factor)
    friction = [found[name] for name in FRICTION if name in found]
    swells = [name for name in ("dilation_angle", "residual_dilation_angle") if name in given]
    # A dilation that falls stays below the friction of its end, one that stays below both.
    limits = friction if len(swells) == len(friction) else [min(friction, default=0.0)] * 2
    found |= {name: min(given[name], most) for name, most in zip(swells, limits, strict=False)}
    return part.model_copy(update=found)


def _sorted(
    found: FactorTried, low: FactorTried | None, high: FactorTried | None
) -> tuple[FactorTried | None, FactorTried | None]:
    return (found, high) if found.holds else (low, found)


def _grows(scene: "Scene") -> bool:
    """Whether anything but weight acts, which the load factor brings on bit by bit."""
    moved = any(any(one.displacement) or one.field is not None for one in scene.supports)
    return bool(scene.loads or scene.water_pressures) or moved
