"""Blocks with their materials and names."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from integration.arrays import Floats, Ints
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
    """

    polygons: Polygons
    material: Ints
    name: tuple[str, ...]
    source: Ints
    cracks: Floats = field(default_factory=lambda: np.empty((0, 2, 2)))
    crack_region: Ints = field(default_factory=lambda: np.empty(0, dtype=np.int64))

    def __len__(self) -> int:
        return len(self.polygons)

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
