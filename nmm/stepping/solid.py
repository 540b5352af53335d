"""A model from Python: polygons, laws and a formulation's cover, without a scene."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.formulation import Cover
from nmm.geometry.blocks import Regions
from nmm.materials.base import Law
from nmm.stepping.covering import cover_regions


def solid(
    polygons: Polygons,
    cover: Cover,
    laws: Sequence[Law],
    plane: str,
    *,
    material: Ints | None = None,
    cracks: Sequence[npt.ArrayLike] = (),
    density: Sequence[float] | None = None,
    thickness: float = 1.0,
    lumped: bool = False,
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
    """
    n = len(polygons)
    own = np.zeros(n, dtype=np.int64) if material is None else material
    names = tuple(f"#{number}" for number in range(n))
    regions = Regions(polygons, own, names, np.arange(n))
    kappa = np.array([law.kolosov(plane) for law in laws])[own]
    lines: list[Floats] = [np.asarray(crack, dtype=float) for crack in cracks]
    covering = cover_regions(regions, cover, lines, kappa)
    of_element = own[covering.manifold.element_region]
    weights = np.zeros(len(laws)) if density is None else np.array(density, dtype=float)
    return Model(
        manifold=covering.manifold,
        elasticity=np.array([law.stiffness(plane) for law in laws])[of_element],
        density=weights[of_element],
        modulus=np.array([law.modulus for law in laws])[of_element],
        thickness=thickness,
        cut=covering.cut,
        lumped=lumped,
    )
