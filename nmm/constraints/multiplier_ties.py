"""Interfaces glued by Lagrange multipliers: no jump in the mean with any multiplier."""

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_array, diags_array

from integration.arrays import Floats, Ints
from nmm.assembly.motion import State
from nmm.constraints.ties import TiedPairs

# A condition that others imply up to this share of it is left out, and one that is this share of
# the largest: it is the rounding of none. The first is the root of what products of rows resolve.
IMPLIED, NOTHING = 1e-6, 1e-12
# More conditions than this are not looked at.
MANY = 3000


@dataclass(frozen=True)
class MultiplierGlue:
    """Conditions ``int mu . [u] = 0``.

    Attributes
    ----------
    pairs
        Points on both sides.
    basis
        (2m, k) multipliers at the points, component minor.
    found
        Their values in the last solution (Pa), which are tractions on the second side.
    """

    pairs: TiedPairs
    basis: csr_array
    found: dict[str, Floats] = field(default_factory=dict)

    @property
    def heavy(self) -> csr_array:
        """(k, 2m) multipliers times the area of the points."""
        return csr_array((diags_array(np.repeat(self.pairs.weight, 2)) @ self.basis).T)

    def border(self, state: State, n: int) -> tuple[csr_array, Floats]:
        """Rows (k, n) and right-hand sides of the conditions on the step's unknowns."""
        rows = csr_array(self.heavy @ self.pairs.rows(state, n))
        return rows, -(self.heavy @ self.pairs.jump(state).ravel())


def independent(rows: csr_array, diagonal: Floats) -> Ints:
    """Return which conditions (k, n) none of the earlier ones imply.

    Blocks that meet at a corner share conditions there. They are compared as forces on springs of
    the stiffness of the ``diagonal`` (n,).
    """
    from scipy.linalg.lapack import dpstrf

    if not 0 < rows.shape[0] <= MANY:
        return np.arange(rows.shape[0])
    soft = diags_array(np.where(diagonal > 0, 1 / np.where(diagonal > 0, diagonal, 1.0), 0.0))
    gram = np.asarray((rows @ soft @ rows.T).todense())
    size = np.sqrt(gram.diagonal())
    said = size > NOTHING * size.max()
    scale = np.where(said, 1 / np.where(said, size, 1.0), 0.0)
    _, order, rank, _ = dpstrf(scale[:, None] * gram * scale, tol=IMPLIED**2)
    return np.sort(order[:rank] - 1)
