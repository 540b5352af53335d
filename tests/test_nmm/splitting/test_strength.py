"""BlockStrength of blocks: how near to splitting, by what, and along which planes."""

import numpy as np
import pytest

from nmm.materials.principal_stresses import PrincipalStresses
from nmm.splitting.coulomb import CoulombStrength
from nmm.testing import check_strength

CONCRETE = CoulombStrength(2.9e6, 4.7e6, np.radians(37))


@pytest.mark.parametrize(
    "strength",
    [CONCRETE, CoulombStrength(tensile_strength=1e6), CoulombStrength(cohesion=1e6)],
    ids=["both", "tension", "Tresca"],
)
def test_strengths_keep_what_every_one_promises(strength):
    check_strength(strength)


def test_uniform_stress_splits_along_the_plane_normal_to_the_larger_principal_one():
    """(2, -1, 1.5) MPa: s1 = .5 + 1.5 sqrt 2 = 2.6213203436 at 22.5 degrees from x."""
    found = CoulombStrength(tensile_strength=2.5e6).judged(np.array([[2e6, -1e6, 1.5e6]]))
    assert found.use[0] == pytest.approx(2.6213203436 / 2.5, rel=1e-10)
    assert np.degrees(found.planes[0, 0]) % 180 == pytest.approx(112.5, abs=1e-10)
    assert np.isnan(found.planes[0, 1])


def test_compression_alone_reaches_the_strength_of_the_envelope():
    """c = 4.7, phi = 37: fc = 2 c tan(45 + phi/2) = 18.853483 MPa, planes 26.5 degrees off it."""
    found = CONCRETE.judged(np.array([[0.0, -18.853483e6, 0.0]]))
    assert found.use[0] == pytest.approx(1, abs=1e-7)
    assert not found.tension[0]
    np.testing.assert_allclose(np.degrees(found.planes[0]) % 180, [116.5, 63.5], atol=1e-9)


def test_both_limits_passed_is_tension():
    found = CONCRETE.judged(np.array([[3e6, -30e6, 0.0]]))
    assert found.use[0] > 1
    assert found.tension[0]


def test_shear_comes_first_where_it_is_nearer():
    """The middle of a Brazilian disc, (q, -3 q): shear at q = 18.853483 / (3 + 4.022791)."""
    q = 18.853483e6 / (3 + 4.022791)
    found = CONCRETE.judged(np.array([[q, -3 * q, 0.0]]))
    assert not found.tension[0]
    assert found.use[0] == pytest.approx(1, abs=1e-6)


def test_principal_stresses_are_the_eigenvalues():
    rng = np.random.default_rng(1)
    stress = rng.normal(size=(50, 3))
    found = PrincipalStresses.of(stress)
    for (xx, yy, xy), larger, smaller, angle in zip(
        stress, found.larger, found.smaller, found.angle, strict=True
    ):
        values, vectors = np.linalg.eigh([[xx, xy], [xy, yy]])
        assert [smaller, larger] == pytest.approx(values, abs=1e-12)
        assert abs(vectors[:, 1] @ [np.cos(angle), np.sin(angle)]) == pytest.approx(1, abs=1e-12)
