"""How far a step is out of balance, in a norm that mixes no units."""

import numpy as np

from integration.arrays import Floats
from nmm.contact.problem.step_problem import StepProblem


def relative_residual(
    problem: StepProblem, weight: Floats, increment: Floats, normal: Floats, shear: Floats
) -> float:
    """Out-of-balance force over the largest of load, internal and contact force.

    What is less than `StepProblem.least` counts as that.
    """
    inner = problem.matrix @ increment
    contact = problem.normal_rows.T @ normal + problem.tangent_rows.T @ shear
    size = max(length(weight * part) for part in (inner, contact, problem.force))
    size = max(size, problem.least(weight))
    rest = length(weight * (inner + contact - problem.force))
    return rest / size if size > 0 else 0.0


def length(vector: Floats) -> float:
    """Euclidean norm, without the threads that BLAS starts for long vectors."""
    return float(np.sqrt(np.einsum("i,i->", vector, vector)))
