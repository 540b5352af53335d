"""How interface conditions are imposed: one small base class, and a registry of methods.

The same methods serve supports, glue and the joints of sub-blocks; one of a user's own does so too,
as ``module:Name``.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.sparse import csr_array
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.constraints.interface import Interface, Triplets
from nmm.effects.base import Instant
from nmm.formulation import GHOST
from nmm.registry import Registry

if TYPE_CHECKING:
    from collections.abc import Callable

    from nmm.assembly.tractions.held_edges import HeldEdge
    from nmm.constraints.nitsche.volume_lift import PressureLift


@dataclass
class MultiplierValues:
    """What a step found for multipliers, which interfaces may share.

    Attributes
    ----------
    size
        Number k of multipliers.
    values, before
        (k,) Pa, and as they were when the step began; None before any solution.
    """

    size: int
    values: Floats | None = None
    before: Floats | None = None


@dataclass(frozen=True)
class Imposition(ABC):
    """An interface and the method that imposes its conditions.

    Attributes
    ----------
    interface
        Where. ``jump`` (m, 2) below is by how far its first side is from where it should be.
    """

    interface: Interface

    words: ClassVar[str] = "a method of one's own"
    """What it is, in words."""
    needs_cells: ClassVar[bool] = False
    """Whether it holds supports only where a mesh says the size of its cells."""
    reads: ClassVar[frozenset[str] | None] = None
    """Keys of ``[supports]`` and ``[glue]`` beside its name that it has a use of; None is all."""
    reads_stress: ClassVar[bool] = False
    """Whether its tractions are those of the elements beside it."""

    @classmethod
    @abstractmethod
    def of(cls, model: Model, interface: Interface, method: "Method") -> Self:
        """Impose the method on an interface."""

    @classmethod
    def of_all(
        cls, model: Model, interfaces: Sequence[Interface], method: "Method"
    ) -> "list[Imposition]":
        """Impose the method on interfaces that may know of one another."""
        return [cls.of(model, interface, method) for interface in interfaces]

    @abstractmethod
    def matrix(self, state: State) -> Triplets:
        """Symmetric matrix (n, n), added to the stiffness."""

    @abstractmethod
    def force(self, state: State, jump: Floats) -> Floats:
        """Force (n,) on the unknowns: minus the slope of `energy`."""

    @abstractmethod
    def point_forces(self, state: State, jump: Floats) -> Floats:
        """Forces (m, 2) in N on the first side, against the second."""

    def earlier_forces(self, state: State, jump: Floats) -> Floats:
        """Return the same of the state in which a step began."""
        return self.point_forces(state, jump)

    def added(self, state: State, stresses: Sequence[StressAt], time: float) -> Floats:
        """Forces (m, 2) in N on the first side of stresses that other effects add."""
        return np.zeros((len(self.interface), 2))

    def energy(self, state: State, jump: Floats) -> float:
        """Energy stored (J), less `laid_energy`."""
        return 0.0

    def laid_energy(self, state: State, jump: Floats) -> float:
        """Energy (J) of forces with which it was laid, a line in the jump."""
        return 0.0

    def gap_volume(self, state: State, jump: Floats, k: int) -> Floats:
        """Volumes (k,) left open, for a model's k pressures (m2)."""
        return np.zeros(k)

    def held_edge(self, state: State, jump: Floats) -> "HeldEdge | None":
        """Return what `added` tractions work on; None where there are none."""
        return None

    @property
    def free(self) -> Bools:
        """(m,) points at which it can impose nothing."""
        return np.zeros(len(self.interface), dtype=bool)

    @property
    def turns(self) -> bool:
        """Whether the matrix changes when bodies turn."""
        return True

    @property
    def bends(self) -> bool:
        """Whether its forces are not linear in the unknowns though no body turns."""
        return False

    @property
    def oriented(self) -> bool:
        """Whether its directions are those of one of two bodies."""
        return False

    @property
    def springs(self) -> Floats | None:
        """Springs (m,) or (m, 2, 2) at the points in N/m, which `laid` stretches; None without."""
        return None

    @property
    def stretch(self) -> Floats | float:
        """(m, 2) by how far these are stretched as they are laid (m)."""
        return 0.0

    def laid(self, stretch: Floats) -> "Imposition":
        """Return it with springs laid with a ``stretch`` (m, 2) in m."""
        return self

    @property
    def lift(self) -> "PressureLift | None":
        """Pressures beside a support, which others may share; None without any."""
        return None

    def with_lift(self, lift: "PressureLift") -> "Imposition":
        """Return it with the pressures that others leave to it."""
        return self

    @property
    def tied_unknowns(self) -> Ints:
        """Unknowns that it ties to those of neighbouring elements."""
        return np.empty(0, dtype=np.int64)

    @property
    def shared(self) -> MultiplierValues | None:
        """Multipliers; impositions with the same object share them. None without any."""
        return None

    def conditions(self, state: State, jump: Floats) -> tuple[csr_array, Floats]:
        """Rows (k, n) and right-hand sides of the conditions that its multipliers hold."""
        raise NotImplementedError


IMPOSITIONS: Registry[type[Imposition]] = Registry(
    "imposition",
    Imposition,
    {
        "penalty": "nmm.constraints.springs:Springs",
        "spring": "nmm.constraints.springs:Springs",
        "nitsche": "nmm.constraints.nitsche.nitsche:Nitsche",
        "lagrange": "nmm.constraints.multipliers:Multipliers",
    },
)


@dataclass(frozen=True)
class Method:
    """The method by which interface conditions are imposed.

    Attributes
    ----------
    kind
        A name of the registry, or ``module:Name``.
    size
        Size of the mesh's cells (m); None for blocks.
    degree
        Degree of the local functions.
    stiffness
        Of springs: in Young's moduli over the size of a cell, or between bodies over the longest
        edge that elements share; None is the default.
    gamma, ghost
        Nitsche's penalty and ghost term; None is the default of the degree, or more where an
        estimate of the largest traction over energy asks for it.
    """

    kind: str
    size: float | None
    degree: int
    stiffness: float | None = None
    gamma: float | None = None
    ghost: float = GHOST

    def order(self, model: Model) -> int:
        """Degree of polynomials to integrate along edges."""
        return max(2 * (self.degree + 2), 2 * model.manifold.degree)

    def impose(self, model: Model, interfaces: Sequence[Interface]) -> list[Imposition]:
        """Impose the method on interfaces, which share multipliers where they can."""
        kind = IMPOSITIONS.load(self.kind)
        return kind.of_all(model, interfaces, self)

    def hold(
        self,
        model: Model,
        place: Place,
        displacement: "Callable[[Instant], Floats]",
        held: tuple[bool, bool] = (True, True),
    ) -> Imposition:
        """Hold points against the ground; ``displacement`` may differ from point to point."""
        area = place.weight * model.thickness
        interface = Interface(place, None, area, "edge", np.array(held), displacement)
        return self.impose(model, [interface])[0]
