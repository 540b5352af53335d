"""An iterate of a step: its increment, with the internal forces there and their tangents."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.solvers.unchecked import product
from nmm.stepping.step.linear.equations import Equations, Linearisation
from nmm.stepping.step.trial import Attempt

Solution = tuple[Equations, Attempt]
Solve = Callable[[Linearisation | None, Attempt | None], Solution]
"""From linearised internal forces, and what the last iteration found, to a solution."""


@dataclass(frozen=True)
class InternalForcePart:
    """Internal force (n,) of one kind at an iterate, and what makes its tangent (n, n)."""

    force: Floats
    make: Callable[[], csc_array]

    @cached_property
    def stiffness(self) -> csc_array:
        """Tangent (n, n)."""
        return self.make()

    def missed(self, now: "InternalForcePart", way: Floats) -> Floats:
        """What the tangent of another iterate, ``way`` (n,) from here, missed of the force (n,)."""
        return self.force - now.force - product(now.stiffness, way)


@dataclass(frozen=True)
class EffectPart(InternalForcePart):
    """The same of effects, beyond their line at the start of the step.

    Attributes
    ----------
    pull
        (n,) force of effects through the step.
    rounding
        (n,) what of it rounding of places makes.
    """

    pull: Floats
    rounding: Floats


@dataclass(frozen=True)
class Iterate:
    """An increment (n,) of the step with its internal forces.

    Attributes
    ----------
    matter, effects
        Their parts.
    history, memory
        What matter and effects remember at the end of the step.
    """

    increment: Floats
    matter: InternalForcePart
    effects: EffectPart
    history: Mapping[str, Floats]
    memory: Mapping[str, Floats]

    @property
    def force(self) -> Floats:
        """(n,) of both."""
        return self.matter.force + self.effects.force

    def with_tangent_of(self, other: "Iterate") -> "Iterate":
        """Return the iterate with the tangent that effects have at another one."""
        known = other.effects
        return replace(self, effects=replace(self.effects, make=lambda: known.stiffness))


def size(force: Floats) -> float:
    """Return the norm of forces (n,)."""
    return float(np.linalg.norm(force))
