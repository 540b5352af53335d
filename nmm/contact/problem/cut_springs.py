"""Contact forces as springs that a law cuts off: the equations every iterative solver works on."""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.problem.coulomb import project, states, tangent
from nmm.contact.problem.residual_kernel import SpringColumns, residual
from nmm.contact.problem.row_products import compressed
from nmm.contact.problem.step_problem import StepProblem
from nmm.frozen import MadeOnce


@dataclass(frozen=True)
class CutSprings:
    """Forces ``project(shift + stiffness * (gap, slip))`` of a problem.

    With zero shift and the problem's stiffnesses this is the penalty (or the joint's own law);
    with the multipliers of the last round as shift it is one round of the augmented Lagrangian.

    Attributes
    ----------
    problem
        The step.
    stiffness
        (2, m) of normal and shear springs (N/m).
    shift
        (2, m) of their forces (N).
    """

    problem: StepProblem
    stiffness: Floats
    shift: Floats

    @classmethod
    def of(cls, problem: StepProblem) -> "CutSprings":
        """Springs with the problem's own stiffnesses."""
        return cls(problem, problem.stiffness, np.zeros_like(problem.stiffness))

    def shifted(self, shift: Floats) -> "CutSprings":
        """Springs with other shifts (2, m)."""
        return replace(self, shift=shift)

    @MadeOnce
    def weight(self) -> Floats:
        """(n,) weights of out-of-balance forces."""
        problem, stiffness = self.problem, self.stiffness
        own = stiffness is problem.stiffness
        return problem.weight if own else problem.weight_with(stiffness)

    def trial(self, increment: Floats) -> tuple[Floats, Floats]:
        """Normal and shear forces (m,) of uncut springs (N)."""
        normal, shear = self.stiffness * self.problem.jumps(increment) + self.shift
        return normal, shear

    def forces(self, increment: Floats) -> Floats:
        """(2, m) admissible forces (N)."""
        return np.array(self.cut(*self.trial(increment)))

    def states(self, increment: Floats) -> tuple[Bools, Bools]:
        """(m,) open contacts, (m,) closed contacts that slide."""
        is_open, sliding, _ = states(*self.trial(increment), self.problem.limits)
        return is_open, sliding

    def cut(self, normal: Floats, shear: Floats) -> tuple[Floats, Floats]:
        """Admissible forces of those of uncut springs."""
        return project(normal, shear, self.problem.limits)

    def tangent(self, increment: Floats) -> tuple[Floats, Floats, Floats]:
        """(m,) normal, shear and mixed stiffness (N/m) of the cut springs."""
        acts, held, mixed = tangent(*self.trial(increment), self.problem.limits)
        normal, shear = self.stiffness
        return acts * normal, held * shear, mixed * normal

    def residual(self, increment: Floats) -> "Residual":
        """Out-of-balance force of ``increment``."""
        force, size = residual(increment, self.columns)
        return Residual(force, float(size))

    @MadeOnce
    def columns(self) -> SpringColumns:
        """The same as compiled code takes them."""
        p = self.problem
        return SpringColumns(
            p.force,
            self.weight,
            compressed(p.matrix),
            *p.compressed_rows,
            *(p.gap, p.slip, self.stiffness, self.shift),
            *(p.limits.tension, p.limits.cohesion, p.limits.friction),
            p.least(self.weight),
            p.paired,
        )


@dataclass(frozen=True)
class Residual:
    """Out-of-balance force (n,) and its relative size."""

    force: Floats
    size: float


@dataclass(frozen=True)
class IterationResult:
    """Where an iterative solver ended.

    Attributes
    ----------
    springs
        The springs whose forces belong to the increment.
    increment
        (n,) best unknowns.
    size
        Relative out-of-balance force there.
    solves
        Linear solves.
    factorisations
        Matrices factorised.
    story
        How, in words.
    error
        What exact contacts lack, where they were sought: the largest gap, slip or force that
        should not be, over the largest force and what it would press into the contact alone.
    """

    springs: CutSprings
    increment: Floats
    size: float
    solves: int
    factorisations: int
    story: str
    error: float = 0.0

    def then(self, after: "IterationResult") -> "IterationResult":
        """The better of this and what was found ``after``, with the cost of both."""
        better, other = (after, self) if after.size < self.size else (self, after)
        return replace(better.at_cost_of(other), story=f"{self.story}, then {after.story}")

    def cost(self, factor: float) -> float:
        """Solves that it took, a factorisation counted as ``factor`` of them."""
        return self.solves + factor * self.factorisations

    def at_cost_of(self, other: "IterationResult") -> "IterationResult":
        """The same with the cost of another iteration besides."""
        return replace(
            self,
            solves=self.solves + other.solves,
            factorisations=self.factorisations + other.factorisations,
        )
