"""The equations of a scalar field: ``M dT/dt + K T = f(t)``, with prescribed fields.

Steps in time are by the theta method,

    (M + theta dt K) T1 = M T0 + dt ((1 - theta) (f0 - K T0) + theta f1),

stable for any step if theta >= 1/2 (Crank and Nicolson 1947 for 1/2). What the field takes up in a
step is ``dt`` times the weighted mean of what edges and sources give at both ends; it equals what
is stored, since the constant field is a test function.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.sparse import csc_array

from covers.approximation.manifold import Manifold
from covers.scalar.space import ScalarSpace
from integration.arrays import Bools, Floats
from nmm.assembly.kept import forget_kept, kept_of_object
from nmm.diffusion.edges import Edge, Factor
from nmm.diffusion.given import GivenField, VolumeSource
from nmm.effects.loading.load_factor import steadily
from nmm.formulation import Solver
from nmm.solvers.linear import Factor as Decomposed
from nmm.solvers.linear import LinearSolver, make_solver

# Number of systems that are kept, for steps of different lengths.
KEPT = 3
# Net flow, as a share of the exchanged flow, that is rounding.
ROUNDED = 4 * float(np.finfo(float).eps)


def step_between(begin: float, end: float) -> float:
    """Return the length of a step, rounded so that equal steps have equal lengths."""
    return float(f"{end - begin:.12g}")


def field_solver(manifold: Manifold, asked: Solver) -> LinearSolver:
    """Return the linear solver that a formulation names, for functions that may be dependent."""
    made = make_solver(asked.type, asked.options)
    return made.deflated() if manifold.dependent and not made.shift else made


@dataclass(frozen=True)
class DiffusionProblem:
    """The equations of a field.

    Attributes
    ----------
    space
        Its functions.
    conduction, capacity
        (n, n) ``K`` without edges, and ``M``; None where nothing is stored.
    edges, sources, given
        Conditions on edges and joints, in the volume, and fields of whole bodies.
    solver
        Of linear systems.
    """

    space: ScalarSpace
    conduction: csc_array
    capacity: csc_array | None
    edges: Sequence[Edge]
    sources: Sequence[VolumeSource]
    given: Sequence[GivenField]
    solver: LinearSolver
    _systems: dict[float, tuple[csc_array, Decomposed | None]] = field(
        default_factory=dict, repr=False
    )

    @cached_property
    def matrix(self) -> csc_array:
        """``K`` (n, n) with the edges' terms."""
        return csc_array(sum((one.matrix for one in self.edges), start=self.conduction))

    @cached_property
    def free(self) -> Bools:
        """(n,) functions that are not prescribed."""
        found = np.ones(self.space.n, dtype=bool)
        for one in self.given:  # a handful
            found &= ~one.chosen
        return found

    def load(self, time: float) -> Floats:
        """``f`` (n,)."""
        total = np.zeros(self.space.n)
        for edge in self.edges:  # a handful
            total += edge.factor(time) * edge.load
        for source in self.sources:  # a handful
            total += source.factor(time) * source.load
        return total

    def prescribed(self, time: float) -> Floats:
        """Unknowns (n,) of prescribed fields, zero elsewhere; later ones overwrite earlier ones."""
        total = np.zeros(self.space.n)
        for one in self.given:  # a handful
            total[one.chosen] = one.factor(time) * one.unknowns[one.chosen]
        return total

    @cached_property
    def _given_field(self) -> Floats:
        """(n,) the field where all of it is given for good: the same array at all times."""
        return self.prescribed(0.0)

    def changes(self, begin: float, end: float) -> bool:
        """Whether any source or condition differs between two times."""
        return any(factor(begin) != factor(end) for factor in self._varying)

    @property
    def still(self) -> bool:
        """Whether all sources and conditions are constant in time."""
        return all(factor is steadily for factor in self._varying)

    @property
    def _varying(self) -> list[Factor]:
        """Factors of all sources and conditions."""
        return [
            *(edge.factor for edge in self.edges),
            *(source.factor for source in self.sources),
            *(body.factor for body in self.given),
        ]

    def rests(self, unknowns: Floats) -> bool:
        """Whether a field (n,) is stationary: no load, and flows are rounding."""
        return self.still and self._flows_nowhere(unknowns)

    @kept_of_object
    def _flows_nowhere(self, unknowns: Floats) -> bool:
        """Whether a field (n,) without loads is uniform; small loads would add up."""
        free = self.free
        if self.load(0.0).any() or not np.array_equal(unknowns[~free], self.prescribed(0.0)[~free]):
            return False
        flows, all_ways = self.matrix @ unknowns, abs(self.matrix) @ np.abs(unknowns)
        return bool(np.all(np.abs(flows)[free] <= ROUNDED * all_ways[free]))

    def steady(self, time: float) -> Floats:
        """Unknowns (n,) of the steady field."""
        return self._solved(0.0, self.load(time), time)

    def stepped(
        self, before: Floats, begin: float, end: float, theta: float, room: Floats | None = None
    ) -> Floats:
        """Unknowns (n,) after a step; prescribed fields jump to their values at the end.

        ``before`` (n,) are those at its beginning; ``room`` (n,) is filled in the step besides.
        """
        assert self.capacity is not None
        if not self.free.any():
            return self._given_field if self.still else self.prescribed(end)
        step = step_between(begin, end)
        force = self.capacity @ before + step * theta * self.load(end)
        if theta < 1:
            force += step * (1 - theta) * (self.load(begin) - self.matrix @ before)
        if room is not None:
            force = force - room
        return self._solved(theta * step, force, end)

    def relief(self, step: float, room: csc_array) -> Floats:
        """Unknowns (n, k) by which the field falls as columns of ``room`` (n, k) are filled.

        In a step of theta = 1 and its length (s).
        """
        free, found = self.free, np.zeros(room.shape)
        _, factor = self._system(step)
        assert factor is not None
        columns = [factor.solve(one) for one in room.toarray()[free].T]  # one right side a solve
        found[free] = np.transpose(columns)
        return found

    def taken(self, unknowns: Floats, time: float) -> Mapping[str, float]:
        """What the bodies that are not given take up in a unit of time, by what gives it.

        Edges and sources of one name are summed; joints count for what given bodies give.
        """
        found: dict[str, float] = {}
        for one in self.edges:  # a handful
            rate = one.factor(time) * one.load - one.matrix @ unknowns
            found[one.name] = found.get(one.name, 0.0) + float(self._test @ rate)
        for source in self.sources:  # a handful
            rate = source.factor(time) * source.load
            found[source.name] = found.get(source.name, 0.0) + float(self._test @ rate)
        return found

    def exchanged(self, time: float) -> float:
        """Size of what edges give in a unit of time, and take again where nothing flows."""
        given = (np.abs(one.factor(time) * one.load) for one in self.edges)
        return float(sum((np.abs(self._test) @ one for one in given), start=0.0))

    @kept_of_object
    def stored(self, unknowns: Floats) -> float:
        """What these bodies hold beyond a field of zero."""
        return 0.0 if self.capacity is None else self.total(self.capacity @ unknowns)

    def total(self, weighed: Floats) -> float:
        """Sum over these bodies of what is weighed (n,) by the functions."""
        return float(self._test @ weighed)

    @cached_property
    def _test(self) -> Floats:
        """(n,) the field that is one in bodies that are not given."""
        return np.where(self.free, self.space.one, 0.0)

    def forget(self) -> None:
        """Drop matrices and decompositions."""
        self._systems.clear()
        forget_kept(self)

    def _solved(self, step: float, force: Floats, time: float) -> Floats:
        """Solve for what is free in the system of a step (s), see `_system`."""
        matrix, factor = self._system(step)
        found = self.prescribed(time)
        if factor is None:
            return found
        free, force = self.free, force - matrix @ found
        found[free] = factor.solve(force[free])
        return found

    def _system(self, step: float) -> tuple[csc_array, Decomposed | None]:
        """Return ``M + step K``, ``K`` for a step of 0, and its factor for what is free.

        The factor is None where nothing is free.
        """
        known = self._systems.get(step)
        if known is None:
            if len(self._systems) > KEPT:
                self._systems.clear()
            known = self._systems[step] = self._made(step)
        return known

    def _made(self, step: float) -> tuple[csc_array, Decomposed | None]:
        matrix, free = self.matrix, self.free
        if step:
            assert self.capacity is not None
            matrix = csc_array(self.capacity + step * matrix)
        if not free.any():
            return matrix, None
        own = matrix if free.all() else csc_array(matrix[free][:, free])
        return matrix, self.solver.factorise(own)
