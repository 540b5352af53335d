"""What a benchmark problem is: a scene with answers from elsewhere, and how they are read off."""

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Self

from nmm.verification.series import Series

if TYPE_CHECKING:
    from pathlib import Path

    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class Check:
    """One quantity of a benchmark beside its reference.

    Attributes
    ----------
    computed, reference
        In SI units.
    tolerance
        Largest error, relative to ``scale``.
    reason
        Where the tolerance comes from.
    scale
        What the error is divided by; the reference when None, or 1 where that is zero.
    bound
        "equal"; "at_most" and "at_least" make the reference a limit.
    series
        Of an order of convergence, the errors it was read off.
    """

    computed: float
    reference: float
    tolerance: float
    reason: str
    scale: float | None = None
    bound: Literal["equal", "at_most", "at_least"] = "equal"
    series: Series | None = None

    @property
    def error(self) -> float:
        """Distance from the reference over the scale; 0 on the right side of a limit."""
        off = self.computed - self.reference
        if self.bound == "equal":
            off = abs(off)
        elif self.bound == "at_least":
            off = -off
        return (max(off, 0.0) if off == off else off) / (self.scale or abs(self.reference) or 1.0)

    @property
    def passed(self) -> bool:
        """Whether the error is within the tolerance; what is not a number is not."""
        return self.error <= self.tolerance

    @property
    def shown(self) -> str:
        """What was computed in digits; an order with its confidence."""
        return f"{self.computed:.7g}" if self.series is None else str(self.series.observed)

    @property
    def wanted(self) -> str:
        """The reference in digits, with its relation to what was computed."""
        sign = {"equal": "", "at_most": "≤ ", "at_least": "≥ "}[self.bound]
        return f"{sign}{self.reference:.7g}"

    @property
    def missed_by(self) -> tuple[str, str]:
        """Error and tolerance in digits; empty for a limit without a tolerance."""
        if self.bound != "equal" and not self.tolerance:
            return "", ""
        return f"{self.error:.1e}", f"{self.tolerance:.1e}"

    @property
    def share(self) -> float:
        """Error over tolerance; of a limit, the value over it; 0 or inf where that says nothing."""
        if self.error != self.error:
            return float("inf")
        if self.bound == "at_most" and self.reference > 0 and not self.tolerance:
            return max(self.computed / self.reference, 0.0)
        if self.tolerance:
            return self.error / self.tolerance
        return 0.0 if self.passed else float("inf")


Checks = dict[str, Check]

MESHES = ("finite elements", "manifold")
"""Formulations whose covers are triangles of half a metre."""

EXACT = ("augmented", "lagrange", "cone")
"""Formulations whose contacts do not give way."""


def limit(computed: float, reference: float, reason: str) -> Check:
    """Return the check that ``computed`` is at most ``reference``."""
    return Check(computed, reference, 0.0, reason, bound="at_most")


def holds(truth: bool, reason: str) -> Check:
    """Return the check of a statement."""
    return Check(float(truth), 1.0, 0.0, reason)


def order(series: Series, tolerance: float, reason: str, at_least: bool = False) -> Check:
    """Return the check that errors fall by the order of theory, within ``tolerance``."""
    found = series.observed.value
    bound: Literal["equal", "at_least"] = "at_least" if at_least else "equal"
    return Check(found, series.theory, tolerance, reason, 1.0, bound, series)


class Case(ABC):
    """Base of benchmark problems; an instance is one variant with its parameters.

    A case with parameters is a frozen dataclass: they are its annotated attributes, and attributes
    without an annotation are the same in all variants.

    Attributes
    ----------
    name
        Name of the benchmark, such as "B2".
    title
        What it shows, in words.
    source
        Where the reference comes from.
    formulations
        Names, in `nmm.verification.formulations`, of those it applies to.
    parameters
        Values of parameters by name; their combinations are the variants.
    label
        What tells one variant from another, as a format of the case: ``"phi {0.friction:g}"``.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    source: ClassVar[str]
    formulations: ClassVar[tuple[str, ...]] = ("dda",)
    parameters: ClassVar[Mapping[str, Collection[Any]]] = {}
    label: ClassVar[str] = ""

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return the variants that `verify` runs."""
        combinations = product(*cls.parameters.values())
        return [cls(**dict(zip(cls.parameters, values, strict=True))) for values in combinations]

    @property
    def variant(self) -> str:
        """What tells this variant from the others; empty when there is one."""
        return self.label.format(self)

    @property
    def slow(self) -> bool:
        """Whether this variant takes more than a few seconds."""
        return False

    @abstractmethod
    def checks(self, formulation: str) -> Checks:
        """Compute all quantities under a formulation called ``formulation``."""

    def sketch(self, path: "Path") -> bool:
        """Draw the problem into a file; False where there is nothing to draw."""
        return False


class SceneCase(Case):
    """Benchmark that is the run of one scene.

    Attributes
    ----------
    cover
        Values in ``[formulation.cover]`` under every formulation, such as the size.
    """

    cover: ClassVar[Mapping[str, Any]] = {}

    @abstractmethod
    def scene(self) -> str:
        """Return the scene as text; its ``[formulation]`` holds what the problem asks for."""

    @abstractmethod
    def measure(self, run: "Run") -> Checks:
        """Read the quantities off a run."""

    def checks(self, formulation: str) -> Checks:
        """Run and measure."""
        return self.measure(self.run(formulation))

    def run(self, formulation: str = "dda") -> "Run":
        """Run the scene under a formulation."""
        from nmm.stepping.run import run

        scene = self.parsed()
        return run(scene, self.formulation(scene, formulation))

    def parsed(self) -> "Scene":
        """Return the scene."""
        from nmm.scene import parse_scene

        return parse_scene(self.scene(), f"benchmark {self.name} {self.variant}".rstrip())

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return the scene's own formulation with the choices called ``name``."""
        from nmm.verification.formulations import chosen, with_cover

        return with_cover(chosen(name, scene.formulation), **self.cover)

    def sketch(self, path: "Path") -> bool:
        """Draw blocks, supports and loads of the scene."""
        from nmm.verification.sketches import sketch_scene

        sketch_scene(self.parsed(), path)
        return True
