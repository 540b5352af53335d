"""The contact problem of a step along a path: set up, solved, reported like any other step's."""

from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Self

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Bools, Floats
from nmm.assembly.state import State
from nmm.contact.bonds.tied_step import TiedBonds
from nmm.contact.following.by_parts import follow
from nmm.contact.following.losing import losing
from nmm.contact.following.path_problem import Bent, PathProblem, PathStep
from nmm.contact.following.unstable_ways import unstable_ways
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.laws.losses import ContactLosses, softening
from nmm.contact.laws.tractions import ContactForces, contact_forces
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.problem.step_problem import BONDED, OPEN, SLIDE, STICK, StepAnswer, Verdict
from nmm.contact.solution.mixed_bonds import MixedBonds
from nmm.contact.solution.record import ContactSolution
from nmm.contact.solution.request import StepRequest
from nmm.contact.solution.steps import ContactSteps
from nmm.controls.path_equation import PathEquation
from nmm.solvers.linear import LinearSolver

# Elastic slips that differ by less than this share of the largest are the same: nothing slid.
STILL = 1e-12


@dataclass(frozen=True)
class PosedPath:
    """Contact of the steps from one state, whatever path they follow.

    Attributes
    ----------
    laws, problem
        Of its contacts.
    contacts, rows
        All of them, with jumps as their springs feel them.
    free
        Which (m,) are springs, and not tied.
    tied, mixed
        Whole bonds of consistent terms, and those of the mixed form; None without any.
    found
        The contacts with the jumps themselves.
    """

    laws: ContactLaws
    problem: PathProblem
    contacts: ContactPoints
    rows: ContactRows
    free: Bools
    tied: TiedBonds | None
    mixed: MixedBonds | None
    found: ContactPoints

    @classmethod
    def of(
        cls,
        steps: ContactSteps,
        contacts: ContactPoints,
        state: State,
        request: StepRequest,
        joints: ContactPoints,
        bent: Bent | None = None,
    ) -> Self:
        """Pose them.

        Parameters
        ----------
        steps
            What steps are put together from.
        contacts, state
            All contacts of a step, and where it starts.
        request
            Matrix and force of all but contacts.
        joints
            All of the scene as they stand: until one softens limits are judged by others.
        bent
            What else bends within a step; None if nothing does.
        """
        rows, bonds = steps.geometry.rows(contacts, state), steps.bonds
        tied = bonds.tied(contacts, state, rows, request.weight, request.time)
        mixed, posed = bonds.posed(contacts, rows, request, state)
        free = np.ones(len(contacts), dtype=bool)
        if tied is not None:
            free[tied.index] = False
        problem = _problem(steps.laws, *posed, free, tied, bonds.unsoftened(contacts, joints))
        problem = replace(problem, bent=bent)
        return cls(steps.laws, problem, *posed[:2], free, tied, mixed, contacts)

    def solved(self, path: PathEquation, solver: LinearSolver) -> tuple[ContactSolution, float]:
        """Solve a step along a path; return it, and by how much its load factor changes.

        Raises
        ------
        SolveError
            Where nothing holds a part.
        """
        contacts, free = self.contacts, self.free
        step = follow(self.problem, path, solver)
        answer = _answer(contacts, self.rows, step, free, self.tied)
        history = {name: column.copy() for name, column in contacts.history.items()}
        for name, column in step.contacts.history.items():
            history[name][free] = column
        after = replace(contacts, history=history)
        sliding = history["plastic_slip"] - contacts.history["plastic_slip"]
        lost = self._lost(after, answer, sliding)
        ways = None
        if path.target and step.converged:
            ways = partial(unstable_ways, self.problem, step, solver)
        told = {"ways": ways, "sliding": sliding, "rows": self.rows, "between": lost.beyond_means()}
        solved = ContactSolution(after, answer, step.iterations, lost.energy(static=True), **told)
        if self.mixed is not None:
            solved = self.mixed.told(solved, self.found)
        return solved, step.change

    @cached_property
    def losing(self) -> Floats:
        """Energy (n,) by unknown (J) that bonds lose as they open and slide further."""
        some, springs = self.contacts.take(self.free), self.laws.springs(self.contacts)
        stiff = springs[0][self.free], springs[1][self.free]
        return losing(self.problem, stiff, some.history)

    def _lost(self, after: ContactPoints, answer: StepAnswer, sliding: Floats) -> ContactLosses:
        """Return what contacts went through in a step that ends with the history of ``after``."""
        laws, start = self.laws, self.contacts
        stiffness = laws.normal_stiffness(start)
        before, end = laws.response(start, stiffness), laws.response(after, stiffness)
        soft = softening(laws, start, before.limits)
        return ContactLosses(laws, start, after, (before, end), soft, answer, sliding)


