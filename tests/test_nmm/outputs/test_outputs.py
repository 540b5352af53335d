"""Outputs: the suite of all, and measures of stress against numbers of hand."""

import numpy as np
import pytest

import nmm
from nmm.outputs.base import OUTPUTS
from nmm.outputs.stresses import principal, von_mises
from nmm.testing import check_output
from nmm.testing.outputs import TWO_BLOCKS

BOND = "bonded = true\ncohesion = 1e3\ntensile_strength = 1e3\nfriction_angle"
BONDED = TWO_BLOCKS.replace("friction_angle", BOND)


@pytest.mark.parametrize("name", OUTPUTS.names())
def test_an_output_keeps_what_every_one_promises(name):
    check_output(OUTPUTS.make(name))


def test_measures_of_simple_states_of_stress():
    # Pull, equal pull, pure shear: f, f, sqrt(3) f (von Mises in plane stress).
    stress = np.array([[3.0, 0.0, 0.0], [3.0, 3.0, 0.0], [0.0, 0.0, 3.0]])
    np.testing.assert_allclose(von_mises(stress), [3.0, 3.0, 3.0 * 3**0.5], rtol=1e-15)
    np.testing.assert_allclose(principal(stress), [[3, 0], [3, 3], [3, -3]], atol=1e-15)


def test_what_outputs_read_changes_no_digit_of_a_run():
    names = ", ".join(f'"{name}"' for name in OUTPUTS.names())
    plain = nmm.run(nmm.parse_scene(BONDED))
    read = nmm.run(nmm.parse_scene(f"{BONDED}[output]\nquantities = [{names}]\n"))
    for name, column in plain.history.items():
        assert np.array_equal(read.history[name], column)
    assert set(read.history) - set(plain.history) == {"crack_opening"}
    assert set(read.frames[-1].fields) == set(OUTPUTS.names())


@pytest.mark.parametrize("contact", ["", "[contact]\n[interfaces.dry]\nfriction_angle = 0\n"])
def test_the_widest_opening_is_that_of_a_pressed_crack_with_contact_or_without(contact):
    """A crack of length 2 a under pressure p opens by 4 p sqrt(a^2 - x^2) (1 - nu^2) / E."""
    text = f"""
    plane = "strain"
    [materials.rock]
    young_modulus = 1e10
    poisson_ratio = 0.25
    [[blocks]]
    material = "rock"
    vertices = [[-5, -5], [5, -5], [5, 5], [-5, 5]]
    [[cracks]]
    name = "slit"
    points = [[-0.5, 0], [0.5, 0]]
    [[water_pressures]]
    name = "pumped"
    crack = "slit"
    pressure = 1e6
    [[supports]]
    name = "left"
    point = [-5, -5]
    fix = ["x", "y"]
    [[supports]]
    name = "right"
    point = [5, -5]
    fix = ["y"]
    {contact}
    [output]
    quantities = ["crack_opening"]
    [formulation.cover]
    type = "quads"
    size = 0.25
    """
    run = nmm.run(nmm.parse_scene(text))
    widest = 4 * 1e6 * 0.5 * (1 - 0.25**2) / 1e10
    # The sides of the plate, ten lengths apart, open it by up to 1 % more, and cells of a quarter
    # of it by half a percent less. The mean over the widest face is 7 % less.
    assert run.history["crack_opening"][-1] == pytest.approx(widest, rel=0.01)
