"""Water tables that rise and fall in ground that drains."""

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError
from nmm.formulation import Formulation
from nmm.scene.read import parse_scene
from nmm.verification.problems.water.ditches import slope_at_ditch

WEIGHT = 9810.0
BOX = """
title = "box"
plane = "strain"
[materials.sand]
young_modulus = 1e8
poisson_ratio = 0.3
hydraulic_conductivity = 1e-3
specific_storage = 1e-9
drainable_porosity = {porosity}
[[blocks]]
name = "box"
material = "sand"
vertices = [[0, 0], [0.25, 0], [0.25, 6], [0, 6]]
[[supports]]
name = "held"
block = "box"
fix = ["x", "y"]
[seepage]
transient = true
free_surface = true
initial = 2.0
duration = {duration}
{inflow}
"""
INFLOW = """
[[inflows]]
name = "below"
segment = [[0, 0], [0.25, 0]]
velocity = {velocity}
"""


def run(text, degree=1, **more):
    table = {
        "cover": {"type": "quads", "size": 0.25, "degree": degree},
        "loading": {"increment": 0.1},
    }
    return nmm.run(parse_scene(text, "scene.toml"), Formulation.model_validate(table | more))


@pytest.mark.parametrize("degree", [0, 1])
def test_water_that_stands_stays_where_it_is(degree):
    found = run(BOX.format(porosity=0.2, duration=1e4, inflow=""), degree)
    # At the bottom; hanging water is fitted by functions of a cell.
    assert found.history["seepage:highest"] == pytest.approx(2.0 * WEIGHT, rel=0.02)
    assert np.abs(found.history["seepage:stored"]).max() < 1e-9


@pytest.mark.parametrize("porosity", [0.1, 0.3])
@pytest.mark.parametrize("velocity", [1e-6, -1e-6])
def test_a_table_rises_by_the_water_that_came_over_the_drainable_porosity(porosity, velocity):
    duration = porosity / 1e-6  # one metre up or down
    inflow = INFLOW.format(velocity=velocity)
    found = run(BOX.format(porosity=porosity, duration=duration, inflow=inflow))
    pressure = found.history["seepage:highest"]
    rise = (pressure[-1] - pressure[0]) / WEIGHT
    # From the end of the first of ten steps; what flows in takes v / k = 1e-3 of the depth.
    assert rise == pytest.approx(np.sign(velocity) * (1 - 1 / 10), abs=2e-3)
    volume = found.history["seepage:stored"][-1]
    assert volume == pytest.approx(0.25 * velocity * duration, rel=1e-8)


def test_the_similar_solution_is_that_of_the_linear_equation_for_small_changes():
    # erfc for a change of a thousandth: u' = -2 / sqrt(pi) of the change, at a level of one.
    slope = slope_at_ditch(1 - 1e-3)
    assert slope == pytest.approx(-1e-3 * 2 / np.sqrt(np.pi), rel=1e-3)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("drainable_porosity = 0.2\n", "", "drainable_porosity"),
        ("transient = true", "transient = true\ncoupled = true", "free_surface"),
    ],
)
def test_what_a_moving_surface_lacks_is_refused_by_line(old, new, said):
    text = BOX.format(porosity=0.2, duration=1e4, inflow="")
    assert old in text
    with pytest.raises(NmmError, match=rf"scene\.toml.*{said}"):
        run(text.replace(old, new))


def test_flows_at_the_start_of_steps_are_refused():
    with pytest.raises(NmmError, match="theta"):
        run(BOX.format(porosity=0.2, duration=1e4, inflow=""), diffusion={"theta": 0.5})
