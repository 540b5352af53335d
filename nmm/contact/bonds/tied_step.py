"""Whole bonds in the problem of a step: terms of its matrix instead of contacts.

With the rows ``S`` of average tractions and ``B`` of gaps and slips, areas ``A`` and the penalty
``gamma``, the forces of bonds and the energy that they are the slopes of are

    f = A (S q + gamma g),    E = g^T A S q + gamma g^T A g / 2,

so that a step adds ``B^T A S + S^T A B + gamma B^T A B`` to its matrix. The forces act as the
contacts' do; the other half, ``S^T A g``, strains the bodies and moves none.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.motion import State
from nmm.assembly.stress_points import StressAt
from nmm.contact.bonds.consistent_bonds import ConsistentBonds
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.midpoint import ContactRows
from nmm.contact.problem.step_problem import BONDED, Limits, StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform

# What a problem has of each contact beside its rows and limits.
COLUMNS = (
    "gap",
    "slip",
    "normal_stiffness",
    "shear_stiffness",
    "state",
    "normal_force",
    "shear_force",
)


@dataclass(frozen=True)
class Direction:
    """Whole bonds (k,) in one direction, normal or tangential, at the start of a step.

    Attributes
    ----------
    gap
        (k,) jump (m).
    stress
        (k,) average traction (Pa).
    gaps, stresses
        (k, n) rows of both.
    """

    gap: Floats
    stress: Floats
    gaps: csr_array
    stresses: csr_array

    def matrix(self, area: Floats, penalty: Floats) -> csc_array:
        """Return the matrix (n, n) of the terms."""
        across = self.gaps.T @ (diags_array(area) @ self.stresses)
        own = self.gaps.T @ (diags_array(area * penalty) @ self.gaps)
        return csc_array(across + across.T + own)

    def push(self, area: Floats, penalty: Floats) -> Floats:
        """Return what the forces at the start are on the unknowns (n,), with the sign changed."""
        force = area * (self.stress + penalty * self.gap)
        return np.asarray(self.gaps.T @ force + self.stresses.T @ (area * self.gap))

    def force(self, area: Floats, penalty: Floats, increment: Floats) -> Floats:
        """Return the forces (k,) in N after an increment (n,)."""
        stress = self.stress + self.stresses @ increment
        return np.asarray(area * (stress + penalty * (self.gap + self.gaps @ increment)))

    def energy(self, area: Floats, penalty: Floats) -> Floats:
        """Return the energies (k,) at the start (J); they may be negative."""
        return np.asarray(area * self.gap * (self.stress + penalty * self.gap / 2))


@dataclass(frozen=True)
class TiedBonds(Transform):
    """Contacts that are whole bonds, taken out of a problem.

    Attributes
    ----------
    index
        (k,) the contacts, rising.
    normal, tangent
        The two directions.
    area, penalty
        (k,) in m2 and Pa/m.
    weight
        Share of the end of the step in what forces hang on.
    """

    index: Ints
    normal: Direction
    tangent: Direction
    area: Floats
    penalty: Floats
    weight: float = 1.0

    @classmethod
    def of(
        cls,
        bonds: ConsistentBonds,
        contacts: ContactPoints,
        state: State,
        rows: ContactRows,
        weight: float = 1.0,
        stresses: Sequence[StressAt] = (),
        time: float | None = None,
    ) -> "TiedBonds":
        """Take the whole bonds of the contacts of a step that starts at ``state``.

        ``stresses`` are added by effects, as they are at ``time`` (s), that of the state if None.
        """
        index = np.flatnonzero(contacts.tied)
        tied = contacts.take(index)
        pull, shear = bonds.stress_rows(tied, state.frames)
        q, at = state.deformation, bonds.row(tied)
        more = bonds.added(tied, state.frames, stresses, state.time if time is None else time)
        normal, tangent = (
            Direction(gap, stress @ q + known, csr_array(gaps[index]), stress)
            for gap, stress, known, gaps in (
                (tied.gap, pull, more[0], rows.normal),
                (tied.slip, shear, more[1], rows.tangent),
            )
        )
        return cls(index, normal, tangent, bonds.area[at], bonds.penalty[at], weight)

    @cached_property
    def matrix(self) -> csc_array:
        """The matrix (n, n) of all terms."""
        area, penalty = self.area, self.penalty
        return csc_array(self.normal.matrix(area, penalty) + self.tangent.matrix(area, penalty))

    @cached_property
    def energy(self) -> float:
        """Energy (J) at the start of the step."""
        both = (self.normal, self.tangent)
        return float(sum(one.energy(self.area, self.penalty).sum() for one in both))

    @cached_property
    def push(self) -> Floats:
        """What the forces at the start are on the unknowns (n,), with the sign changed."""
        both = (self.normal, self.tangent)
        return np.asarray(sum(one.push(self.area, self.penalty) for one in both))

    def forces(self, increment: Floats) -> tuple[Floats, Floats]:
        """Return pull and shear (k,) in N after an increment (n,)."""
        mean = self.weight * increment
        normal, shear = (
            one.force(self.area, self.penalty, mean) for one in (self.normal, self.tangent)
        )
        return normal, shear

    def apply(self, problem: StepProblem) -> StepProblem:
        """See `Transform.apply`."""
        others = self._others(problem)
        return replace(
            problem,
            matrix=csc_array(problem.matrix + self.weight * self.matrix),
            force=problem.force - self.push,
            normal_rows=csr_array(problem.normal_rows[others]),
            tangent_rows=csr_array(problem.tangent_rows[others]),
            limits=Limits(*(column[others] for column in vars(problem.limits).values())),
            compliant=problem.own_stiffness[others],
            **{name: getattr(problem, name)[others] for name in COLUMNS},
        )

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        """See `Transform.undo`."""
        others = self._others(problem)
        gap, slip = problem.gaps(answer.increment), problem.slips(answer.increment)
        normal, shear = self.forces(answer.increment)
        return replace(
            answer,
            normal_force=self._joined(others, answer.normal_force, normal),
            shear_force=self._joined(others, answer.shear_force, shear),
            gap=self._joined(others, answer.gap, gap[self.index]),
            slip=self._joined(others, answer.slip, slip[self.index]),
            state=self._joined(others, answer.state, np.full(len(self.index), int(BONDED))),
        )

    def _others(self, problem: StepProblem) -> Bools:
        others = np.ones(problem.n_contacts, dtype=bool)
        others[self.index] = False
        return others

    def _joined(self, others: Bools, rest: Any, own: Any) -> Any:
        """Values (m,) of all contacts from those of the others and of these."""
        found = np.empty(len(others), dtype=rest.dtype)
        found[others], found[self.index] = rest, own
        return found
