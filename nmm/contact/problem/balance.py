"""How far a step is out of balance, in a norm that mixes no units."""

import numpy as np
from scipy.sparse import csc_array, diags_array

from integration.arrays import Floats
from nmm.contact.problem.step_problem import StepProblem


def weights(
    problem: StepProblem, normal: Floats | None = None, shear: Floats | None = None
) -> Floats:
    """(n,) inverse roots of the diagonal of matrix plus all contact springs.

    Forces on translations, rotations and strains become comparable: ``|weights * r|`` is
    invariant under a change of the units of single unknowns. ``normal`` and ``shear`` (m,) stand
    in for the problem's stiffnesses.
    """
    own = problem.normal_stiffness, problem.shear_stiffness
    normal, shear = own[0] if normal is None else normal, own[1] if shear is None else shear
    kept = normal is own[0] and shear is own[1]
    return problem.weight if kept else problem.weight_with(normal, shear)


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


def with_springs(problem: StepProblem, normal: Floats, shear: Floats) -> csc_array:
    """``matrix + Gn^T diag(normal) Gn + Gt^T diag(shear) Gt`` by sparse products."""
    total = problem.matrix
    for rows, stiffness in ((problem.normal_rows, normal), (problem.tangent_rows, shear)):
        total = total + rows.T @ (diags_array(stiffness) @ rows)
    return csc_array(total)
