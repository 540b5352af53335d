"""Where the search for a step's unknowns starts: a mix of what the last steps moved.

A motion goes on as it did in the last steps, so that the combination of their unknowns with the
least out-of-balance force is near: on walls of bricks three to six times nearer than the unknowns
of the last step alone, with two thirds of their contacts in a wrong state. In statics no inertia
says where a loose piece belongs: what starts from a mix may leave it anywhere.
"""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled
from nmm.contact.islands.partition import Islands, balances
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.residual_kernel import SpringColumns, residual
from nmm.solvers.kernels.gauss import ridged

MIX_RIDGE = 1e-10
"""Part of the trace that keeps the least squares regular where the last steps were alike."""


def start_from(
    springs: CutSprings, known: list[Floats], mixes: bool, islands: Islands | None = None
) -> Floats:
    """Unknowns (n,) to start from: nothing, those ``known`` last, or a mix of all of them.

    Parameters
    ----------
    springs
        The equations of the step.
    known
        (n,) unknowns of the last steps, latest first.
    mixes
        Whether a mix ``sum a_i d_i``, ``sum a_i = 1``, may be: of the least weighted out-of-balance
        force as far as that is linear between the ``d_i`` (minimal residuals over past solutions,
        Fischer 1998).
    islands
        Each of which has a start of its own; None: there is one.
    """
    points = [np.zeros(springs.problem.force.shape), *known[: None if mixes else 1]]
    if len(points) == 1:
        return points[0]
    one = np.zeros(points[0].shape, dtype=np.int64) if islands is None else islands.unknown
    count = 1 if islands is None else islands.count
    found: Floats = _nearest(np.array(points), mixes, one, count, springs.columns)
    return found


@compiled
def _nearest(
    points: Floats, mixes: bool, island: Ints, islands: int, springs: SpringColumns
) -> Floats:
    """Unknowns (n,), of each island the best balanced of ``points`` (k, n) and their mix."""
    weight = springs.weight
    forces, sizes = np.empty(points.shape), np.empty((len(points), islands))
    for i in range(len(points)):
        force, _ = residual(points[i], springs)
        rest, largest = balances(points[i], force, island, islands, springs)
        for k in range(len(weight)):
            forces[i, k] = force[k]
        for one in range(islands):
            sizes[i, one] = rest[one] / (largest[one] if largest[one] > 0.0 else 1.0)
    best = np.zeros(islands, dtype=np.int64)
    for i in range(1, len(points)):
        for one in range(islands):
            if sizes[i, one] < sizes[best[one], one]:
                best[one] = i
    for k in range(len(weight)):
        # The best first: lines go from there.
        for i in range(best[island[k]], 0, -1):
            points[i, k], points[i - 1, k] = points[i - 1, k], points[i, k]
            forces[i, k], forces[i - 1, k] = forces[i - 1, k], forces[i, k]
    found: Floats = points[0].copy()
    if not mixes:
        return found
    mixed = _mixed(points, forces, weight, island, islands)
    force, _ = residual(mixed, springs)
    rest, largest = balances(mixed, force, island, islands, springs)
    for k in range(len(weight)):
        one = island[k]
        if rest[one] < sizes[best[one], one] * largest[one]:
            found[k] = mixed[k]
    return found


@compiled
def _mixed(points: Floats, forces: Floats, weight: Floats, island: Ints, islands: int) -> Floats:
    """Mix (n,) of ``points`` (k, n) of the least weighted force, on lines from the first.

    Each of the ``islands`` is mixed on its own. The normal equations are positive definite by their
    ridge; where they say nothing it is the first point.
    """
    count, n = points.shape[0] - 1, len(weight)
    tables, loads = np.zeros((islands, count, count)), np.zeros((islands, count))
    for k in range(n):
        square, table, load = weight[k] ** 2, tables[island[k]], loads[island[k]]
        for i in range(count):
            way = forces[i + 1, k] - forces[0, k]
            load[i] -= square * way * forces[0, k]
            for j in range(i + 1):
                table[i, j] += square * way * (forces[j + 1, k] - forces[0, k])
    for one in range(islands):
        for i in range(count):
            for j in range(i):
                tables[one, j, i] = tables[one, i, j]
        shares = ridged(tables[one], loads[one], MIX_RIDGE)
        for i in range(count):
            loads[one, i] = shares[i]
    found: Floats = points[0].copy()
    for k in range(n):
        for i in range(count):
            found[k] += loads[island[k], i] * (points[i + 1, k] - points[0, k])
    return found
