"""What ``[cover]`` names: meshes of patches, or blocks with a cover each, and local functions."""

from typing import TYPE_CHECKING

from covers.local_functions.polynomials import LocalFunctions
from covers.mathematical.base import CoverType
from covers.mathematical.registry import COVERS
from nmm.geometry.tessellation.block_cover import BlockCover, PieceGlue
from nmm.registry import Registry

if TYPE_CHECKING:
    from nmm.formulation import CoverTable

BLOCKS = {
    "block": "nmm.geometry.tessellation.block_cover:WholeBlocks",
    "sub_blocks": "nmm.geometry.tessellation.sub_blocks:SubBlocks",
}
COVER_TYPES = Registry[type[CoverType]]("cover", CoverType, BLOCKS | COVERS)
"""Covers by name, or a user's own."""
LOCAL_FUNCTIONS = Registry[type[LocalFunctions]](
    "local functions",
    LocalFunctions,
    {
        "monomials": "covers.local_functions.polynomials:Monomials",
        "rigid_strain": "covers.local_functions.polynomials:RigidStrain",
        "rigid": "covers.local_functions.polynomials:Rigid",
    },
)
"""Local functions of covers by name, or a user's own."""


def block_cover(cover: "CoverTable") -> BlockCover | None:
    """Return how blocks are covered one by one; None where a mesh covers all of them.

    Raises
    ------
    FormulationError
        When the type is not known or may not be imported, or has no such options.
    """
    if cover.type in COVERS or not issubclass(COVER_TYPES.load(cover.type), BlockCover):
        return None
    made: BlockCover = COVER_TYPES.make(cover.type, cover.options)
    return made


def piece_glue(cover: "CoverTable") -> PieceGlue | None:
    """Return what holds the pieces of blocks together; None where nothing does for good."""
    blocks = block_cover(cover)
    return None if blocks is None else blocks.piece_glue
