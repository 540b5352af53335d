"""One patch of weight 1 for each block: discontinuous deformation analysis (Shi 1988)."""

import numpy as np

from covers.approximation.groups.physical_covers import PhysicalCovers
from covers.approximation.groups.weighted_monomials import Shapes, Weights, polynomial_group
from covers.approximation.manifold import Manifold
from covers.approximation.rigid_modes import LinearMotions
from covers.cutting.boundary import ring_edges
from covers.local_functions.polynomials import Kinds, LocalFunctions
from integration.arrays import Ints
from integration.polygons import Polygons, diameters


def block_manifold(polygons: Polygons, regions: Ints, functions: LocalFunctions) -> Manifold:
    """Return the manifold with one physical cover and one element for each block.

    Parameters
    ----------
    polygons
        The blocks in the reference configuration; local functions are centred on their centroids.
    regions
        (N,) input region of each block.
    functions
        Local functions of every block: `RigidStrain` gives classical DDA, `Monomials` of degree
        2 and 3 higher-order DDA (Chen, Ohnishi and Ito 1997), `Rigid` rigid blocks.
    """
    polygons = polygons.oriented()
    n = len(polygons)
    blocks = np.arange(n, dtype=np.int64)
    centre, size = polygons.centroids, diameters(polygons)
    length = np.ones(n) if functions.physical_length else size / 2
    offset = np.arange(n + 1, dtype=np.int64) * functions.n_unknowns
    covers = PhysicalCovers(blocks, blocks, centre, np.eye(2) / length[:, None, None], offset[:-1])
    shapes = Shapes(blocks, blocks, blocks, centre, np.eye(2) / (size / 2)[:, None, None])
    weights = Weights(0, np.ones((n, 1, 1)))
    group = polynomial_group(shapes, polygons, blocks[:, None], weights, [functions], covers)
    kinds = Kinds((functions,), np.zeros(n, dtype=np.int64))
    modes = (kinds, covers, int(offset[-1]), centre)
    return Manifold(
        elements=polygons,
        element_body=blocks,
        element_region=regions,
        groups=(group,),
        cover_offset=offset,
        cover_patch=blocks,
        cover_body=blocks,
        boundary=ring_edges(polygons, blocks),
        motions=LinearMotions(*modes),
        body_centroid=centre,
        body_area=polygons.areas,
    )
