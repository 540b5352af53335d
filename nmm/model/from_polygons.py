"""A model from Python: polygons, laws and a formulation's cover, without a scene."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.formulation import CoverTable
from nmm.geometry.blocks import Regions
from nmm.geometry.geometry import Geometry
from nmm.geometry.tessellation.cover_types import highest_degree
from nmm.materials.base import Law
from nmm.model.manifolds.covering import Covering, cell_sizes, cover_regions

if TYPE_CHECKING:
    from covers.cutting.cut import Cutting


def solid(
    polygons: Polygons,
    cover: CoverTable,
    laws: Sequence[Law],
    plane: str,
    *,
    material: Ints | None = None,
    cracks: Sequence[npt.ArrayLike] = (),
    density: Sequence[float] | None = None,
    thickness: float = 1.0,
    lumped: bool = False,
    finite: bool = False,
) -> Model:
    """Return the model of blocks under a cover.

    Parameters
    ----------
    polygons
        N blocks.
    cover
        As in a formulation.
    laws, density
        Materials with their densities (kg/m3), massless when not given.
    plane
        "stress" or "strain".
    material
        (N,) material of each block; the first for all when not given.
    cracks
        Polylines (n, 2), m.
    lumped
        Whether the mass couples no cover with another.
    finite
        Whether strain is finite.
    """
    n = len(polygons)
    own = np.zeros(n, dtype=np.int64) if material is None else material
    names = tuple(f"#{number}" for number in range(n))
    regions = Regions(polygons, own, names, np.arange(n))
    weights = np.zeros(len(laws)) if density is None else np.array(density, dtype=float)
    lines = tuple(np.asarray(crack, dtype=float) for crack in cracks)
    sheet = BlockMatter(laws, weights, plane, thickness, lumped, finite)
    return covered(Geometry(regions, lines), cover, sheet)


@dataclass(frozen=True)
class BlockMatter:
    """What blocks are made of.

    Attributes
    ----------
    laws, density
        Materials with their densities (kg/m3).
    plane
        "stress" or "strain".
    thickness
        m.
    lumped
        Whether the mass couples no cover with another.
    finite
        Whether strain is finite.
    """

    laws: Sequence[Law]
    density: Floats
    plane: str
    thickness: float
    lumped: bool
    finite: bool


def covered(
    geometry: Geometry, cover: CoverTable, sheet: BlockMatter, before: "Cutting | None" = None
) -> Model:
    """Cover a geometry and give the elements the numbers of their materials.

    Materials of its regions are numbers of those of the ``sheet``; ``before`` is the last cut of
    the same regions.
    """
    regions, laws, plane = geometry.regions, sheet.laws, sheet.plane
    own = np.asarray(regions.material)
    # Where singular fields are others the functions of tips are those of nu = 0.
    kappa = np.array([law.kolosov(plane) or 3.0 for law in laws])
    lines, apart, bonded = list(geometry.cracks), geometry.in_pieces, geometry.bonded
    covering = cover_regions(regions, cover, lines, kappa[own], apart, bonded, before)
    of_element = own[covering.manifold.element_region]
    covering = _numbered(covering, regions)
    sized = any(law.sized for law in laws)
    return Model(
        manifold=covering.manifold,
        elasticity=np.array([law.stiffness(plane) for law in laws])[of_element],
        density=sheet.density[of_element],
        modulus=np.array([law.modulus for law in laws])[of_element],
        thickness=sheet.thickness,
        cut=covering.cut,
        lumped=sheet.lumped,
        projected=cover.volumetric == "projected",
        laws=tuple(laws),
        law=of_element,
        plane=plane,
        finite=sheet.finite,
        bonded=bonded,
        cutting=covering.cutting,
        cell_size=cell_sizes(covering, highest_degree(cover)) if sized else None,
    )


def _numbered(covering: Covering, regions: Regions) -> Covering:
    """Return the covering with the numbers that regions have among those of the scene."""
    number, cut = regions.number, covering.cut
    if number is None:
        return covering
    manifold = replace(covering.manifold, element_region=number[covering.manifold.element_region])
    cut = replace(
        cut,
        element_region=number[cut.element_region],
        cover_region=number[cut.cover_region],
    )
    return replace(covering, manifold=manifold, cut=cut)
