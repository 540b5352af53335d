"""Stages whose heat and water are others: closed forms stage by stage, energies, faults by line."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError

HEAD = """
title = "plate"
plane = "stress"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.25
conductivity = 2.0
thermal_expansion = 1e-5
hydraulic_conductivity = 1e-6
density = 2000
heat_capacity = 1000
[[blocks]]
name = "plate"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x"]
[[supports]]
name = "corner"
point = [0, 0]
fix = ["y"]
[[monitors]]
name = "right"
point = [2, 0.5]
[formulation.cover]
type = "quads"
size = 0.5
degree = 1
"""
HEAT = """
[heat]
{heat}
[[temperatures]]
name = "left"
segment = [[0, 0], [0, 1]]
temperature = {left}
[[temperatures]]
name = "warm"
segment = [[2, 0], [2, 1]]
temperature = 30
[[heat_fluxes]]
name = "sun"
segment = [[2, 0], [2, 1]]
flux = 20
[[stages]]
name = "cold"
heat = ["left"]
[[stages]]
name = "warm"
heat = ["warm"]
[[stages]]
name = "still warm"
[[stages]]
name = "in the sun"
heat = ["left", "sun"]
"""


def test_temperatures_of_stages_stretch_a_plate_each_as_its_own():
    found = nmm.run(nmm.parse_scene(HEAD + HEAT.format(heat="", left=10)))
    assert found.summary.status == "converged"
    # Free to expand: alpha times the temperature times the length. The sun adds q x / k.
    even = np.array([10, 30, 30])
    np.testing.assert_allclose(found.history["monitor:right:ux"][:3], 2e-5 * even, rtol=1e-6)
    np.testing.assert_allclose(found.history["heat:highest"], [*even, 10 + 20 * 2 / 2.0], rtol=1e-9)
    np.testing.assert_allclose(found.history["heat:lowest"], [*even, 10], rtol=1e-9)


def test_heat_that_is_stored_goes_on_from_stage_to_stage():
    heat = 'transient = true\nduration = "2 h"'
    text = HEAD + "[formulation.loading]\nincrement = 0.05\n" + HEAT.format(heat=heat, left=0)
    text = text[: text.index('[[stages]]\nname = "still')].replace('["warm"]', '["sun"]')
    found = nmm.run(nmm.parse_scene(text.replace('heat = ["left"]', "heat = []"))).history
    # Two hours without any heat, then two of a flux that nothing lets out: q A t.
    assert found["time"][-1] == 2.0
    np.testing.assert_allclose(found["heat:stored"][found["time"] <= 1], 0, atol=1e-6)
    assert found["heat:stored"][-1] == pytest.approx(20 * 1 * 7200, rel=1e-9)


WATER = """
[seepage]
[[heads]]
name = "dry"
block = "plate"
head = 0
gradient = [0, 1]
[[heads]]
name = "wet"
block = "plate"
head = {head}
gradient = [0, 1]
[[water_pressures]]
name = "lake"
segment = [[2, 0], [2, 1]]
pressures = ["10 kPa", "10 kPa"]
[[stages]]
name = "drained"
water = ["dry"]
[[stages]]
name = "lake"
water = ["dry", "lake"]
[[stages]]
name = "pores under pressure"
water = ["wet"]
"""


def test_water_of_stages_presses_and_fills_pores_each_as_its_own():
    found = nmm.run(nmm.parse_scene(HEAD + WATER.format(head=10e3 / 9810)))
    assert found.summary.status == "converged"
    # 10 kPa on the right face; then as much in all pores, which stretch it by (1 - 2 nu) p / E.
    expected = [0, -2 * 10e3 / 1e9, 2 * 0.5 * 10e3 / 1e9]
    found = found.history["monitor:right:ux"]
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-12)


def test_a_name_that_no_table_of_heat_has_is_refused_by_line():
    text = HEAD + HEAT.format(heat="", left=10).replace('heat = ["warm"]', 'heat = ["warn"]')
    with pytest.raises(SceneError, match=r'plate\.toml:\d+.*"warn".*temperatures'):
        nmm.parse_scene(text, "plate.toml")
