"""Return of von Mises plasticity projected on plane stress, all points at once.

In the axes (xx + yy, yy - xx, xy) elasticity and the yield surface ``sigma P sigma = 2/3 k^2`` are
diagonal, so that the return is one equation for one multiplier a point (Simo and Taylor 1986).
"""

import numpy as np

from integration.arrays import Floats
from nmm.materials.return_mapping.planes import BEYOND
from nmm.materials.return_mapping.radial_return import RadialReturn

# Iterations for the multiplier; from zero they rise to it, three or four are enough.
MOST, ENOUGH = 50, 1e-14
# Orthonormal axes, and P in them.
AXES = np.array([[1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, np.sqrt(2)]]) / np.sqrt(2)
P = np.array([1 / 3, 1.0, 2.0])


def projected_return(
    strain: Floats,
    plastic: Floats,
    accumulated: Floats,
    constants: tuple[float, float, float, float],
) -> RadialReturn:
    """Return stresses to the yield surface in plane stress; see `radial_return`."""
    e, nu, yields, hardens = constants
    elastic = e / np.array([1 - nu, 1 + nu, 2 * (1 + nu)])
    trial = ((strain - plastic[:, :3]) @ AXES.T) * elastic
    limit = yields + hardens * accumulated
    flows = 1.5 * (P * trial**2).sum(axis=1) > (limit * (1 + BEYOND)) ** 2
    multiplier = np.zeros(len(strain))
    multiplier[flows] = _multiplier(trial[flows], accumulated[flows], elastic, yields, hardens)
    stress = trial / (1 + multiplier[:, None] * elastic * P)
    square = (P * stress**2).sum(axis=1)
    grown = accumulated + multiplier * np.sqrt(2 / 3 * square)
    flow = multiplier[:, None] * (P * stress) @ AXES
    after = plastic + np.column_stack([flow, -flow[:, 0] - flow[:, 1]])
    back = np.column_stack([stress @ AXES, np.zeros(len(stress))])
    tangent = AXES.T @ _tangent(stress, multiplier, flows, elastic, hardens) @ AXES
    return RadialReturn(back, tangent, after, grown)


def _multiplier(
    trial: Floats, accumulated: Floats, elastic: Floats, yields: float, hardens: float
) -> Floats:
    """Multipliers (m,) in 1/Pa of points beyond the yield surface.

    Newton's method on ``1/f = 1/k``, nearly a line of the multiplier however far the trial is.
    """
    found = np.zeros(len(trial))
    for _ in range(MOST):
        share = 1 / (1 + found[:, None] * elastic * P)
        parts = P * (trial * share) ** 2
        size = np.sqrt(1.5 * parts.sum(axis=1))
        falls = -1.5 * (parts * elastic * P * share).sum(axis=1) / size
        limit = yields + hardens * (accumulated + 2 / 3 * found * size)
        rises = 2 / 3 * hardens * (size + found * falls)
        off = 1 / size - 1 / limit
        if (np.abs(off) * size <= ENOUGH).all():
            break
        moved = found - off / (rises / limit**2 - falls / size**2)
        found = np.asarray(np.maximum(moved, 0.0), dtype=float)
    return np.asarray(found)


def _tangent(
    stress: Floats, multiplier: Floats, flows: Floats, elastic: Floats, hardens: float
) -> Floats:
    """Consistent tangent (m, 3, 3) in the axes of the return."""
    soft = elastic / (1 + multiplier[:, None] * elastic * P)
    normal = P * stress
    along = soft * normal
    square = (P * stress**2).sum(axis=1)
    hard = 2 / 3 * hardens * square / (1 - 2 / 3 * hardens * multiplier)
    total = (along * normal).sum(axis=1) + hard
    factor = np.where(flows, 1 / np.where(flows, total, 1.0), 0.0)
    found = -factor[:, None, None] * along[:, :, None] * along[:, None, :]
    diagonal = np.arange(3)
    found[:, diagonal, diagonal] += soft
    return np.asarray(found)
