"""Which formulations of a study cover blocks one by one."""

from typing import TYPE_CHECKING

from nmm.errors import FormulationError
from nmm.geometry.tessellation.cover_types import block_cover

if TYPE_CHECKING:
    from nmm.formulation import CoverTable
    from nmm.geometry.tessellation.block_cover import BlockCover


def blocks_of(cover: "CoverTable") -> "BlockCover | None":
    """Return how blocks are covered one by one.

    None for meshes, for the elements of scikit-fem, which are no cover, and for what cannot be
    made: its run says why.
    """
    try:
        return block_cover(cover)
    except FormulationError:
        return None
