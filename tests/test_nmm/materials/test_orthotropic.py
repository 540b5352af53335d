"""Orthotropic elasticity: pull off its axes against the closed form, isotropy, refusals."""

import numpy as np
import pytest

import nmm
from nmm.errors import FormulationError
from nmm.materials.elastic import Elastic
from nmm.materials.orthotropic import Orthotropic
from nmm.testing.laws import check_law

DEGREE = np.pi / 180
E1, E2, NU, G = 12e9, 0.9e9, 0.38, 0.7e9


def test_it_keeps_what_every_law_must():
    check_law(Orthotropic(E1, NU, E2, G, 0.4, 2e9, 0.2, 0.3), strains=(1e-3,))


@pytest.mark.parametrize("plane", ["stress", "strain"])
@pytest.mark.parametrize("angle", [0.0, 0.7])
def test_equal_moduli_are_isotropic_at_any_angle(plane, angle):
    law = Orthotropic(1e9, 0.3, 1e9, 1e9 / 2.6, angle)
    expected = Elastic(1e9, 0.3).stiffness(plane)
    np.testing.assert_allclose(law.stiffness(plane), expected, rtol=1e-12, atol=1e-3)


@pytest.mark.parametrize("degrees", [0, 15, 45, 80, 90, -30])
def test_pull_off_the_axes_gives_lekhnitskiis_modulus(degrees):
    # 1/E = c^4/E1 + (1/G - 2 nu/E1) s^2 c^2 + s^4/E2, and shear by mutual influence.
    angle = degrees * DEGREE
    c, s = np.cos(angle), np.sin(angle)
    strain = np.linalg.solve(Orthotropic(E1, NU, E2, G, angle).stiffness("stress"), [1, 0, 0])
    mixed = 1 / G - 2 * NU / E1
    assert strain[0] == pytest.approx(c**4 / E1 + mixed * s**2 * c**2 + s**4 / E2, rel=1e-12)
    sheared = (2 / E1 + 2 * NU / E1 - 1 / G) * s * c**3 - (2 / E2 + 2 * NU / E1 - 1 / G) * s**3 * c
    # Axis 1 lies at +angle from the pull; Jones (1975) turns the other way about.
    assert strain[2] == pytest.approx(sheared, rel=1e-12, abs=1e-25)


def test_plane_strain_is_held_along_the_third_axis():
    law = Orthotropic(E1, NU, E2, G, 0.0, 2e9, 0.2, 0.3)
    solid = np.array(
        [
            [1 / E1, -NU / E1, -0.2 / E1],
            [-NU / E1, 1 / E2, -0.3 / E2],
            [-0.2 / E1, -0.3 / E2, 5e-10],
        ]
    )
    expected = np.linalg.inv(solid)[:2, :2]
    np.testing.assert_allclose(law.stiffness("strain")[:2, :2], expected, rtol=1e-12)


SCENE = """
plane = "stress"
[materials.wood]
law = "orthotropic"
young_modulus = "12 GPa"
poisson_ratio = 0.38
young_modulus_2 = "0.9 GPa"
shear_modulus = "0.7 GPa"
axis_angle = "30 deg"
[[blocks]]
name = "strip"
material = "wood"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "left"
point = [0, 0]
fix = ["x", "y"]
[[supports]]
name = "right"
point = [2, 0]
fix = ["y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = ["1 MPa", 0]
[[loads]]
name = "back"
kind = "edge"
segment = [[0, 0], [0, 1]]
traction = ["-1 MPa", 0]
[[monitors]]
name = "end"
point = [2, 0]
"""


@pytest.mark.parametrize("cover", ['type = "block"', 'type = "triangles"\nsize = 0.5'])
def test_a_strip_of_wood_lengthens_by_lekhnitskiis_modulus(cover):
    run = nmm.run(nmm.parse_scene(SCENE + f"[formulation.cover]\n{cover}\n"))
    c, s = np.cos(30 * DEGREE), np.sin(30 * DEGREE)
    soft = c**4 / E1 + (1 / G - 2 * NU / E1) * s**2 * c**2 + s**4 / E2
    assert run.history["monitor:end:ux"][-1] == pytest.approx(2e6 * soft, rel=1e-6)


def test_ratios_that_give_energy_are_refused():
    with pytest.raises(FormulationError, match="energy is positive"):
        Orthotropic(1e9, 0.9, 2e9, 1e9)


def test_a_scene_without_a_modulus_is_refused_by_line():
    text = SCENE.replace('shear_modulus = "0.7 GPa"\n', "")
    with pytest.raises(nmm.errors.NmmError, match="no shear_modulus"):
        nmm.run(nmm.parse_scene(text, "wood.toml"))
