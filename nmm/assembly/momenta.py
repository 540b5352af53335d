"""Momenta of the bodies of a model as rows of the velocities."""

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array

from covers.approximation.own_rule import own_rule
from integration.arrays import Floats
from nmm.assembly.model import Model


def momenta(model: Model, deformation: Floats) -> csr_array:
    """Rows (3 B, n): linear momentum, and angular momentum about where the frames' centres are.

    They act on velocities of bodies with a deformation (n,), in body axes.
    """
    manifold, heavy = model.manifold, bool((model.density > 0).all())
    mass = model.mass if heavy else model.measure
    rows = csr_array((mass @ manifold.rigid_modes).T)
    if not deformation.any():
        return rows
    rule = own_rule(manifold)
    at = manifold.rows(rule.owner, rule.points)
    away = at.apply(deformation)
    across = np.stack([-away[:, 1], away[:, 0]], axis=1)
    share = model.density[rule.owner] * model.thickness if heavy else 1.0
    values = ((share * rule.weights)[:, None] * at.along(across)).ravel()
    row = 3 * manifold.element_body[rule.owner] + 2
    place = np.repeat(row, at.unknowns.shape[1]), at.unknowns.ravel()
    return csr_array(rows + csc_array(coo_array((values, place), shape=rows.shape)))
