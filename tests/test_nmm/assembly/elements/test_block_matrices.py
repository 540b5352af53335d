"""Block matrices from the general path; Shi's closed forms themselves are benchmark A0b."""

import numpy as np
import pytest

from covers.approximation.block_manifold import block_manifold
from covers.approximation.uncut import uncut
from covers.local_functions.polynomials import Monomials, RigidStrain
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.materials.elastic import Elastic

RECTANGLE = np.array([[3.0, 1.0], [5.0, 1.0], [5.0, 2.0], [3.0, 2.0]])
TRIANGLE = np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 2.0]])


def model(vertices: Floats, degree: int | None = None, density: float = 2.0) -> Model:
    functions = RigidStrain() if degree is None else Monomials(degree)
    polygons = Polygons.from_vertices([vertices])
    manifold = block_manifold(polygons, np.zeros(1, dtype=np.int64), functions)
    law = Elastic(10.0, 0.25)
    return Model(
        manifold,
        law.stiffness("stress")[None],
        np.array([density]),
        np.array([10.0]),
        0.5,
        uncut(manifold),
    )


def test_block_basis_is_a_combination_of_plain_polynomials() -> None:
    # G of `RigidStrain` with the monomials' scale: K_DDA = G^T K_NMM G exactly (theory 1.6).
    plain, block = model(TRIANGLE, degree=1), model(TRIANGLE)
    length = np.hypot(3.0, 2.0) / 2
    to_unscaled = np.diag([1, 1, length, length, length, length])
    combination = RigidStrain().combination
    for name in ("stiffness", "mass"):
        matrix = getattr(plain, name).toarray()
        expected = combination.T @ to_unscaled @ matrix @ to_unscaled @ combination
        found = getattr(block, name).toarray()
        np.testing.assert_allclose(found, expected, atol=1e-13 * np.abs(expected).max())


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_rigid_motions_strain_nothing_whatever_the_degree(degree: int) -> None:
    one = model(TRIANGLE, degree)
    force = one.stiffness @ one.manifold.rigid_modes.toarray()
    np.testing.assert_allclose(force, 0, atol=1e-13 * np.abs(one.stiffness.data).max())


def test_strain_energy_of_a_quadratic_field_is_the_exact_integral() -> None:
    # u = x^2 on the rectangle about its centroid: eps = 2 x, energy = 1/2 t D11 int 4 x^2.
    one = model(RECTANGLE, degree=2)
    length = np.hypot(2.0, 1.0) / 2
    unknowns = np.zeros(12)
    unknowns[6] = length**2
    energy = 0.5 * unknowns @ one.stiffness @ unknowns
    stiffness = Elastic(10.0, 0.25).stiffness("stress")[0, 0]
    assert energy == pytest.approx(0.5 * 0.5 * stiffness * 4 * (8.0 / 12), rel=1e-13)


def test_body_load_and_stress_load_are_area_times_density_and_stress() -> None:
    one = model(TRIANGLE)
    load = one.body_load(np.array([[7.0, -3.0]]))
    np.testing.assert_allclose(load, [0.5 * 3 * 7, -0.5 * 3 * 3, 0, 0, 0, 0], atol=1e-13)
    inner = one.stress_load(np.array([[1.0, 2.0, 3.0]]))
    np.testing.assert_allclose(inner, [0, 0, 0, 1.5, 3.0, 4.5], atol=1e-13)


def test_plane_strain_stiffness_is_hookes_law_in_three_dimensions() -> None:
    e, nu = 10.0, 0.25
    lame, shear = e * nu / (1 + nu) / (1 - 2 * nu), e / 2 / (1 + nu)
    expected = [[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]]
    np.testing.assert_allclose(Elastic(e, nu).stiffness("strain"), expected, rtol=1e-14)
