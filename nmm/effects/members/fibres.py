"""Points of members with uniaxial laws: axial forces of links, bond of bars."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.materials.uniaxial import Uniaxial


@dataclass(frozen=True)
class FibreAnswer:
    """Force (m,) (N), tangent (m,) (N/m), and plastic strain with its length (m, 2) by the law."""

    force: Floats
    tangent: Floats
    memory: Floats


@dataclass(frozen=True)
class Fibres:
    """Points with uniaxial laws.

    Attributes
    ----------
    laws, law
        The laws, and the number (m,) of that of each point.
    length
        (m,) elongation (m) over the strain of the law.
    area
        (m,) force (N) over the stress of the law.
    start
        (m,) stress of the law at zero elongation.
    """

    laws: tuple[Uniaxial, ...]
    law: Ints
    length: Floats
    area: Floats
    start: Floats

    @classmethod
    def of(
        cls, laws: Sequence[Uniaxial], length: Floats, area: Floats, start: Floats | float = 0.0
    ) -> Self:
        """Return points with a law each; equal laws are stored once."""
        known = tuple(dict.fromkeys(laws))
        number = {law: index for index, law in enumerate(known)}
        law = np.array([number[one] for one in laws], dtype=np.int64)
        return cls(known, law, length, area, np.broadcast_to(start, length.shape).astype(float))

    def __len__(self) -> int:
        return len(self.law)

    @cached_property
    def elastic(self) -> Bools:
        """(m,) whether they have no yield stress."""
        return np.array([law.elastic for law in self.laws], dtype=bool)[self.law]

    @cached_property
    def linear(self) -> bool:
        """Whether all forces are linear in the elongations."""
        return all(law.linear for law in self.laws)

    @cached_property
    def _modulus(self) -> Floats:
        return np.array([law.stiffness for law in self.laws])[self.law]

    @cached_property
    def stiffness(self) -> Floats:
        """(m,) elastic stiffness (N/m)."""
        return np.asarray(self.area * self._modulus / self.length)

    def answer(self, way: Floats, memory: Floats) -> FibreAnswer:
        """Return forces and tangents at elongations (m,) (m); ``memory`` (m, 2) is that before."""
        trial = self._trial(way, memory)
        if self.linear:
            return FibreAnswer(self.area * trial, self.stiffness, memory)
        force, tangent, after = np.empty_like(way), np.empty_like(way), np.empty_like(memory)
        for number, law in enumerate(self.laws):  # a handful of laws
            at = np.flatnonzero(self.law == number)
            found = law.update(trial[at], memory[at, 0], memory[at, 1])
            force[at], tangent[at] = found.force, found.tangent
            after[at, 0], after[at, 1] = found.plastic, found.flowed
        return FibreAnswer(self.area * force, self.area / self.length * tangent, after)

    def limits(self, memory: Floats) -> tuple[Floats, Floats]:
        """Return the least and the largest forces (m,) (N) from now on."""
        low, high = np.empty(len(self)), np.empty(len(self))
        for number, law in enumerate(self.laws):  # a handful of laws
            at = np.flatnonzero(self.law == number)
            low[at], high[at] = law.limits(memory[at, 1])
        return self.area * low, self.area * high

    def slack(self, way: Floats, memory: Floats) -> Floats:
        """Elongations (m,) (m) from ``way`` to where something is carried; 0 where it is."""
        strain, trial = np.empty_like(way), self._trial(way, memory)
        for number, law in enumerate(self.laws):  # a handful of laws
            at = np.flatnonzero(self.law == number)
            strain[at] = law.slack(trial[at])
        return self.length * strain

    def _trial(self, way: Floats, memory: Floats) -> Floats:
        return np.asarray(self.start + self._modulus * (way / self.length - memory[:, 0]))

    def energy(self, force: Floats) -> float:
        """Energy (J) stored at forces (m,) (N)."""
        stress, density = force / self.area, np.empty_like(force)
        for number, law in enumerate(self.laws):  # a handful of laws
            at = np.flatnonzero(self.law == number)
            density[at] = law.energy(stress[at])
        return float(density @ (self.area * self.length))

    def missed_loss(self, forces: tuple[Floats, Floats], memories: tuple[Floats, Floats]) -> float:
        """Energy (J) that flow between two states takes beyond `loss`, as its laws say exactly."""
        taken = np.zeros(len(self.law))
        for number, law in enumerate(self.laws):  # a handful of laws
            at = np.flatnonzero(self.law == number)
            first, last = (law.taken(memory[at, 1]) for memory in memories)
            taken[at] = last - first
        return float(taken @ (self.area * self.length)) - self.loss(forces, memories)

    def loss(self, forces: tuple[Floats, Floats], memories: tuple[Floats, Floats]) -> float:
        """Energy (J) dissipated between two states of forces (m,) (N) and memories (m, 2)."""
        mean = (forces[0] + forces[1]) / 2
        return float((mean * self.length) @ (memories[1][:, 0] - memories[0][:, 0]))
