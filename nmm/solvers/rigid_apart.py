"""Solutions with the rigid motions of bodies kept apart from their strain.

A body that is 1e9 times stiffer than what carries it moves by 1 and strains by 1e-9. Numbers that
hold both have eight digits left for the strain, and its stress is wrong by 1e-7 of the load or
more. With ``d = w + R q``, ``w`` the strain and ``q`` the rigid motions ``R`` of the bodies,
elasticity never sees ``q`` and ``w`` is small: refinement in this form ends at the rounding of
``w`` alone.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array, eye_array

from integration.arrays import Floats
from nmm.solvers.accuracy.krylov import minimal_residual
from nmm.solvers.linear import Factor
from nmm.solvers.unchecked import magnitudes

# Rounding of elastic forces, as a share of the load, from which rigid motions are kept apart.
ROUNDED = 1e-12
RESTARTS = 6
# Share of the diagonal of ``int u . v`` below which unknowns displace nothing.
NOTHING = 1e-14


@dataclass(frozen=True)
class Bodies:
    """Rigid motions of the bodies.

    Attributes
    ----------
    elastic
        (n, n) stiffness, zero for all rigid motions.
    modes
        (n, 3 B) unknowns of the rigid motions.
    projection
        (3 B, n) rigid motions in unknowns; ``projection @ modes`` is one.
    measure
        (n, n) ``int u . v`` where functions are dependent: zero for unknowns whose displacement is
        zero everywhere. None where functions are independent.
    """

    elastic: csc_array
    modes: csc_array
    projection: csr_array
    measure: csc_array | None = None


@dataclass(frozen=True)
class RigidSplit:
    """A solution ``strain + modes @ rigid``.

    Attributes
    ----------
    strain
        (n,) unknowns without rigid motions.
    rigid
        (3 B,) rigid motions.
    multipliers
        (k,) of the conditions.
    residual
        Relative to the load, as `Factor.relative_residual`.
    """

    strain: Floats
    rigid: Floats
    multipliers: Floats
    residual: float


def rounding(factor: Factor, bodies: Bodies, solution: Floats, load: Floats) -> float:
    """Return what rounding of the solution makes of elastic forces, as a share of the load."""
    n = bodies.elastic.shape[0]
    force = magnitudes(bodies.elastic) @ np.abs(solution[:n])
    size = float(np.linalg.norm(factor.scale * load))
    error = float(np.finfo(float).eps) * float(np.linalg.norm(factor.scale[:n] * force))
    return error / size if size > 0 else 0.0


def solve_apart(
    factor: Factor,
    bodies: Bodies,
    held: csc_array,
    load: Floats,
    border: csr_array | None = None,
) -> RigidSplit:
    """Solve ``(elastic + held) d + border^T m = load`` with rigid motions apart.

    Parameters
    ----------
    factor
        Factor of the whole system, conditions included.
    held
        (n, n) all of the matrix that is not elastic.
    load
        (n + k,) force and right-hand sides of the conditions.
    border
        (k, n) conditions.
    """
    n, scale, modes = bodies.elastic.shape[0], factor.scale, bodies.modes
    k, r = len(load) - n, modes.shape[1]
    stiff = csr_array(bodies.elastic + held)
    carried = csr_array(held @ modes)
    rows = csr_array((0, n)) if border is None else border
    rows_carried = csr_array(rows @ modes)
    seen = _seen(factor, bodies.measure)

    def product(z: Floats) -> Floats:
        w, q, m = z[:n], z[n : n + r], z[n + r :]
        force = stiff @ w + carried @ q + rows.T @ m
        return np.asarray(scale * np.concatenate([force, rows @ w + rows_carried @ q]))

    def inverse(rest: Floats) -> Floats:
        found = scale * factor.decomposition.solve(rest)
        q = bodies.projection @ found[:n]
        return np.concatenate([seen(found[:n] - modes @ q), q, found[n:]])

    rhs = scale * load
    z = minimal_residual(
        product,
        inverse,
        rhs,
        tolerance=1e-15,
        rounds=RESTARTS,
        start=np.zeros(n + r + k),
    )
    size = float(np.linalg.norm(rhs))
    rest = float(np.linalg.norm(rhs - product(z)))
    return RigidSplit(z[:n], z[n : n + r], z[n + r :], rest / size if size > 0 else rest)


def _seen(factor: Factor, measure: csc_array | None) -> Callable[[Floats], Floats]:
    """Return what leaves out of unknowns the part that displaces nothing.

    It is of the size of the rigid motions, and rounding of it is as large as that of theirs.
    """
    if measure is None:
        return lambda w: w
    diagonal = measure.diagonal()
    scale = 1 / np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
    scaled = diags_array(scale) @ measure @ diags_array(scale)
    parts = factor.solver.decompose(csc_array(scaled + NOTHING * eye_array(len(scale))))

    def leave(w: Floats) -> Floats:
        for _ in range(4):  # the factors are exact to a few digits only
            w = w - scale * parts.solve(NOTHING * w / scale)
        return w

    return leave
