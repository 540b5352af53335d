"""A scalar field from one manifold to the next: the nearest in the mean square."""

import numpy as np
from scipy.sparse import csc_array, diags_array

from covers.change.normal_equations import NormalEquations
from covers.change.parentage import Parentage
from covers.change.transfer import Transfer
from covers.scalar.space import ScalarSpace
from integration.arrays import Floats


def carried_field(
    kin: Parentage, spaces: tuple[ScalarSpace, ScalarSpace], unknowns: Floats, declared: Floats
) -> Floats:
    """Return the unknowns (n,) on the new functions; bodies without parents have ``declared``."""
    old, new = spaces
    transfer = Transfer.of(kin, np.ones(len(kin.old.elements)))
    at_old = old.values(transfer.elements[0], transfer.points)
    rows = new.values(transfer.elements[1], transfer.points)
    mass = csc_array(rows.T @ (diags_array(transfer.weight) @ rows))
    found = NormalEquations(mass).solve(rows.T @ (transfer.weight * (at_old @ unknowns)))
    return np.where(kin.new_bodies[new.body], declared, found)
