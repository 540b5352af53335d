"""Images of scenes: units of every number, and faults that images of small scenes have shown."""

import tomllib

import pytest

from nmm.errors import NmmError
from nmm.scene import parse_scene
from nmm.scene.units import COMMON
from nmm.stepping.run import run
from nmm.verification.hard.cases.units import factor, in_units, units_of
from nmm.verification.hard.spoilt.sound_files import minimal

LENGTH, FORCE = 1e3, 7.0


@pytest.fixture(scope="module")
def registry():
    """Units of pint, a millimetre and a seventh of a newton among them."""
    import pint

    found = pint.UnitRegistry()
    found.define("long = 1e-3 meter")
    found.define("strong = newton / 7")
    return found


@pytest.mark.parametrize("unit", [unit for unit in COMMON if unit not in ("1", "rad", "rad/s")])
def test_the_factor_of_a_unit_is_that_of_its_dimensions(unit, registry):
    """In units of mm and 1/7 N, and seconds and kelvins: numbers by pint."""
    bases = {"[length]": "long", "[mass]": "strong * second**2 / long"}
    bases |= {"[time]": "second", "[temperature]": "kelvin"}
    quantity = registry.Quantity(1.0, unit)
    made = registry.Quantity(1.0, "")
    for dimension, power in quantity.dimensionality.items():
        made = made * registry.Quantity(1.0, bases[dimension]) ** power
    assert factor(unit, units_of(LENGTH, FORCE)) == pytest.approx(
        quantity.to(made.units).magnitude, rel=1e-12
    )


@pytest.mark.parametrize("name", sorted(minimal()))
def test_a_scene_in_other_units_and_back_is_the_scene(name):
    scene = in_units(tomllib.loads(minimal()[name]), 1.0, 1.0)
    # Powers of two change no digit.
    back = in_units(in_units(scene, 2.0**10, 2.0**-6), 2.0**-10, 2.0**6)
    assert back == scene


def test_a_field_that_comes_to_rest_leaves_a_scene_in_equilibrium():
    """Seepage settles within a quarter of the run; rounding is no load that a free part feels."""
    found = run(parse_scene(minimal()["seeping"]))
    assert found.summary.status == "converged", found.summary.sentence
    assert found.history["load_factor"][-1] == pytest.approx(1.0, abs=1e-12)
    assert found.history["residual"].max() < 1e-8
    # Effective stress follows the heads, which the first step has brought within 1e-2 of rest.
    energy = found.history["strain_energy"]
    assert energy[5:] == pytest.approx(energy[-1], rel=1e-6)


STILL = """plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
hydraulic_conductivity = 1e-6
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "s"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[seepage]
[[heads]]
name = "lake"
segment = [[0, 0], [0, 1]]
head = {head}
[formulation.cover]
type = "quads"
size = 0.3
degree = 1
"""


@pytest.mark.parametrize("head", [3.0, 13000.0])
def test_water_at_rest_is_in_balance(head):
    """One head holds all: nothing flows, and what is left of the exchange is rounding."""
    found = run(parse_scene(STILL.format(head=head)))
    assert found.summary.status == "converged", found.summary.sentence
    assert found.summary.audits["field_imbalance"] < 1e-8


def test_spoilt_numbers_of_a_unit_are_refused_as_before():
    with pytest.raises(NmmError, match="s.head|head"):
        parse_scene(STILL.format(head='"3 kg"'))
