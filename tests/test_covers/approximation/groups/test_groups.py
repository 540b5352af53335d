"""Groups of elements: integrals of congruent cells are shared, gradients are those of values."""

from collections.abc import Callable

import numpy as np
import pytest

from covers.approximation.mesh_manifold import mesh_manifold
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Monomials
from covers.mathematical.base import Cover
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats
from integration.polygons import Polygons

from ..manifolds import SQUARE, bounds, distorted, model, triangles


def far(regions: Polygons, away: float) -> Polygons:
    return Polygons.from_vertices([regions.points + away])


@pytest.mark.parametrize(
    ("lay", "away", "within"),
    [
        (lambda box: Triangles.regular(box, 0.1, angle=0.4), 0.0, 1e-13),
        (lambda box: MovingLeastSquares.regular(box, 0.1, degree=0), 0.0, 1e-13),
        # Discs of two spacings just touch cells two away, or just do not: rounding says, and places
        # that are rounded to 1e-11 of 0.1 move no entry by more than some 1e-9.
        (lambda box: MovingLeastSquares.regular(box, 0.1, degree=1), 1e5, 1e-9),
    ],
)
def test_congruent_cells_share_their_integrals_and_give_the_same_matrices(
    lay: Callable[[Floats], Cover], away: float, within: float
) -> None:
    square = far(SQUARE, away)
    cover = lay(bounds(square))
    pieces = cut(cover, square)
    manifold = mesh_manifold(cover, pieces, Monomials(1))
    group = manifold.groups[0]
    assert group.n_shapes < 0.6 * len(group.elements)
    object.__setattr__(cover, "cell_shape", np.full(len(cover.cell_shape), -1))
    alone = mesh_manifold(cover, pieces, Monomials(1))
    assert alone.groups[0].n_shapes == len(group.elements)
    for name in ("stiffness", "mass"):
        one, other = (getattr(model(item), name) for item in (manifold, alone))
        assert abs(one - other).max() < within * abs(other).max(), name


def test_gradients_are_differences_of_values_in_polynomial_and_quadrature_groups() -> None:
    for manifold in (triangles(2), distorted()):
        unknowns = np.random.default_rng(3).normal(size=manifold.n_unknowns)
        element = np.arange(0, len(manifold.elements), 5)
        point, step = manifold.elements.centroids[element], 1e-6
        index, rows = manifold.gradient_rows(element, point)
        gradient = np.einsum("mcjl,ml->mcj", rows, unknowns[index])
        for axis in range(2):
            way = step * np.eye(2)[axis]
            ahead = manifold.rows(element, point + way).apply(unknowns)
            behind = manifold.rows(element, point - way).apply(unknowns)
            difference = (ahead - behind) / (2 * step)
            # Truncation step^2 times third derivatives (about 1e2 / size^2) and rounding / step.
            np.testing.assert_allclose(gradient[:, :, axis], difference, rtol=1e-5, atol=1e-5)
