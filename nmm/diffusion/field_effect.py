"""The effect of a scalar field in a run: what temperature and water head have in common.

A field acts on displacements and is not acted upon: places and openings are those of the reference
place.
"""

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from scipy.sparse import csr_array

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats, Ints
from nmm.assembly.kept import forget_kept, kept_of_object
from nmm.assembly.state import State
from nmm.diffusion.carried_field import carried_field
from nmm.diffusion.course import FieldAt, FieldCourse
from nmm.diffusion.field_stress import FieldStress
from nmm.diffusion.matrices import element_slopes
from nmm.diffusion.problem import DiffusionProblem
from nmm.effects.base import Effect, Instant, Setup, Span, StepForce
from nmm.formulation import Diffusion

if TYPE_CHECKING:
    from nmm.effects.change import Change


BLOCKS = "blocks"
"""What is taken up, or given away where below zero, with blocks that come and go."""


class StressThatTurns(Protocol):
    """The stress of a field in bodies that bend by any angle: it follows the material."""

    def force(self, state: State, end: Instant) -> Floats:
        """See `Effect.force`."""

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.step_force`."""

    def mean(self, state: State) -> Floats:
        """See `Effect.mean_stress`."""


class FieldEffect(Effect):
    """A field and its stress; ``_turned`` is that of bodies that bend by any angle.

    Parameters
    ----------
    course
        The field over time.
    stress
        What it does to the blocks; None where it does nothing.
    conductivity
        (E, 2, 2) flux for each unit of slope, in the axes of bodies.
    second
        Seconds of the field in a unit of the run's time: statics counts its time by the load
        factor.
    """

    external = False
    _turned: StressThatTurns | None = None

    def __init__(
        self,
        course: FieldCourse,
        stress: FieldStress | None,
        conductivity: Floats,
        second: float = 1.0,
    ) -> None:
        self.course, self.stress = course, stress
        self._conductivity, self._second = conductivity, second

    @property
    def space(self) -> ScalarSpace:
        """Functions of the field."""
        return self.course.problem.space

    @property
    def about(self) -> str:
        how = "steady" if self.course.steady else "transient"
        return f"{how}, {self.space.n} unknowns"

    @property
    def turns_with_bodies(self) -> str:
        return "" if self.stress is None else "its stress"

    @property
    def steady(self) -> bool:
        return self.course.steady and self.course.problem.still

    def here(self, time: float) -> FieldAt:
        """Return the field at a time of the run."""
        return self.course.at(time * self._second)

    def acting(self, time: float) -> Floats:
        """Unknowns (n,) that cause stress, at a time of the run: by default the field itself."""
        return self.here(time).unknowns

    @property
    def nonlinear(self) -> bool:
        """See `Effect.nonlinear`: it does in bodies that bend by any angle."""
        return self._turned is not None

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        assert self._turned is not None
        return self._turned.step_force(before, after, span)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force of the field's stress at the end of the step."""
        self._begin(state, end)
        if self._turned is not None:
            return self._turned.force(state, end)
        unknowns = self.acting(end.time)
        if self.stress is None:
            return np.zeros(len(state.deformation))
        return self.stress.force(unknowns)

    def _begin(self, state: State, end: Instant) -> None:
        """Begin a step from a state."""
        if end.time > state.time:
            self.course.begin(state.time * self._second)

    def stress_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        if self.stress is None:
            return np.zeros((len(elements), 3))
        return self.stress.at(self.acting(time), elements, points)

    def mean_stress(self, state: State) -> Floats:
        if self._turned is not None:
            return self._turned.mean(state)
        if self.stress is None:
            return np.zeros((len(self._conductivity), 3))
        return self.stress.mean(self.acting(state.time))

    def mean_stress_across(self, state: State) -> Floats:
        """See `Effect.mean_stress_across`; in finite strain over areas as they are."""
        if self.stress is None:
            return np.zeros(len(self._conductivity))
        found = self.stress.mean_across(self.acting(state.time))
        if self._turned is None:
            return found
        return found / self.stress.model.finite_matter.mean_volume(state.deformation)

    def stress_across_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        if self.stress is None:
            return np.zeros(len(elements))
        return self.stress.across_at(self.acting(time), elements, points)

    def flux(self, state: State) -> Floats:
        """Mean flux (E, 2) of the elements in global axes."""
        own = self._own_flux(self.here(state.time).unknowns)
        return state.frames.to_global(self.space.manifold.element_body, own)

    @kept_of_object
    def _own_flux(self, field: Floats) -> Floats:
        """Mean flux (E, 2) of the elements in the axes of their bodies."""
        slopes = np.stack([rows @ field for rows in self._slopes], axis=1)
        return np.asarray(-np.einsum("eij,ej->ei", self._conductivity, slopes))

    @cached_property
    def _slopes(self) -> tuple[csr_array, csr_array]:
        """Rows (E, n) of the mean slopes of elements along x and y."""
        return element_slopes(self.space)

    def amounts(self, state: State) -> Mapping[str, float]:
        """Return the amounts taken up and stored since the start; rates for a steady field."""
        here = self.here(state.time)
        found = {f"taken:{name}": amount for name, amount in here.taken.items()}
        return found if self.course.steady else {**found, "stored": here.stored}

    def imbalance(self, state: State) -> float:
        return self.here(state.time).imbalance

    def carried(self) -> Any:
        return self.course.carried()

    def carry(self, carried: Any) -> None:
        self.course.carry(carried)

    def forget(self) -> None:
        self.course.problem.forget()
        forget_kept(self)
        if self.stress is not None:
            self.stress.forget()

    def follow(self, change: "Change") -> "FieldEffect":
        """Return the field on the new model; new blocks have the initial field."""
        new = type(self).from_setup(change.setup)
        if new.course.steady:
            return new
        here, start = self.here(change.state.time), new.here(change.state.time)
        spaces = self.space, new.space
        unknowns = carried_field(change.parentage, spaces, here.unknowns, start.unknowns)
        went, taken = self._with_blocks(change, new, unknowns, start.unknowns), here.taken
        if went:
            taken = {**taken, BLOCKS: taken.get(BLOCKS, 0.0) + went}
        new.course.go_on_from(FieldAt(here.time, unknowns, taken, here.stored + went))
        return new

    def _with_blocks(
        self, change: "Change", new: "FieldEffect", field: Floats, start: Floats
    ) -> float:
        """Return what came, or went, with blocks beyond what they hold at the start."""
        before, after = (one.manifold.element_region for one in (change.old, change.new))
        if np.array_equal(np.unique(before), np.unique(after)):
            return 0.0
        stored, stores = self.course.problem.stored, new.course.problem.stored
        begun = type(self).from_setup(change.before).here(change.before.start.time)
        had = stored(self.here(change.state.time).unknowns) - stored(begun.unknowns)
        return stores(field) - stores(start) - had


def course_of(
    setup: Setup, problem: DiffusionProblem, initial: Floats | None, second: float
) -> FieldCourse:
    """Return the course of a field from its start (n,); None where it is steady."""
    asked, start = setup.formulation.diffusion or Diffusion(), None
    if initial is not None:
        time = setup.start.time * second
        unknowns = np.where(problem.free, initial, problem.prescribed(time))
        start = FieldAt(time, unknowns, {})
    return FieldCourse(problem, start, asked.theta, asked.step)
