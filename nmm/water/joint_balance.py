"""The balance of water in a network of joints over a step: flow, storage and voids.

The volume ``V`` of water at a node is about half of that of each joint that ends there. A change of
pressure ``dp`` stores ``V dp / K``, and an opening ``dV``. With the cubic law for the flow
(Witherspoon and others 1980) the heads ``h`` of a step satisfy

    M (h1 - h0) + dt G h1 = - (V1 - V0),    M = w V / K,

where ``G`` is the conductance with known apertures. There is no suction: a node whose head is
below it stores ``M = V / H``, with the height ``H`` of its joints, by draining or filling them:
what opens faster than water comes in is void.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.water.network import JointNetwork

# Passes over which nodes are under pressure; the matrices are monotone, so that few are taken.
PASSES = 50
# Least share of the largest volume, and least aperture of a joint as a share of its length, so that
# nodes of closed joints store something.
TIGHT = 1e-9


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
        flow, found = self.network.conductance(aperture) * self.thickness, np.zeros((n, n))
        for row, column, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
            np.add.at(found, (row, column), sign * flow)
        return OpenJoints(aperture, volume, np.asarray(store), found)

    def volumes(self, aperture: Floats) -> Floats:
        """Volumes (n,) at the nodes of joints with apertures (j, 2), weighted as pressures (m3)."""
        one, other = aperture.T
        length = self.network.length * self.thickness / 6
        shares = np.stack([length * (2 * one + other), length * (one + 2 * other)], axis=1)
        return np.bincount(self.network.ends.ravel(), shares.ravel(), self.network.n).astype(float)

    def pressed(self, head: Floats) -> Bools:
        """Which nodes (n,) are under pressure at heads (n,)."""
        return head > self.level

    def matrix(self, joints: OpenJoints, head: Floats, step: float) -> Floats:
        """Return ``M + dt G`` (n, n) at heads (n,), in m2."""
        return np.asarray(np.diag(self._store(joints, head)) + step * joints.flow)

    def heads(
        self,
        joints: OpenJoints,
        begun: Floats,
        opened: Floats,
        given: tuple[Ints, Floats],
        step: float,
    ) -> tuple[Floats, Floats]:
        """Return the heads (n,) at the end of a step (m), and what came in at each node (m3).

        Parameters
        ----------
        joints
            As they are at the start.
        begun, opened
            (n,) heads at the start (m), and by what volumes joints open (m3).
        given
            Nodes (k,) whose heads are prescribed, and these heads (k,).
        step
            Its length (s).
        """
        head, free = begun.copy(), np.ones(len(begun), dtype=bool)
        head[given[0]], free[given[0]] = given[1], False
        left = self._store(joints, begun) * (begun - self.level) - opened
        for _ in range(PASSES):
            wet, matrix = self.pressed(head), self.matrix(joints, head, step)
            load = left + self._store(joints, head) * self.level
            beside = matrix[np.ix_(free, ~free)] @ head[~free]
            head[free] = np.linalg.solve(matrix[np.ix_(free, free)], load[free] - beside)
            if np.array_equal(wet, self.pressed(head)):
                break
        return head, matrix @ head - load

    def _store(self, joints: OpenJoints, head: Floats) -> Floats:
        """Storage (n,) by a unit of head (m2) at heads (n,)."""
        return np.where(self.pressed(head), joints.store, self._drained)

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
