"""Where the search for a step's unknowns starts: a mix of what the last steps moved.

A motion goes on as it did in the last steps, so that the combination of their unknowns with the
least out-of-balance force is near: on walls of bricks three to six times nearer than the unknowns
of the last step alone, with two thirds of their contacts in a wrong state. In statics no inertia
says where a loose piece belongs: what starts from a mix may leave it anywhere.
"""

import numpy as np

from integration.arrays import Floats
from nmm.contact.problem.cut_springs import CutSprings

MIX_RIDGE = 1e-10
"""Part of the trace that keeps the least squares regular where the last steps were alike."""


def start_from(springs: CutSprings, known: list[Floats], mixes: bool) -> Floats:
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
    """
    points = [np.zeros_like(springs.problem.force), *known[: None if mixes else 1]]
    if len(points) == 1:
        return points[0]
    residuals = [springs.residual(point) for point in points]
    best = min(range(len(points)), key=lambda i: residuals[i].size)
    if not mixes:
        return points[best]
    others = [i for i in range(len(points)) if i != best]
    rest = springs.weight * residuals[best].force
    ways = np.stack([springs.weight * residuals[i].force - rest for i in others])
    products = np.einsum("ik,jk->ij", ways, ways)
    trace = float(np.trace(products))
    if not (np.isfinite(trace) and trace > 0.0):
        return points[best]
    products += MIX_RIDGE * trace * np.eye(len(others))
    share = np.linalg.solve(products, -np.einsum("ik,k->i", ways, rest))
    steps = np.stack([points[i] - points[best] for i in others])
    mixed = points[best] + np.einsum("i,ik->k", share, steps)
    return mixed if springs.residual(mixed).size < residuals[best].size else points[best]
