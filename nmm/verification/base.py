"""What a benchmark problem is: a scene with answers from elsewhere, and how they are read off."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Literal, Self

if TYPE_CHECKING:
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
    """

    computed: float
    reference: float
    tolerance: float
    reason: str
    scale: float | None = None
    bound: Literal["equal", "at_most", "at_least"] = "equal"

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


class Case(ABC):
    """Base of benchmark problems; an instance is one variant with its parameters.

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
    """

    name: ClassVar[str]
    title: ClassVar[str]
    source: ClassVar[str]
    formulations: ClassVar[tuple[str, ...]] = ("dda",)

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return the variants that `verify` runs."""
        return [cls()]

    @property
    def variant(self) -> str:
        """What tells this variant from the others; empty when there is one."""
        return ""

    @property
    def slow(self) -> bool:
        """Whether this variant takes more than a few seconds."""
        return False

    @abstractmethod
    def checks(self, formulation: str) -> Checks:
        """Compute all quantities under a formulation called ``formulation``."""


class SceneCase(Case):
    """Benchmark that is the run of one scene."""

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
        from nmm.verification.formulations import chosen

        return chosen(name, scene.formulation)
