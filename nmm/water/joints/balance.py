"""The balance of water in a network of joints over a step: flow, storage and voids.

The volume ``V`` of water at a node is about half of that of each joint that ends there. A change of
pressure ``dp`` stores ``V dp / K``, and an opening ``dV``. With the cubic law for the flow
(Witherspoon and others 1980) the heads ``h`` of a step satisfy

    M (h1 - h0) + dt G h1 = - (V1 - V0),    M = w V / K,

where ``G`` is the conductance with known apertures. There is no suction: a node whose head is
below it stores ``M = V / H``, with the height ``H`` of its joints, by draining or filling them,
until it is empty: what opens faster than water comes in is void. Water beyond what fills the joints
is a rising function ``s(h)`` of the head, so that the heads are the minimum of a convex function,
found by Newton's method along lines (Brugnano and Casulli 2008 for the two pieces above).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.water.joints.network import JointNetwork

# Newton's steps over which nodes are full, draining or empty, and halvings along one of them.
PASSES, HALVINGS = 50, 40
# Least share of the largest volume, and least aperture of a joint as a share of its length, so that
# nodes of closed joints store something.
TIGHT = 1e-9
# What an empty node stores by a head, as a share of what it drains by: heads there stay determined.
DRY = 1e-9


@dataclass(frozen=True)
class OpenJoints:
    """Volumes and conductances of joints.

    Attributes
    ----------
    aperture
        (j, 2) apertures at their ends (m).
    volume
        (n,) volumes of the joints at their nodes (m3).
    store
        (n,) storage by a unit of head (m2) at nodes under pressure.
    flow
        (n, n) conductance matrix ``G`` of the network (m2/s).
    """

    aperture: Floats
    volume: Floats
    store: Floats
    flow: Floats


@dataclass(frozen=True)
class JointBalance:
    """What the water of a network of joints obeys.

    Attributes
    ----------
    network
        The network.
    level
        (n,) elevations of its nodes (m).
    drawn
        (j,) apertures as drawn (m).
    thickness
        Of the blocks (m).
    squeeze
        ``w / K``, unit weight over bulk modulus of water (1/m).
    """

    network: JointNetwork
    level: Floats
    drawn: Floats
    thickness: float
    squeeze: float

    def opened(self, aperture: Floats) -> OpenJoints:
        """Return joints with apertures (j, 2) at their ends."""
        volume, n = self.volumes(aperture), self.network.n
        store = self.squeeze * np.maximum(volume, TIGHT * volume.max())
        a, b = self.network.ends.T
        flow = self.network.conductance(aperture) * self.thickness
        places = np.concatenate([n * a + a, n * b + b, n * a + b, n * b + a])
        found = np.bincount(places, np.concatenate([flow, flow, -flow, -flow]), n * n).astype(float)
        return OpenJoints(aperture, volume, np.asarray(store), found.reshape(n, n))

    def volumes(self, aperture: Floats) -> Floats:
        """Volumes (n,) at the nodes of joints with apertures (j, 2), weighted as pressures (m3)."""
        one, other = aperture.T
        length = self.network.length * self.thickness / 6
        shares = np.stack([length * (2 * one + other), length * (one + 2 * other)], axis=1)
        return np.bincount(self.network.ends.ravel(), shares.ravel(), self.network.n).astype(float)

    def pressed(self, head: Floats) -> Bools:
        """Which nodes (n,) are under pressure at heads (n,)."""
        return head > self.level

    def dry(self, head: Floats, volume: Floats) -> Bools:
        """Which nodes (n,) of joints with volumes (n,) are empty at heads (n,)."""
        return (head - self.level) * self._drained < -volume

    def matrix(self, joints: OpenJoints, head: Floats, volume: Floats, step: float) -> Floats:
        """Return ``M + dt G`` (n, n) at heads (n,) and volumes (n,), in m2."""
        return np.asarray(np.diag(self._slope(joints, head, volume)) + step * joints.flow)

    def beyond(self, joints: OpenJoints, head: Floats, volume: Floats) -> Floats:
        """Return water (n,) beyond what fills nodes with volumes (n,) at heads (n,), in m3."""
        above = head - self.level
        drained = self._drained * above
        empty = -volume + DRY * (drained + volume)
        below = np.where(self.dry(head, volume), empty, drained)
        return np.where(self.pressed(head), joints.store * above, below)

    def free(self, given: Ints) -> Bools:
        """Which nodes (n,) have heads to be found: all but those whose heads are ``given`` (k,)."""
        found = np.ones(self.network.n, dtype=bool)
        found[given] = False
        return found

    def heads(
        self,
        joints: OpenJoints,
        begun: Floats,
        volumes: tuple[Floats, Floats],
        given: tuple[Ints, Floats],
        step: float,
    ) -> tuple[Floats, Floats]:
        """Return the heads (n,) at the end of a step (m), and what came in at each node (m3).

        Parameters
        ----------
        joints
            As they are at the start.
        begun, volumes
            (n,) heads at the start (m), and volumes of nodes at the start and at the end (m3).
        given
            Nodes (k,) whose heads are prescribed, and these heads (k,).
        step
            Its length (s).
        """
        (first, last), head = volumes, begun.copy()
        head[given[0]], free = given[1], self.free(given[0])
        before = self.beyond(joints, begun, first) - (last - first)
        flow = step * joints.flow

        def lacking(trial: Floats) -> Floats:
            return np.asarray(self.beyond(joints, trial, last) + flow @ trial - before)

        if not free.any():
            return head, lacking(head)
        for _ in range(PASSES):
            matrix = self.matrix(joints, head, last, step)[np.ix_(free, free)]
            way = np.zeros(len(head))
            way[free] = np.linalg.solve(matrix, -lacking(head)[free])
            if np.array_equal(self._pieces(head, last), self._pieces(head + way, last)):
                return head + way, lacking(head + way)
            head = head + _share(partial(_rise, lacking, head, way)) * way
        return head, lacking(head)

    def _pieces(self, head: Floats, volume: Floats) -> Ints:
        """Return on which piece of ``s(h)`` nodes (n,) are: 0 draining, 1 full, -1 empty."""
        return self.pressed(head).astype(int) - self.dry(head, volume)

    def _slope(self, joints: OpenJoints, head: Floats, volume: Floats) -> Floats:
        """Storage (n,) by a unit of head (m2) at heads (n,)."""
        below = np.where(self.dry(head, volume), DRY * self._drained, self._drained)
        return np.where(self.pressed(head), joints.store, below)

    @cached_property
    def _drained(self) -> Floats:
        """Storage (n,) by a unit of head above the water: of joints as drawn (m2)."""
        a, b = self.network.ends.T
        drawn = np.maximum(self.drawn, TIGHT * self.network.length)
        height = np.maximum(np.abs(self.level[a] - self.level[b]) / 2, drawn)
        highest = np.zeros(self.network.n)
        for end in (a, b):
            np.maximum.at(highest, end, height)
        return np.asarray(self.volumes(np.repeat(drawn[:, None], 2, axis=1)) / highest)


def _rise(lacking: Callable[[Floats], Floats], head: Floats, way: Floats, share: float) -> float:
    """Return by how much the convex function rises along a way from heads (n,), at a share."""
    return float(way @ lacking(head + share * way))


def _share(slope: Callable[[float], float]) -> float:
    """Return the share of a way at which a convex function is least, at most all of it."""
    if slope(1.0) <= 0:
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if slope(middle) < 0 else (low, middle)
    return high
