"""Which blocks are present at the same time, in a stage of a scene or throughout."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Bools, Ints
from nmm.geometry.blocks import Regions

if TYPE_CHECKING:
    from nmm.scene.model import Scene


@dataclass(frozen=True)
class Together:
    """Blocks by stage: those that are never there together may be drawn at the same place.

    Attributes
    ----------
    present
        (stages, N) which blocks each stage has.
    """

    present: Bools

    @classmethod
    def of(cls, scene: "Scene", whole: Regions) -> Self:
        """Return the blocks of each stage; a name that no block has is told elsewhere."""
        now, found = np.ones(len(whole), dtype=bool), []
        for stage in scene.stages:  # a handful of stages
            if stage.blocks is not None:
                now = np.zeros_like(now)
            for names, there in (
                (stage.blocks or (), True),
                (stage.remove, False),
                (stage.add, True),
            ):
                for name in names:
                    now[whole.select(name)] = there
            found.append(now.copy())
        return cls(np.array(found or [now]))

    def meet(self, first: Ints, second: Ints) -> Bools:
        """Return which pairs (k,) of blocks are present in one stage."""
        return np.asarray((self.present[:, first] & self.present[:, second]).any(axis=0))
