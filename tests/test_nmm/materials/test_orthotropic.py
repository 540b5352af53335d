"""Orthotropic elasticity: pull off its axes against the closed form, isotropy, refusals."""

import numpy as np
import pytest

import nmm
from nmm.errors import FormulationError
from nmm.materials.elastic import Elastic
from nmm.materials.orthotropic import Orthotropic
from nmm.testing.laws.materials import check_law

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


@pytest.mark.parametrize("degrees", [0.0, 30.0])
def test_heated_wood_widens_by_what_its_third_axis_held_adds_to_each_other(degrees):
    """Free in the plane, held across: stress 3 is -E3 a t, strains a t (1 + nu_i3 E3 / Ei)."""
    third = 'young_modulus_3 = "2 GPa"\npoisson_ratio_13 = 0.2\npoisson_ratio_23 = 0.3\n'
    heated = third + f'thermal_expansion = 1e-5\nconductivity = 1.0\naxis_angle = "{degrees} deg"'
    text = SCENE[: SCENE.index("[[loads]]")] + SCENE[SCENE.index("[[monitors]]") :]
    text = text.replace('axis_angle = "30 deg"', heated).replace('"stress"', '"strain"')
    text += '[heat]\n[[temperatures]]\nname = "warm"\nblock = "strip"\ntemperature = 10.0\n'
    run = nmm.run(nmm.parse_scene(text + '[formulation.cover]\ntype = "triangles"\nsize = 0.5\n'))
    own = 1e-4 * np.array([1 + 0.2 * 2e9 / E1, 1 + 0.3 * 2e9 / E2])
    c, s = np.cos(degrees * DEGREE), np.sin(degrees * DEGREE)
    assert run.history["monitor:end:ux"][-1] / 2 == pytest.approx(own @ [c * c, s * s], rel=1e-9)
    assert np.abs(run.frames[-1].stress).max() < 1e-9 * E2 * 1e-4


def test_cracks_that_grow_in_wood_are_refused_by_line():
    """Found by fields of isotropic matter, intensities were 1.03 to 1.7 times what they are."""
    text = SCENE + "[fracture]\ntoughness = 1e6\nincrement = 0.1\n"
    text += '[[cracks]]\nname = "notch"\npoints = [[1, -0.1], [1, 0.5]]\n'
    text += '[formulation.cover]\ntype = "triangles"\nsize = 0.1\n'
    with pytest.raises(nmm.errors.SceneError, match=r"wood.toml:4: .*\[fracture\]"):
        nmm.run(nmm.parse_scene(text, "wood.toml"))


def test_ratios_that_give_energy_are_refused():
    with pytest.raises(FormulationError, match="energy is positive"):
        Orthotropic(1e9, 0.9, 2e9, 1e9)


def test_a_scene_without_a_modulus_is_refused_by_line():
    text = SCENE.replace('shear_modulus = "0.7 GPa"\n', "")
    with pytest.raises(nmm.errors.NmmError, match="no shear_modulus"):
        nmm.run(nmm.parse_scene(text, "wood.toml"))
