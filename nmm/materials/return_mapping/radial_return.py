"""Radial return of von Mises plasticity in plane strain, all points at once."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.materials.return_mapping.planes import BEYOND
from nmm.materials.tensors import DEVIATOR, ISOTROPIC, SPHERICAL, TWICE


@dataclass(frozen=True)
class RadialReturn:
    """Stresses (m, 4: xx, yy, xy, zz) back at the yield surface, with tangent (m, 3, 3).

    ``plastic_strain`` (m, 4) is (xx, yy, 2 xy, zz), ``accumulated`` (m,).
    """

    stress: Floats
    tangent: Floats
    plastic_strain: Floats
    accumulated: Floats


def radial_return(
    strain: Floats,
    plastic: Floats,
    accumulated: Floats,
    constants: tuple[float, float, float | Floats, float | Floats],
) -> RadialReturn:
    """Return stresses to the yield surface (Wilkins 1964; tangent of Simo and Taylor 1985).

    Parameters
    ----------
    strain, plastic, accumulated
        (m, 3) whole strain, (m, 4) plastic strain and (m,) accumulated plastic strain before.
    constants
        Young's modulus, Poisson's ratio, yield stress, hardening modulus; of all points or each.
    """
    e, nu, yields, hardens = constants
    shear, bulk = e / 2 / (1 + nu), e / 3 / (1 - 2 * nu)
    elastic = np.column_stack([strain, np.zeros(len(strain))]) - plastic
    elastic[:, 2] /= 2
    volume = elastic @ SPHERICAL
    trial, mean = 2 * shear * (elastic - np.outer(volume / 3, SPHERICAL)), bulk * volume
    norm = np.sqrt(trial**2 @ TWICE)
    size = np.sqrt(1.5) * norm
    limit = yields + hardens * accumulated
    flows = size > limit * (1 + BEYOND)
    elastic_tangent = bulk * np.outer(ISOTROPIC, ISOTROPIC) + 2 * shear * DEVIATOR
    if not flows.any():
        stress = trial + np.outer(mean, SPHERICAL)
        tangent = np.broadcast_to(elastic_tangent, (len(strain), 3, 3))
        return RadialReturn(stress, tangent, plastic, accumulated)
    more = np.where(flows, (size - limit) / (3 * shear + hardens), 0.0)
    way = trial / np.where(norm > 0, norm, 1.0)[:, None]
    left = 1 - 3 * shear * more / np.where(flows, size, 1.0)
    stress = left[:, None] * trial + np.outer(mean, SPHERICAL)
    grown = plastic + np.sqrt(1.5) * more[:, None] * way * TWICE
    softer = np.where(flows, 3 * shear / (3 * shear + hardens) - (1 - left), 0.0)
    along = way[:, :3]
    tangent = (
        bulk * np.outer(ISOTROPIC, ISOTROPIC)
        + 2 * shear * left[:, None, None] * DEVIATOR
        - 2 * shear * softer[:, None, None] * along[:, :, None] * along[:, None, :]
    )
    return RadialReturn(stress, tangent, grown, accumulated + more)
