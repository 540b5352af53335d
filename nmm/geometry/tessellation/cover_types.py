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


def named_functions(cover: "CoverTable") -> str:
    """Return the name of the local functions: as given, or that of those usual for its type."""
    return cover.functions or COVER_TYPES.load(cover.type).usual_functions


def functions_of(cover: "CoverTable") -> type[LocalFunctions]:
    """Return the class of the local functions of ``[cover]``."""
    return LOCAL_FUNCTIONS.load(named_functions(cover))


def degree_of(cover: "CoverTable") -> int | None:
    """Return the degree of the local functions; None where neither the table nor its type says one.

    That of the type goes with the functions that are usual for it.
    """
    if cover.degree is not None:
        return cover.degree
    kind = COVER_TYPES.load(cover.type)
    return kind.usual_degree if named_functions(cover) == kind.usual_functions else None


def highest_degree(cover: "CoverTable") -> int:
    """Return the highest degree of the local functions, over all regions."""
    return max([degree_of(cover) or 0, *(item.degree for item in cover.regions or ())])


def piece_glue(cover: "CoverTable") -> PieceGlue | None:
    """Return what holds the pieces of blocks together; None where nothing does for good."""
    blocks = block_cover(cover)
    return None if blocks is None else blocks.piece_glue
