"""Covers that lie over one block each, or over one piece of a block: discontinuous deformation."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from covers.mathematical.base import CoverType
from integration.arrays import Ints
from integration.polygons import Polygons


@dataclass(frozen=True)
class PieceGlue:
    """The permanent bond between the pieces of one block.

    Attributes
    ----------
    method
        The name of a method that glue may have, such as "nitsche", whose terms give by nothing;
        None is springs.
    stiffness
        Springs in Young's moduli over the distance of the pieces' middles.
    """

    method: str | None = None
    stiffness: float = 100.0


@dataclass(frozen=True)
class BlockCover(CoverType):
    """Base of covers of blocks: a dataclass whose fields are the options of ``[cover]``.

    Attributes
    ----------
    divides
        Whether blocks are divided, as ``size``, ``angle`` and ``shift`` of ``[cover]`` say; else
        these are refused.
    """

    family: ClassVar[str] = "DDA"
    usual_functions: ClassVar[str] = "rigid_strain"
    usual_degree: ClassVar[int | None] = None
    divides: ClassVar[bool] = False

    def divided(
        self, blocks: Polygons, size: float | None, angle: float, shift: tuple[float, float]
    ) -> tuple[Polygons, Ints]:
        """Return the pieces of all blocks and the block (n,) that each comes from.

        Parameters
        ----------
        blocks
            As the scene has them, m.
        size, angle, shift
            Of ``[cover]``: m, rad, fractions of a cell.

        Raises
        ------
        FormulationError
            Blocks that cannot be divided like this.
        """
        return blocks, np.arange(len(blocks), dtype=np.int64)

    @property
    def piece_glue(self) -> PieceGlue | None:
        """What holds pieces of one block together; None where they meet by the interface."""
        return None


@dataclass(frozen=True)
class WholeBlocks(BlockCover):
    """One cover over each block, as in discontinuous deformation analysis (Shi 1988)."""
