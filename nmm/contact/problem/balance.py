"""How far a step is out of balance, in a norm that mixes no units, and what rounding leaves."""

import numpy as np

from integration.arrays import Floats
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.row_products import pushed, terms_of_stretches
from nmm.contact.problem.step_problem import StepProblem
from nmm.solvers.norm import norm
from nmm.solvers.unchecked import magnitudes

# Sums of some ten products each are rounded some ten times.
ROUNDINGS = 16.0
# Loads that are left of forces that cancel are sums over elements and points of some hundred terms.
LOADS = 256.0
# A balance that rounding leaves worse than this is none: the springs are too stiff to be told apart
# from what they join.
WORST = 1e-3


def relative_residual(
    problem: StepProblem, weight: Floats, increment: Floats, normal: Floats, shear: Floats
) -> float:
    """Out-of-balance force over the largest of load, internal and contact force.

    What is less than `StepProblem.least` counts as that.
    """
    inner = problem.matrix @ increment
    contact = problem.normal_rows.T @ normal + problem.tangent_rows.T @ shear
    size = max(norm(weight * part) for part in (inner, contact, problem.force))
    size = max(size, problem.least(weight))
    rest = norm(weight * (inner + contact - problem.force))
    return rest / size if size > 0 else 0.0


def rounding(springs: CutSprings, increment: Floats) -> float:
    """Relative out-of-balance force by rounding of forces and stretches; at most `WORST`.

    A gap ``g + N d`` is known to the last digit of its largest term, whatever it comes to. Times
    a stiffness 1e10 times that of what moves, that digit is a millionth of the load. So is a force
    ``K d`` of a body that moves as a whole on anchors of 1e-8 of its own stiffness, and a load that
    is left of forces which cancel: where functions depend on one another nothing balances it.
    """
    problem, grain = springs.problem, ROUNDINGS * float(np.finfo(float).eps)
    forces = springs.forces(increment)
    lost = np.where(forces != 0, grain * springs.stiffness * _terms(problem, increment), 0.0)
    left = grain * (magnitudes(problem.matrix) @ np.abs(increment))
    if problem.among is not None:
        left += LOADS / ROUNDINGS * grain * problem.among
    left += sum(magnitudes(part).T @ one for part, one in zip(problem.rows, lost, strict=True))
    held = problem.pushed(*forces)
    inner = problem.matrix @ increment
    whole = max(norm(springs.weight * part) for part in (inner, held, problem.force))
    whole = max(whole, problem.least(springs.weight))
    return min(norm(springs.weight * left) / whole, WORST) if whole > 0 else 0.0


def cancelling(springs: CutSprings, increment: Floats) -> Floats:
    """(n,) sizes of the forces (N) of which the out-of-balance force of an increment is the rest.

    Where functions depend on one another their rounding does work on what moves nothing: a rest
    that is a small part of them tells no free motion (`nmm.solvers.accuracy.known.known_load`).
    """
    problem = springs.problem
    sizes = springs.stiffness * _terms(problem, increment)
    held = np.where(springs.forces(increment) != 0, sizes, 0.0)
    load = np.abs(problem.force) if problem.among is None else problem.among
    inner = magnitudes(problem.matrix) @ np.abs(increment)
    normal, tangent = map(magnitudes, problem.rows)
    return np.asarray(load + inner + pushed(normal, tangent, *held))


def _terms(problem: StepProblem, increment: Floats) -> Floats:
    """(2, m) sizes of the terms of which gaps and slips are the sums (m)."""
    starts = np.abs((problem.gap, problem.slip))
    return np.asarray(starts + terms_of_stretches(*problem.rows, increment))
