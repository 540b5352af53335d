"""From the formulation's ``[cover]`` to a manifold: blocks for DDA, meshes for all else."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from covers.approximation.block_manifold import block_manifold
from covers.approximation.manifold import Manifold
from covers.approximation.uncut import uncut
from covers.local_functions.polynomials import LocalFunctions
from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.geometry.tessellation.block_cover import WholeBlocks
from nmm.geometry.tessellation.cover_types import (
    block_cover,
    degree_of,
    functions_of,
    named_functions,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from covers.cutting.cut import Cutting
    from covers.cutting.cut_cells import CutCells
    from covers.mathematical.base import Cover as MathematicalCover
    from nmm.formulation import CoverTable
    from nmm.geometry.blocks import Regions


@dataclass(frozen=True)
class Covering:
    """A manifold, how the cut left the cover, and the cover itself where blocks have none.

    ``cutting`` is what the next cut of the same blocks may go on from.
    """

    manifold: Manifold
    cut: "CutCells"
    laid: "MathematicalCover | None" = None
    cutting: "Cutting | None" = None


def cover_regions(
    regions: "Regions",
    cover: "CoverTable",
    cracks: "Sequence[Floats]" = (),
    kappa: Floats | None = None,
    in_pieces: bool = False,
    bonded: "Sequence[int]" = (),
    before: "Cutting | None" = None,
) -> Covering:
    """Make the manifold that a formulation's ``[cover]`` names.

    Parameters
    ----------
    regions
        Blocks and the cracks that joint sets leave in them.
    cover
        The table.
    cracks
        Polylines (n, 2) of the scene.
    kappa
        Kolosov's constant of each region, for singular functions.
    in_pieces
        Whether covers of blocks divide no block further.
    bonded
        Numbers of the cracks whose tips carry no functions: what holds them has no singularity.
    before
        The last cut of the same blocks.

    Raises
    ------
    FormulationError
        A cover that cannot be made, or one that cannot hold cracks.
    """
    lines = [*cracks, *np.asarray(regions.cracks)]
    functions = local_functions(cover)
    kind = block_cover(cover)
    if cover.regions and (kind is not None or not functions.any_degree):
        raise FormulationError(
            f'[[cover.regions]]: with type = "{cover.type}", functions = '
            f'"{named_functions(cover)}": expected a mesh of polynomials: use type = "triangles" '
            'and functions = "monomials"'
        )
    if cover.nets and kind is not None:
        raise FormulationError(
            f'[[cover.nets]]: with type = "{cover.type}" every block has its own cover: expected a '
            'mesh: use type = "triangles", or remove the nets'
        )
    if kind is not None:
        if lines:
            raise FormulationError(
                f'[cover] type: "{cover.type}": {len(lines)} cracks end inside blocks: expected a '
                'cover that cracks can cut: use type = "triangles" with a size'
            )
        whole = WholeBlocks() if in_pieces else kind
        blocks, region = whole.divided(regions.polygons, cover.size, cover.angle, cover.shift)
        manifold = block_manifold(blocks, region, functions)
        return Covering(manifold, uncut(manifold))
    return _mesh(regions, cover, functions, lines, kappa, bonded, before)


def local_functions(cover: "CoverTable") -> LocalFunctions:
    """Return the local functions that ``[cover]`` names."""
    functions, degree, name = functions_of(cover), degree_of(cover), named_functions(cover)
    if functions.any_degree and degree is None:
        raise FormulationError(
            f'[cover] degree: not given: expected 0 to 3 with functions = "{name}": add degree'
        )
    if not functions.any_degree and degree not in (None, 1):
        raise FormulationError(
            f'[cover] degree: {degree}: expected 1 with functions = "{name}": use '
            'functions = "monomials", or leave degree out'
        )
    try:
        return functions(1 if degree is None else degree)
    except ValueError as fault:
        raise FormulationError(f"[cover] {fault}") from fault


def _mesh(
    regions: "Regions",
    cover: "CoverTable",
    functions: LocalFunctions,
    lines: "Sequence[Floats]",
    kappa: Floats | None,
    bonded: "Sequence[int]",
    before: "Cutting | None",
) -> Covering:
    from covers.approximation.mesh_manifold import mesh_manifold
    from nmm.model.manifolds.degrees import kinds_by_region
    from nmm.model.manifolds.enriching import enrichments
    from nmm.model.manifolds.several_meshes import laid_and_cut

    if cover.size is None:
        raise FormulationError(
            f'[cover] size: not given: expected the size of a cell in m with type = "{cover.type}"'
        )
    try:
        net = laid_and_cut(regions, cover, lines, before)
    except (ValueError, TypeError, ImportError) as fault:
        raise FormulationError(f"[cover] {fault}") from fault
    laid, pieces = net.cover, net.cells
    try:
        extra = enrichments(pieces, cover, kappa, bonded, lines)
    except FormulationError:
        raise
    except ValueError as fault:
        raise FormulationError(f"[cover.enrichment] {fault}") from fault
    kinds = functions if not cover.regions else kinds_by_region(regions, pieces, cover, functions)
    found = mesh_manifold(laid, pieces, kinds, extra)
    if found.reproduction == 0:
        raise FormulationError(
            f'[cover] degree: 0 with type = "{cover.type}" and options {dict(cover.options)}: '
            "displacements hold constants only, so that no strain is approached however small the "
            "cells: expected a linear field: use degree = 1, or weights that hold one"
        )
    return Covering(found, pieces, laid, net.cutting)


def cell_sizes(covering: Covering, degree: int) -> Floats:
    """Width (E,) of a band that flows alone (m), of fields of a degree on the elements' cells.

    With constant local functions it is a row of cells: the side of a square of their area, or the
    height of such an equilateral triangle. Richer fields bend within a cell: measured, bands are
    0.56 to 0.71 of it wide with linear and 0.44 to 0.66 with quadratic ones. Blocks without cells
    are cells themselves.
    """
    cover, cut = covering.laid, covering.cut
    if cover is None:
        return np.asarray(np.sqrt(covering.manifold.elements.areas))
    square = np.sqrt(3) if cover.cell_vertices.shape[1] == 3 else 1.0
    return np.asarray(2 / (degree + 2) * np.sqrt(square * cover.cells.areas[cut.element_cell]))
