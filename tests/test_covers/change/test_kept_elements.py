"""Elements that a change leaves as they were are their own parts, found without an overlay."""

import numpy as np
import shapely

from covers.approximation.mesh_manifold import mesh_manifold
from covers.change.parentage import Parentage
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Monomials
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons


def test_parts_are_those_of_an_overlay_of_all_with_all() -> None:
    ring = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])
    region = Polygons.from_vertices([ring, ring + np.array([0.0, 1.0])])
    net = Triangles.regular([[0.0, 0.0], [2.0, 2.0]], 0.3, angle=0.2)
    old, new = (
        mesh_manifold(net, cut(net, region, [[[-0.1, 0.4], [tip, 0.55]]]), Monomials(1))
        for tip in (0.6, 1.1)
    )
    kin = Parentage(old, new)
    # Brute force.
    first, second = old.elements.to_shapely(), new.elements.to_shapely()
    common = shapely.area(shapely.intersection(first[:, None], second[None]))
    common[old.element_region[:, None] != new.element_region[None]] = 0.0
    common[common < 1e-12 * shapely.area(second).min()] = 0.0
    np.testing.assert_allclose(kin.elements.matrix.toarray(), common, atol=1e-15)
    np.testing.assert_allclose(kin.pieces.areas, kin.elements.common, rtol=1e-12)
    assert (np.diff(kin.elements.child) >= 0).all()
