"""What displacements of a case are made of: its family, and the polynomials that they hold."""

from typing import TYPE_CHECKING, Any

from covers.mathematical.base import CoverType
from nmm.errors import FormulationError
from nmm.geometry.tessellation.cover_types import COVER_TYPES
from nmm.study.cases.block_covers import blocks_of
from nmm.study.cases.running import SKFEM

if TYPE_CHECKING:
    from nmm.formulation import CoverTable


def family_of(cover: "CoverTable") -> str:
    """Return "elements" of a yardstick, else the family of the cover.

    That of meshes for a cover that cannot be made: its run says why.
    """
    if cover.type == SKFEM:
        return "elements"
    try:
        return COVER_TYPES.load(cover.type).family
    except FormulationError:
        return CoverType.family


def spanned_degree(cover: "CoverTable", done: Any) -> int | None:
    """Return the degree ``s + p`` of the complete polynomials among the displacements of a run.

    Weights that reproduce degree s times local functions of degree p span s + p, elements and
    pieces of blocks their own degree. None for blocks, which have no size to refine, and for
    singular functions beside polynomials.
    """
    if cover.enrichment is not None:
        return None
    if cover.type == SKFEM:
        return cover.degree
    blocks, manifold = blocks_of(cover), done.manifold
    if blocks is not None:
        return int(manifold.degree) if blocks.divides else None
    return None if manifold.reproduction is None else int(manifold.reproduction)
