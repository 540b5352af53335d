"""The block cover against Shi's closed forms and against plain polynomials."""

import numpy as np
import pytest

from covers.approximation.block_manifold import block_manifold
from covers.local_functions.polynomials import Monomials, Rigid, RigidStrain
from integration.polygons import Polygons

POLYGONS = Polygons.from_vertices(
    [
        np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [2.0, 1.0], [0.0, 3.0]]),
        np.array([[10.0, 1.0], [12.0, 1.5], [11.0, 4.0]]),
    ]
)
REGIONS = np.zeros(2, dtype=np.int64)


def test_mass_products_of_the_block_basis_are_shis_closed_form() -> None:
    # Exact moments of the first polygon: area 8, second moments by hand.
    manifold = block_manifold(POLYGONS, REGIONS, RigidStrain())
    group = manifold.groups[0]
    products = group.products()
    c = manifold.body_centroid[0]
    # Unscaled basis (1, x - xc, y - yc): first moments vanish about the centroid.
    assert products[0, 0, 0] == pytest.approx(8.0, rel=1e-14)
    np.testing.assert_allclose(products[:, 0, 1:], 0, atol=1e-13)
    # int x^2 over the polygon: rectangle 4x3 minus triangle (4,3)(2,1)(0,3) of area 4.
    # Its x^2: A (sum of x_i^2 + x_i x_j) / 6 with x = 4, 2, 0.
    second_x = 4**3 * 3 / 3 - 4.0 * (16 + 4 + 0 + 8 + 0 + 0) / 6
    assert products[0, 1, 1] == pytest.approx(second_x - 8.0 * c[0] ** 2, rel=1e-13)


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_displacement_rows_reproduce_a_polynomial_field(degree: int) -> None:
    manifold = block_manifold(POLYGONS, REGIONS, Monomials(degree))
    points = np.array([[1.0, 0.5], [11.0, 2.0]])
    element = np.array([0, 1])
    rows = manifold.rows(element, points)
    # Fit the unknowns to u = x^degree, v = y at many points, then evaluate elsewhere.
    rng = np.random.default_rng(1)
    samples = rng.uniform(-1, 1, (60, 2)) + manifold.body_centroid[np.arange(60) % 2]
    matrix = manifold.rows(np.arange(60) % 2, samples).matrix(manifold.n_unknowns).toarray()
    target = np.stack([samples[:, 0] ** degree, samples[:, 1]], axis=1).ravel()
    unknowns = np.linalg.lstsq(matrix, target, rcond=None)[0]
    expected = np.stack([points[:, 0] ** degree, points[:, 1]], axis=1)
    np.testing.assert_allclose(rows.apply(unknowns), expected, rtol=1e-10)


def test_gradient_rows_are_finite_differences_of_rows() -> None:
    manifold = block_manifold(POLYGONS, REGIONS, Monomials(2))
    unknowns = np.random.default_rng(2).normal(size=manifold.n_unknowns)
    point, element, h = np.array([[1.0, 0.7]]), np.array([0]), 1e-6
    index, values = manifold.gradient_rows(element, point)
    gradient = np.einsum("mcjl,ml->mcj", values, unknowns[index])[0]
    for axis in range(2):
        step = np.eye(2)[axis] * h
        ahead = manifold.rows(element, point + step).apply(unknowns)
        behind = manifold.rows(element, point - step).apply(unknowns)
        # Central differences of a quadratic are exact but for rounding / h.
        np.testing.assert_allclose(gradient[:, axis], ((ahead - behind) / 2 / h)[0], atol=1e-8)


@pytest.mark.parametrize("functions", [Monomials(1), Monomials(2), RigidStrain(), Rigid()])
def test_rigid_modes_are_translations_and_the_linear_rotation(
    functions: Monomials | RigidStrain | Rigid,
) -> None:
    manifold = block_manifold(POLYGONS, REGIONS, functions)
    points = np.array([[1.0, 0.5], [11.0, 2.0]])
    rows = manifold.rows(np.array([0, 1]), points)
    arm = points - manifold.body_centroid
    modes = manifold.rigid_modes.toarray()
    for body in range(2):
        fields = [[1, 0], [0, 1], [-arm[body, 1], arm[body, 0]]]
        for mode in range(3):
            displacement = rows.apply(modes[:, 3 * body + mode])
            np.testing.assert_allclose(displacement[body], fields[mode], atol=1e-13)
            np.testing.assert_allclose(displacement[1 - body], 0, atol=1e-13)


def test_degree_out_of_range_is_refused_with_the_remedy() -> None:
    with pytest.raises(ValueError, match="degree: 4: expected 0, 1, 2 or 3: choose one"):
        Monomials(4)
