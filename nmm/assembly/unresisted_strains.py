"""Strains that matter does not resist where it flows: a trace of its elastic stiffness does.

Perfectly plastic matter resists two of three strains on a plane of its yield surface, and one
beside the turn of its axes at an edge. Where a whole mesh is there, fields of such strains fit
together, the tangent stiffness is exactly singular, and rounding chooses how far its solution goes
along them: iterations leave a state that was right. With a trace of stiffness in the tangent alone
they stay, as the solution is then that which goes least along what nothing resists (Tikhonov). An
iterate that balances is an equilibrium of matter as it is.
"""

import numpy as np

from integration.arrays import Floats

# The share of the elastic stiffness: solutions along what is not resisted are rounding over it,
# and each iteration leaves so much of the one before.
TRACE = 1e-8
# A tangent with less than this share of the elastic determinant leaves some strain unresisted.
NOTHING = 1e-8


def resisting(tangent: Floats, elastic: Floats) -> Floats:
    """Return tangents (Q, 3, 3) that resist all strains, given those of elastic matter.

    The same object where all do.
    """
    flows = np.abs(np.linalg.det(tangent)) < NOTHING * np.linalg.det(elastic)
    if not flows.any():
        return tangent
    return np.asarray(tangent + TRACE * np.where(flows[:, None, None], elastic, 0.0))
