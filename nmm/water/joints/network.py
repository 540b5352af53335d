"""Flow in a network of joints by the cubic law (Snow 1965; Witherspoon and others 1980).

The flow through a joint of aperture ``w`` and length ``L`` is ``q = w^3 g / (12 mu) dh / L``, with
the unit weight ``g`` of water and its viscosity ``mu``. For an aperture that is linear from ``w1``
to ``w2``, the flow is exactly that with ``w^3 = 2 w1^2 w2^2 / (w1 + w2)``.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from integration.arrays import Bools, Floats, Ints
from nmm.errors import SolveError
from nmm.water.joints.elimination import heads_of


@dataclass(frozen=True)
class JointNetwork:
    """A network of joints between nodes.

    Attributes
    ----------
    ends, length
        (j, 2) nodes of each joint, and its length (j,) in m.
    n
        Number of nodes.
    mobility
        ``g / (12 mu)``: unit weight of water over twelve times its viscosity (1/(m s)).
    """

    ends: Ints
    length: Floats
    n: int
    mobility: float = 9810.0 / 12e-3

    def conductance(self, aperture: Floats) -> Floats:
        """Conductance (j,) of joints: flow over head, for apertures (j, 2) at their ends (m/s)."""
        one, other = aperture.T
        both = one + other
        cubed = 2 * one**2 * other**2 / np.where(both > 0, both, 1.0)
        return np.asarray(self.mobility * cubed / self.length)

    def heads(self, conductance: Floats, fixed: Ints, given: Floats) -> Floats:
        """Return the steady heads (n,) with heads ``given`` (k,) at nodes ``fixed`` (k,) (m).

        Nodes without an open joint have nan.

        Raises
        ------
        SolveError
            A part of the open joints is connected to no given head.
        """
        heads = np.full(self.n, np.nan)
        heads[fixed] = given
        wet, known = self._wet(conductance), np.zeros(self.n, dtype=bool)
        known[fixed] = True
        sought = np.flatnonzero(wet & ~known)
        if not len(sought):
            return heads
        _refuse(self.isolated(conductance, fixed))
        number = np.full(self.n, -1)
        number[sought] = np.arange(len(sought))
        # Heads are counted from the lowest, so that all terms are positive.
        low = float(np.min(given, initial=np.inf))
        ground, driven = np.zeros(len(sought)), np.zeros(len(sought))
        a, b = self.ends.T
        for one, other in ((a, b), (b, a)):
            edge = (number[one] >= 0) & known[other] & (conductance > 0)
            np.add.at(ground, number[one[edge]], conductance[edge])
            np.add.at(driven, number[one[edge]], conductance[edge] * (heads[other[edge]] - low))
        inner = (number[a] >= 0) & (number[b] >= 0) & (conductance > 0)
        links = number[self.ends[inner]]
        heads[sought] = low + heads_of(links, conductance[inner], ground, driven)
        return heads

    def flows(self, conductance: Floats, heads: Floats) -> Floats:
        """Flow (j,) of each joint from its first node to its second (m2/s)."""
        drop = heads[self.ends[:, 0]] - heads[self.ends[:, 1]]
        return np.where(conductance > 0, conductance * np.nan_to_num(drop), 0.0)

    def inflow(self, conductance: Floats, heads: Floats) -> Floats:
        """Inflow (n,) into the network at each node (m2/s): zero but at given heads."""
        flow = self.flows(conductance, heads)
        first = np.bincount(self.ends[:, 0], flow, minlength=self.n)
        return np.asarray(first - np.bincount(self.ends[:, 1], flow, minlength=self.n))

    def isolated(self, conductance: Floats, fixed: Ints) -> Bools:
        """Which nodes (n,) have open joints, but no connection to a given head."""
        part = self._parts(conductance)
        reached = np.zeros(part.max(initial=-1) + 1, dtype=bool)
        reached[part[fixed]] = True
        return np.asarray(self._wet(conductance) & ~reached[part])

    def _wet(self, conductance: Floats) -> Bools:
        """Which nodes (n,) have open joints."""
        wet = np.zeros(self.n, dtype=bool)
        wet[self.ends[conductance > 0]] = True
        return wet

    def _parts(self, conductance: Floats) -> Ints:
        """Number (n,) of the part of each node, connected by open joints."""
        a, b = self.ends[conductance > 0].T
        graph = coo_array((np.ones(len(a)), (a, b)), shape=(self.n, self.n))
        return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def _refuse(isolated: Bools) -> None:
    """Raise where nodes (n,) are connected to no given head."""
    if isolated.any():
        raise SolveError(
            f"joints at {int(isolated.sum())} nodes, node {int(isolated.argmax())} first, "
            "are open to one another and to no given head: expected a head in every part: give "
            "one there, or an aperture to what leads to it",
            singular=True,
        )
