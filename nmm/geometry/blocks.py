"""Blocks with their materials and names."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons


@dataclass(frozen=True)
class Regions:
    """Blocks with their materials and names.

    Attributes
    ----------
    polygons
        The blocks, N of them, exteriors counter-clockwise.
    material : (N,)
        Index in `list(scene.materials)`.
    name
        Name of each block: its own, "#3" for the fourth of `[[blocks]]` if it has none, "beam.12"
        for the thirteenth piece of the tessellated or cut block "beam".
    source : (N,)
        Number of the block or tessellation in the scene that each block comes from, blocks first.
    cracks : (m, 2, 2)
        Parts of joints that end inside a block.
    crack_region : (m,)
        Block in which each crack lies.
    number : (N,)
        Numbers among the blocks of the scene, of which these are some; None when they are all.
    bounds : (2, 2)
        Lower and upper corner of all blocks of the scene, m; None when they are all.
    rounding
        Unit in the last place of coordinates where the scene gives them, if that is not here, m.
    """

    polygons: Polygons
    material: Ints
    name: tuple[str, ...]
    source: Ints
    cracks: Floats = field(default_factory=lambda: np.empty((0, 2, 2)))
    crack_region: Ints = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    number: Ints | None = None
    bounds: Floats | None = None
    rounding: float = 0.0

    def __len__(self) -> int:
        return len(self.polygons)

    @property
    def box(self) -> Floats:
        """(2, 2) lower and upper corner of all blocks of the scene (m), be they there or not."""
        if self.bounds is not None:
            return self.bounds
        points = self.polygons.points
        return np.stack([points.min(axis=0), points.max(axis=0)])

    def only(self, present: Bools) -> Regions:
        """Return some of the blocks (N,), which keep their numbers and the box of all."""
        if present.all():
            return self
        index = np.flatnonzero(present)
        cracked = present[self.crack_region]
        place = np.cumsum(present) - 1
        return Regions(
            self.polygons.take(index),
            np.asarray(self.material)[index],
            tuple(self.name[one] for one in index),
            np.asarray(self.source)[index],
            self.cracks[cracked],
            place[self.crack_region[cracked]],
            self.numbers[index],
            self.box,
            self.rounding,
        )

    def divided(self, polygons: Polygons, parent: Ints) -> Regions:
        """Return other polygons of the same blocks, each a piece of the ``parent`` (n,) it lies in.

        Pieces of a block have its number, so that all that is said of it is said of them.
        """
        first = (parent == self.crack_region[:, None]).argmax(axis=1)
        return Regions(
            polygons,
            np.asarray(self.material)[parent],
            tuple(self.name[one] for one in parent),
            np.asarray(self.source)[parent],
            self.cracks,
            first,
            self.numbers[parent],
            self.box,
            self.rounding,
        )

    @property
    def numbers(self) -> Ints:
        """(N,) numbers among the blocks of the scene."""
        return np.arange(len(self)) if self.number is None else self.number

    def beside(self, others: Regions) -> Regions:
        """Return these and ``others`` of the same scene after them."""
        return Regions(
            Polygons.concatenate([self.polygons, others.polygons]),
            np.concatenate([self.material, others.material]),
            (*self.name, *others.name),
            np.concatenate([self.source, others.source]),
            np.concatenate([self.cracks, others.cracks]),
            np.concatenate([self.crack_region, others.crack_region + len(self)]),
            np.concatenate([self.numbers, others.numbers]),
            self.box,
            self.rounding,
        )

    def select(self, block: str | None) -> Ints:
        """Indices of a block and of all its pieces; of all blocks for None and "all".

        Empty when no block has the name.
        """
        if block in (None, "all"):
            return np.arange(len(self))
        chosen = [name == block or name.startswith(f"{block}.") for name in self.name]
        return np.flatnonzero(chosen)


def joined(parts: list[Regions]) -> Regions:
    """The blocks of all parts, in order."""
    return Regions(
        Polygons.concatenate([part.polygons for part in parts]),
        np.concatenate([part.material for part in parts]),
        tuple(name for part in parts for name in part.name),
        np.concatenate([part.source for part in parts]),
    )
