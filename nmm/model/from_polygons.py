"""A model from Python: polygons, laws and a formulation's cover, without a scene."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.formulation import CoverTable
from nmm.geometry.blocks import Regions
from nmm.materials.base import Law
from nmm.model.covering import Covering, cover_regions

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
    lines = [np.asarray(crack, dtype=float) for crack in cracks]
    return covered(
        regions,
        cover,
        laws,
        plane,
        cracks=lines,
        density=weights,
        thickness=thickness,
        lumped=lumped,
        finite=finite,
    )


def covered(
    regions: Regions,
    cover: CoverTable,
    laws: Sequence[Law],
    plane: str,
    *,
    cracks: list[Floats],
    density: Floats,
    thickness: float,
    lumped: bool,
    in_pieces: bool = False,
    bonded: Sequence[int] = (),
    finite: bool = False,
    before: "Cutting | None" = None,
) -> Model:
    """Cover regions and give the elements the numbers of their materials.

    Parameters
    ----------
    regions
        N regions with their materials, numbers of the ``laws`` and of the densities (kg/m3).
    in_pieces
        Whether covers of blocks divide none of them further.
    bonded
        Numbers of the cracks whose faces begin bonded: their tips carry no functions.
    finite
        Whether strain is finite.
    before
        The last cut of the same regions.
    """
    own = np.asarray(regions.material)
    kappa = np.array([law.kolosov(plane) for law in laws])
    covering = cover_regions(regions, cover, cracks, kappa[own], in_pieces, bonded, before)
    of_element = own[covering.manifold.element_region]
    covering = _numbered(covering, regions)
    return Model(
        manifold=covering.manifold,
        elasticity=np.array([law.stiffness(plane) for law in laws])[of_element],
        density=density[of_element],
        modulus=np.array([law.modulus for law in laws])[of_element],
        thickness=thickness,
        cut=covering.cut,
        lumped=lumped,
        projected=cover.volumetric == "projected",
        laws=tuple(laws),
        law=of_element,
        plane=plane,
        finite=finite,
        bonded=tuple(bonded),
        cutting=covering.cutting,
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
