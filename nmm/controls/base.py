"""Controls of a path: what grows step by step, while the load factor follows."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.material_points import MaterialPoints
from nmm.assembly.state import State
from nmm.controls.path_equation import PathEquation
from nmm.registry import Registry

if TYPE_CHECKING:
    from nmm.scene.tables.loading.control import ControlTable


@dataclass(frozen=True)
class PathState:
    """Where a path stands.

    Attributes
    ----------
    state
        The last state in equilibrium.
    load
        (n,) force of a load factor of one there (N).
    dead
        (n,) force of what no factor scales: weight, stress without strain (N).
    monitors
        Points of the scene, by name.
    way
        (n,) displacements of the unknowns since the start of the run, rigid motions included.
    losing
        Computes the energy (n,) by unknown (J) that bonds at their limit lose as they open and
        slide further.
    """

    state: State
    load: Floats
    dead: Floats
    monitors: Mapping[str, MaterialPoints]
    way: Floats
    losing: Callable[[], Floats]


@dataclass(frozen=True)
class Control(ABC):
    """Base of controls.

    A control is linear in what a step changes: `row` times the increment of the unknowns and
    `share` times that of the load factor is how far the step goes (`PathEquation`).

    Attributes
    ----------
    increment
        Largest change of what is controlled in a step.
    end
        Total change at which to stop; infinite without.
    """

    increment: float
    end: float = np.inf

    by_load: ClassVar[bool] = False
    """Whether the load factor itself is sought, at which the next bond is at its limit."""
    from_limit: ClassVar[bool] = False
    """Whether a path begins where a first bond is at its limit: without one it has no step."""
    of_energy: ClassVar[bool] = False
    """Whether it is energy that bonds lose: a step that unloads and takes none is no answer."""

    def idle(self, events: int, softened: bool) -> bool:
        """Whether nothing is controlled yet: the load is then what grows, up to the next event.

        ``events`` is their number so far, ``softened`` whether any was of bonds that soften.
        """
        return False

    @classmethod
    @abstractmethod
    def of(cls, table: "ControlTable") -> Self:
        """Make it from ``[loading.control]`` of a scene."""

    @abstractmethod
    def row(self, at: PathState) -> Floats:
        """(n,) change of what is controlled by that of the unknowns."""

    def share(self, at: PathState) -> float:
        """Change of what is controlled by that of the load factor."""
        return 0.0

    def path(self, at: PathState, target: float) -> PathEquation:
        """Return the equation of a step that goes so far."""
        return PathEquation(at.load, self.row(at), self.share(at), target)

    def standstill(self, at: PathState) -> PathEquation:
        """Return the equation of a balance that is found anew, as after bonds broke, right here."""
        return self.path(at, 0.0)

    def correction(self, at: PathState, step: Floats) -> PathEquation:
        """Return the equation of a correction that ends a ``step`` (n,) and takes it no further."""
        return self.standstill(at)


CONTROLS: Registry[type[Control]] = Registry(
    "control",
    Control,
    {
        "displacement": "nmm.controls.displacement:Displacement",
        "opening": "nmm.controls.displacement:Opening",
        "dissipation": "nmm.controls.dissipation:Dissipation",
        "events": "nmm.controls.events:NextEvent",
    },
)
