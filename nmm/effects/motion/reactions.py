"""Reactions of supports that a change removes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.material_points import MaterialPoints, material_points
from nmm.assembly.model import Model
from nmm.assembly.state import State


@dataclass(frozen=True)
class Reactions:
    """Constant forces at material points.

    Attributes
    ----------
    elements, position
        (k,) elements of the points, and (k, 2) their reference places (m).
    force
        (k, 2) forces in global axes (N).
    beside
        (n,) self-equilibrated force on the unknowns that forces at the points do not represent.
    """

    elements: Ints
    position: Floats
    force: Floats
    beside: Floats

    @classmethod
    def none(cls, n_unknowns: int) -> Self:
        """Return no forces."""
        pairs = np.zeros((0, 2))
        return cls(np.zeros(0, dtype=np.int64), pairs, pairs, np.zeros(n_unknowns))

    @classmethod
    def sum(cls, parts: "Sequence[Reactions]", n_unknowns: int) -> Self:
        """Return the forces of several."""
        whole = [Reactions.none(n_unknowns), *parts]
        return cls(
            np.concatenate([one.elements for one in whole]),
            np.concatenate([one.position for one in whole]),
            np.concatenate([one.force for one in whole]),
            np.sum([one.beside for one in whole], axis=0),
        )

    def __len__(self) -> int:
        return len(self.elements)

    def at(self, chosen: Bools) -> "Reactions":
        """Return the forces at chosen points (k,); with ``beside`` only if these are all."""
        beside = self.beside if chosen.all() else np.zeros_like(self.beside)
        return Reactions(self.elements[chosen], self.position[chosen], self.force[chosen], beside)

    def points(self, model: Model) -> MaterialPoints:
        """Return the material points on a model."""
        return material_points(model.manifold, self.elements, self.position)

    def push(self, points: MaterialPoints, state: State) -> Floats:
        """Force (n,) on the unknowns."""
        local = points.along(state.frames, self.force)
        unknowns = points.rows.unknowns.ravel()
        found = np.bincount(unknowns, local.ravel(), minlength=len(state.deformation))
        return np.asarray(found + self.beside)

    def work(self, points: MaterialPoints, before: State, after: State) -> float:
        """Work (J) between two states."""
        found = float(np.sum(self.force * points.way(before, after)))
        return found + float(self.beside @ (after.deformation - before.deformation))
