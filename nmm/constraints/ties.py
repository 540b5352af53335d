"""Points of interfaces on both sides, and the springs that may hold them together."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from scipy.sparse import bsr_array, csc_array, csr_array

from integration.arrays import Floats
from nmm.assembly.motion import MaterialPoints, State
from nmm.constraints.rows import AXES, sparse_rows


@dataclass(frozen=True)
class TiedPairs:
    """The same m points of an interface as points of the bodies on either side.

    Attributes
    ----------
    first, second
        Points of the material.
    normal
        (m, 2) from the second to the first body, in the reference place.
    weight
        (m,) area of interface (m2).
    """

    first: MaterialPoints
    second: MaterialPoints
    normal: Floats
    weight: Floats

    def jump(self, state: State) -> Floats:
        """Return by how much the first side has moved from the second (m, 2), in global axes.

        Sides are bonded as they lie: a gap that the search for shared edges allows is no jump.
        """
        frames, q = state.frames, state.deformation
        return np.asarray(self.first.moved(frames, q) - self.second.moved(frames, q))

    def rows(self, state: State, n: int) -> csr_array:
        """Rows (2m, n) of the jump, component minor."""
        one, two, m = self.first, self.second, len(self.weight)
        parts = []
        for axis in AXES:
            toward = np.tile(axis, (m, 1))
            parts.append(
                np.concatenate(
                    [one.along(state.frames, toward), -two.along(state.frames, toward)], axis=1
                )
            )
        unknowns = np.concatenate([one.rows.unknowns, two.rows.unknowns], axis=1)
        return sparse_rows(unknowns, np.stack(parts, axis=1), n)


class Tie(ABC):
    """What holds the sides of an interface together."""

    @property
    @abstractmethod
    def about(self) -> str:
        """What it is and how many points it acts at, in words."""

    @abstractmethod
    def matrix(self, state: State, n: int) -> csc_array:
        """Matrix (n, n) that joins the stiffness."""

    @abstractmethod
    def force(self, state: State, n: int) -> Floats:
        """Force (n,) on the unknowns as the sides stand."""

    @abstractmethod
    def energy(self, state: State) -> float:
        """Energy (J) of the tie."""

    def gap_volume(self, state: State, k: int) -> Floats:
        """Volumes (k,) between the sides, for a model's k pressures (m2); springs have none."""
        return np.zeros(k)


@dataclass(frozen=True)
class TieSprings(Tie):
    """Springs at the points.

    Attributes
    ----------
    pairs
        Where.
    stiffness
        (m, 2) normal and shear (Pa/m).
    """

    pairs: TiedPairs
    stiffness: Floats

    @property
    def about(self) -> str:
        """See `Tie.about`."""
        return f"springs at {len(self.stiffness)} points"

    def matrix(self, state: State, n: int) -> csc_array:
        """See `Tie.matrix`."""
        rows = self.pairs.rows(state, n)
        return csc_array(rows.T @ (_diagonal(self._tensor(state)) @ rows))

    def force(self, state: State, n: int) -> Floats:
        """See `Tie.force`."""
        pull = np.einsum("mij,mj->mi", self._tensor(state), self.pairs.jump(state))
        return np.asarray(-(self.pairs.rows(state, n).T @ pull.ravel()))

    def energy(self, state: State) -> float:
        """See `Tie.energy`."""
        jump = self.pairs.jump(state)
        return 0.5 * float(np.einsum("mi,mij,mj->", jump, self._tensor(state), jump))

    def _tensor(self, state: State) -> Floats:
        """Springs (m, 2, 2) in global axes (N/m), turning with the second body."""
        normal = state.frames.to_global(self.pairs.second.body, self.pairs.normal)
        along = np.stack([normal[:, 1], -normal[:, 0]], axis=1)
        axes = np.stack([normal, along], axis=1)
        stiff = self.pairs.weight[:, None] * self.stiffness
        return np.asarray(np.einsum("mka,mk,mkb->mab", axes, stiff, axes))


def _diagonal(blocks: Floats) -> bsr_array:
    m = len(blocks)
    return bsr_array((blocks, np.arange(m), np.arange(m + 1)), shape=(2 * m, 2 * m))
