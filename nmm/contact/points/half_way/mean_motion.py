"""What contact rows have of the mean motion of whole bodies, beyond the unknowns near a point.

The rows of bodies that turn within a step, ``N + G P``, name the mean motion ``P d`` of both, and
through it all of their unknowns. What is sparse, ``N``, is left in the problem of a step; the rest
is taken at what the last solution of the step says, ``G P d`` as a gap and its forces
``P^T G^T f`` as a load, and the step is solved again. Both are of the order of the turn: so much
smaller is what is missing after each solution.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from integration.sparse import csr_array
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform
from nmm.frozen import MadeOnce, with_parts

Pair = tuple[csr_array, csr_array]
"""Along normals and tangents."""
Forces = tuple[Floats, Floats]
"""Normal and shear forces (m,) in N."""


@dataclass(frozen=True)
class MeanMotion(Transform):
    """Mean motions of bodies in contact rows, known from the last solution of a step.

    Attributes
    ----------
    rows
        (m, 3 B) how gaps and slips change with them, ``G``.
    moments
        (m, B) moments about the bodies' centres of normal and shear forces (m).
    projection
        (3 B, n) mean motions of the bodies by the unknowns, ``P``.
    motion
        (3 B,) in the last solution (m, rad).
    forces
        Those of the last solution.
    """

    rows: Pair
    moments: Pair
    projection: csr_array
    motion: Floats
    forces: Forces

    def apply(self, problem: StepProblem) -> StepProblem:
        (gap, slip), push = self.opened, self.push(*self.forces)
        return with_parts(
            problem,
            gap=problem.gap + gap,
            slip=problem.slip + slip,
            force=problem.force - push,
            among=None if problem.among is None else problem.among + np.abs(push),
        )

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        """See `Transform.undo`: gaps and slips are those at the end of the step."""
        return answer

    @MadeOnce
    def opened(self) -> tuple[Floats, Floats]:
        """By how much (m,) gaps and slips grow with the mean motions (m)."""
        gap, slip = (rows @ self.motion for rows in self.rows)
        return gap, slip

    def push(self, normal: Floats, shear: Floats) -> Floats:
        """Return what forces (m,) do on the unknowns (n,) through the mean motions."""
        return np.asarray(self.projection.T @ _felt(self.rows, (normal, shear)))

    def missed(self, answer: StepAnswer) -> float:
        """Return the work (J) in a solution of what its forces are beyond those before it."""
        found = answer.normal_force, answer.shear_force
        more = [now - before for now, before in zip(found, self.forces, strict=True)]
        return abs(float(self.push(more[0], more[1]) @ answer.increment))

    def acting(self, normal: Floats, shear: Floats) -> Floats:
        """Return the moments (B,) of forces (m,) about the bodies' centres (N m)."""
        return _felt(self.moments, (normal, shear))


def _felt(rows: Pair, forces: Forces) -> Floats:
    return np.asarray(rows[0].T @ forces[0] + rows[1].T @ forces[1])
