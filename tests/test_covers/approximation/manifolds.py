"""Manifolds on a square, and models of them."""

import numpy as np

from covers.approximation.manifold import Manifold
from covers.approximation.mesh_manifold import mesh_manifold
from covers.approximation.uncut import uncut
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Monomials
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.materials.elastic import Elastic
from nmm.verification.problems.solids.special_cases import net

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
HOLED = Polygons.from_rings(
    [
        [
            [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.6], [0.0, 1.0]],
            [[0.9, 0.2], [1.2, 0.2], [1.2, 0.4], [0.9, 0.4]],
        ]
    ]
)
LAW = Elastic(1.0, 0.3)


def model(manifold: Manifold, plane: str = "stress") -> Model:
    n = len(manifold.elements)
    elasticity = np.broadcast_to(LAW.stiffness(plane), (n, 3, 3)).copy()
    return Model(
        manifold,
        elasticity,
        np.ones(n),
        np.ones(n),
        1.0,
        uncut(manifold),
    )


def triangles(degree: int, size: float = 0.3, regions: Polygons = SQUARE) -> Manifold:
    cover = Triangles.regular(bounds(regions), size, angle=0.4, shift=(0.21, 0.37))
    return mesh_manifold(cover, cut(cover, regions), Monomials(degree))


def bounds(regions: Polygons) -> Floats:
    return np.stack([regions.points.min(axis=0), regions.points.max(axis=0)])


def distorted() -> Manifold:
    cover = net("distorted quads")
    return mesh_manifold(cover, cut(cover, SQUARE), Monomials(1))
