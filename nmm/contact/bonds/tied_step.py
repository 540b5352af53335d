"""Whole bonds in the problem of a step: terms of its matrix instead of contacts.

With the rows ``S`` of average tractions and ``B`` of gaps and slips, areas ``A`` and ``H``, the
penalty times areas on the jumps that it counts (`nmm.contact.bonds.turning`), the forces of bonds
and the energy that they are the slopes of are

    f = A S q + H g,    E = g^T A S q + g^T H g / 2,

so that a step adds ``B^T A S + S^T A B + B^T H B`` to its matrix. The forces act as the
contacts' do; the other half, ``S^T A g``, strains the bodies and moves none.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.sparse import csc_array, csr_array, vstack
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.contact.bonds.consistent_bonds import ConsistentBonds
from nmm.contact.bonds.turning import counting
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.problem.step_problem import BONDED, StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform


@dataclass(frozen=True)
class Direction:
    """Whole bonds (k,) in one direction, normal or tangential, at the start of a step.

    Attributes
    ----------
    gap
        (k,) jump (m).
    pull
        (k,) average traction times area (N).
    gaps, pulls
        (k, n) rows of both.
    penalty
        (k, k) penalty times area on the jumps that it counts (N/m), symmetric.
    """

    gap: Floats
    pull: Floats
    gaps: csr_array
    pulls: csr_array
    penalty: csr_array

    @property
    def answers(self) -> csr_array:
        """Rows (k, n) of the forces that work on the gaps, by half of those of the penalty."""
        return csr_array(self.pulls + (self.penalty / 2) @ self.gaps)

    @property
    def push(self) -> Floats:
        """Forces on the unknowns (n,) at the start, with the sign changed."""
        force = self.pull + self.penalty @ self.gap
        return np.asarray(self.gaps.T @ force + self.pulls.T @ self.gap)

    def force(self, increment: Floats) -> Floats:
        """Return the forces (k,) in N after an increment (n,)."""
        pull, gap = self.pull + self.pulls @ increment, self.gap + self.gaps @ increment
        return np.asarray(pull + self.penalty @ gap)

    @property
    def energy(self) -> Floats:
        """The energies (k,) at the start (J); they may be negative."""
        return np.asarray(self.gap * (self.pull + self.penalty @ self.gap / 2))


@dataclass(frozen=True)
class TiedBonds(Transform):
    """Contacts that are whole bonds, taken out of a problem.

    Attributes
    ----------
    index
        (k,) the contacts, rising.
    normal, tangent
        The two directions.
    weight
        Weight of the end of the step in the forces.
    """

    index: Ints
    normal: Direction
    tangent: Direction
    weight: float

    @classmethod
    def of(
        cls,
        bonds: ConsistentBonds,
        contacts: ContactPoints,
        state: State,
        rows: ContactRows,
        weight: float,
        stresses: Sequence[StressAt],
        time: float | None,
    ) -> "TiedBonds":
        """Take the whole bonds of the contacts of a step that starts at ``state``.

        ``stresses`` are added by effects, see `ConsistentBonds.averages`.
        """
        index = np.flatnonzero(contacts.tied)
        tied = contacts.take(index)
        averages = bonds.averages(tied, state, stresses, time)
        at, jumps, gaps = bonds.row(tied), (tied.gap, tied.slip), (rows.normal, rows.tangent)
        penalty = counting(tied, bonds.area[at] * bonds.penalty[at])
        normal, tangent = (
            Direction(jump, pull, gap[index], pulls, penalty)
            for jump, (pull, pulls), gap in zip(jumps, averages, gaps, strict=True)
        )
        return cls(index, normal, tangent, weight)

    @cached_property
    def matrix(self) -> csc_array:
        """The matrix (n, n) of all terms: one product, as the other half is its transpose."""
        both = self.normal, self.tangent
        gaps = vstack([one.gaps for one in both], format="csr")
        half = csc_array(gaps.T @ vstack([one.answers for one in both], format="csr"))
        return csc_array(half + half.T)

    @cached_property
    def energy(self) -> float:
        """Energy (J) at the start of the step."""
        return float(sum(one.energy.sum() for one in (self.normal, self.tangent)))

    @cached_property
    def push(self) -> Floats:
        """Forces on the unknowns (n,) at the start, with the sign changed."""
        return np.asarray(sum(one.push for one in (self.normal, self.tangent)))

    def forces(self, increment: Floats) -> tuple[Floats, Floats]:
        """Return pull and shear (k,) in N after an increment (n,)."""
        mean = self.weight * increment
        return self.normal.force(mean), self.tangent.force(mean)

    def apply(self, problem: StepProblem) -> StepProblem:
        others = self._others(problem)
        return replace(
            problem,
            matrix=csc_array(problem.matrix + self.weight * self.matrix),
            force=problem.force - self.push,
            among=None if problem.among is None else problem.among + np.abs(self.push),
            normal_rows=csr_array(problem.normal_rows[others]),
            tangent_rows=csr_array(problem.tangent_rows[others]),
            **problem.columns_of(others),
        )

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        others = self._others(problem)
        gap, slip = problem.jumps(answer.increment)
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