def _problem(
    laws: ContactLaws,
    contacts: ContactPoints,
    rows: ContactRows,
    request: StepRequest,
    free: Bools,
    tied: TiedBonds | None,
    whole: Bools | None,
) -> PathProblem:
    """Pose balance with ``free`` springs (m,) and ``whole`` bonds (m,), none of which softens."""
    some, springs = contacts.take(free), laws.springs(contacts)
    stiff = (springs[0][free], springs[1][free], springs[2][free])
    elastic = some.bonded & laws.brittle[some.interface]
    elastic = elastic if whole is None else elastic | whole[free]

    def law(gap: Floats, slip: Floats) -> ContactForces:
        return contact_forces(laws, some, gap, slip, stiff, elastic)

    matrix, force = request.matrix, request.force
    scale = float(np.linalg.norm(force))
    if tied is not None:
        matrix, push = csc_array(matrix + tied.matrix), tied.push
        force, scale = force - push, max(scale, float(np.linalg.norm(push)))
    through = ContactRows(rows.normal[free], rows.tangent[free], rows.direction[free])
    stiffest = float(np.concatenate(stiff[:2]).max(initial=0.0))
    rounding = float(np.finfo(float).eps) * stiffest * float(some.length.sum())
    given = matrix, force, through, some.gap, some.slip, law, scale, rounding
    return PathProblem(*given, stiffest=stiffest)


def _answer(
    contacts: ContactPoints,
    rows: ContactRows,
    step: PathStep,
    free: Bools,
    tied: TiedBonds | None,
) -> StepAnswer:
    """Return the solution as that of a step's problem."""
    increment, m = step.increment, len(contacts)
    force = np.zeros((m, 2))
    force[free] = step.contacts.force
    gap = contacts.gap + rows.normal @ increment
    slip = contacts.slip + rows.tangent @ increment
    slid = step.contacts.history["plastic_slip"] - contacts.history["plastic_slip"][free]
    slip[free] -= slid
    if tied is not None:
        force[tied.index] = np.stack(tied.forces(increment), axis=1)
    touching = (force != 0).any(axis=1)
    sliding = np.zeros(m, dtype=bool)
    sliding[free] = np.abs(slid) > STILL * np.abs(slip).max(initial=0.0)
    state = np.where(touching, np.where(sliding, SLIDE, STICK), OPEN)
    slip = np.where(touching | contacts.bonded, slip, 0.0)
    bonded = contacts.bonded.copy()
    bonded[free] = step.contacts.history["bonded"]
    why = "settled" if step.converged else step.lacking
    return StepAnswer(
        increment=increment,
        normal_force=force[:, 0],
        shear_force=force[:, 1],
        gap=gap,
        slip=slip,
        state=np.where(bonded, int(BONDED), state),
        passes=step.iterations,
        residual=step.residual,
        verdict=Verdict(
            step.converged,
            "converged" if step.converged else "stalled",
            f"{why} after {step.iterations} iterations along the path",
        ),
    )
