"""Flow in a network of joints by the cubic law (Snow 1965; Witherspoon and others 1980).

Through a joint of aperture ``w`` and length ``L`` flows ``q = w^3 g / (12 mu) dh / L``, ``g`` the
weight of water and ``mu`` its viscosity. Where the aperture goes linearly from ``w1`` to ``w2`` the
same flow has ``w^3 = 2 w1^2 w2^2 / (w1 + w2)``, and ``(w1 + w2) (w1^2 + w2^2) / 4`` where it is
linear in the pressure, both exactly.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from integration.arrays import Bools, Floats, Ints
from nmm.errors import SolveError
from nmm.water.elimination import heads_of

# Most steps of the coupling of apertures and heads, and the change of heads that ends it.
ROUNDS, SETTLED = 400, 1e-12


@dataclass(frozen=True)
class JointNetwork:
    """Joints between nodes.

    Attributes
    ----------
    ends, length
        (j, 2) nodes of each joint, and its length (j,) in m.
    n
        Number of nodes.
    mobility
        ``g / (12 mu)`` in 1/(m s): weight of water over twelve times its viscosity.
    """

    ends: Ints
    length: Floats
    n: int
    mobility: float = 9810.0 / 12e-3

    def conductance(self, aperture: Floats, by_pressure: bool = False) -> Floats:
        """Flow (j,) for each metre of head (m/s) of joints of apertures (j, 2) at their ends.

        ``by_pressure`` says that between the ends the aperture is linear in the pressure and not in
        the place, as where the pressure itself opens a joint on springs.
        """
        one, other = aperture.T
        both = one + other
        if by_pressure:
            return np.asarray(self.mobility * both * (one**2 + other**2) / 4 / self.length)
        cubed = 2 * one**2 * other**2 / np.where(both > 0, both, 1.0)
        return np.asarray(self.mobility * cubed / self.length)

    def heads(self, conductance: Floats, fixed: Ints, given: Floats) -> Floats:
        """Steady heads (n,) with those of the nodes ``fixed`` (k,) given (k,).

        Nodes to which no joint is open have nan.

        Raises
        ------
        SolveError
            A part of open joints that no given head reaches.
        """
        return self._solved(conductance, fixed, given, np.zeros(self.n), np.zeros(self.n))

    def stepped(
        self, conductance: Floats, fixed: Ints, given: Floats, storage: Floats, before: Floats
    ) -> Floats:
        """Heads (n,) after a step (backward Euler).

        ``storage`` (n,) is what a node stores for each metre of head over the length of the step
        (m/s), ``before`` (n,) its head at the start.
        """
        return self._solved(conductance, fixed, given, storage, before)

    def flows(self, conductance: Floats, heads: Floats) -> Floats:
        """Flow (j,) of each joint from its first node to its second (m2/s)."""
        drop = heads[self.ends[:, 0]] - heads[self.ends[:, 1]]
        return np.where(conductance > 0, conductance * np.nan_to_num(drop), 0.0)

    def inflow(self, conductance: Floats, heads: Floats) -> Floats:
        """What flows into the network at each node (n,), m2/s: nothing but at given heads."""
        flow = self.flows(conductance, heads)
        first = np.bincount(self.ends[:, 0], flow, minlength=self.n)
        return np.asarray(first - np.bincount(self.ends[:, 1], flow, minlength=self.n))

    def isolated(self, conductance: Floats, fixed: Ints) -> Bools:
        """Which nodes (n,) have open joints and none that leads to a given head."""
        return _unreached(*self._parts(conductance), fixed)

    def _parts(self, conductance: Floats) -> tuple[Ints, Bools]:
        """Connected part (n,) of each node, and which have open joints."""
        is_open = conductance > 0
        a, b = self.ends[is_open].T
        graph = coo_array((np.ones(len(a)), (a, b)), shape=(self.n, self.n))
        part = connected_components(graph, directed=False)[1].astype(np.int64)
        wet = np.zeros(self.n, dtype=bool)
        wet[a] = wet[b] = True
        return part, wet

    def _solved(
        self, conductance: Floats, fixed: Ints, given: Floats, storage: Floats, before: Floats
    ) -> Floats:
        part, wet = self._parts(conductance)
        stores = storage > 0
        loose = _unreached(part, wet, fixed) & ~stores
        if loose.any():
            raise SolveError(
                f"joints at {int(loose.sum())} nodes, node {int(np.flatnonzero(loose)[0])} first, "
                "are open to one another and to no given head: expected a head in every part: give "
                "one there, or an aperture to what leads to it",
                singular=True,
            )
        heads = np.full(self.n, np.nan)
        heads[fixed] = given
        known = np.zeros(self.n, dtype=bool)
        known[fixed] = True
        sought = np.flatnonzero((wet | stores) & ~known)
        if not len(sought):
            return heads
        number = np.full(self.n, -1)
        number[sought] = np.arange(len(sought))
        # Heads are counted from the least one, so that all that is summed is positive.
        low = float(np.min([*given, *before[stores & ~known]], initial=np.inf))
        ground, driven = storage[sought].copy(), storage[sought] * (before[sought] - low)
        a, b = self.ends.T
        for one, other in ((a, b), (b, a)):
            edge = (number[one] >= 0) & known[other] & (conductance > 0)
            np.add.at(ground, number[one[edge]], conductance[edge])
            np.add.at(driven, number[one[edge]], conductance[edge] * (heads[other[edge]] - low))
        inner = (number[a] >= 0) & (number[b] >= 0) & (conductance > 0)
        links = number[self.ends[inner]]
        heads[sought] = low + heads_of(links, conductance[inner], ground, driven)
        return heads


def _unreached(part: Ints, wet: Bools, fixed: Ints) -> Bools:
    """Which wet nodes (n,) are of a connected part without a given head."""
    reached = np.zeros(part.max(initial=-1) + 1, dtype=bool)
    reached[part[fixed]] = True
    return np.asarray(wet & ~reached[part])


def coupled_heads(
    network: JointNetwork,
    conductance: Callable[[Floats], Floats],
    fixed: Ints,
    given: Floats,
    start: Floats | None = None,
) -> Floats:
    """Steady heads (n,) of joints whose conductances (j,) follow from the heads (n,).

    A fixed point: heads with the conductances of the last ones, from even heads that open all
    joints.

    Raises
    ------
    SolveError
        No fixed point in `ROUNDS` rounds.
    """
    heads = np.full(network.n, float(np.max(given))) if start is None else start
    size = max(float(np.ptp(given)), float(np.abs(given).max()), 1e-300)
    for _ in range(ROUNDS):
        found = network.heads(conductance(heads), fixed, given)
        change = float(np.abs(np.nan_to_num(found - heads)).max())
        heads = found
        if change <= SETTLED * size:
            return heads
    raise SolveError(
        f"flow in joints: heads still change by {change:.1e} m after {ROUNDS} rounds: expected a "
        "fixed point of apertures and heads: take stiffer joints or smaller steps of the load"
    )
