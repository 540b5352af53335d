"""Conditions on edges: given flux, exchange with the surroundings, prescribed value, joints.

With ``N`` the value of the field on the edge (the jump across a joint), ``Q`` the flux of the field
through it, ``g`` the value that ``N`` tends to and ``q`` a given flux, the field takes up

    q + s (g - N) + Q

per unit of the edge: ``s`` is a coefficient of exchange or of a joint, or the penalty of
Nitsche's method (1971), which alone has ``Q``. Its matrix is symmetric,

    N^T s N - N^T Q - Q^T N.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Floats
from nmm.effects.loading.load_factor import steadily

Factor = Callable[[float], float]
"""From a time (s) to a factor."""


@dataclass(frozen=True)
class Edge:
    """A condition at the points of edges.

    Attributes
    ----------
    name
        As the scene calls it.
    rows
        (m, n) ``N``.
    area
        (m,) area that each point stands for (m2).
    stiffness
        (m,) ``s``.
    flux
        (m, n) ``Q``; None without Nitsche's terms.
    given, inflow
        (m,) ``g`` and ``q`` at factor 1.
    factor
        Of both, over time.
    """

    name: str
    rows: csr_array
    area: Floats
    stiffness: Floats
    flux: csr_array | None = None
    given: Floats | float = 0.0
    inflow: Floats | float = 0.0
    factor: Factor = field(default=steadily)

    @cached_property
    def matrix(self) -> csc_array:
        """Its symmetric matrix (n, n)."""
        found = self.rows.T @ (diags_array(self.area * self.stiffness) @ self.rows)
        if self.flux is not None:
            mixed = self.rows.T @ (diags_array(self.area) @ self.flux)
            found = found - mixed - mixed.T
        return csc_array(found)

    @cached_property
    def load(self) -> Floats:
        """Right-hand side (n,) at factor 1."""
        given = np.broadcast_to(self.given, len(self.area))
        found = self.rows.T @ (self.area * (self.stiffness * given + self.inflow))
        if self.flux is not None:
            found = found - self.flux.T @ (self.area * given)
        return np.asarray(found)
