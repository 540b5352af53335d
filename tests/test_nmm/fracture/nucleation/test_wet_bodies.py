"""Cracks that begin in bodies whose pores hold water under pressure."""

import numpy as np
import pytest

import nmm

# A head so high that its pressure is even: 1 Pa less a metre of height, of 0.6 MPa.
PRESSURE, STRENGTH, PULL = 0.6e6, 3e6, 4e6
WET = """
plane = "stress"
[materials.m]
young_modulus = 1e10
poisson_ratio = 0.2
hydraulic_conductivity = 1e-8
biot = {biot}
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]
[[supports]]
name = "l"
segment = [[0, 0], [0, 0.5]]
fix = ["x"]
[[supports]]
name = "p"
point = [0, 0]
fix = ["y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[1, 0], [1, 0.5]]
traction = [4e6, 0]
[seepage]
unit_weight = 1.0
[[heads]]
name = "left"
segment = [[0, 0], [0, 0.5]]
head = 0.6e6
[[heads]]
name = "right"
segment = [[1, 0], [1, 0.5]]
head = 0.6e6
[fracture]
toughness = 1e6
increment = 0.05
max_growth = 0.05
[fracture.nucleation]
tensile_strength = 3e6
length = 0.1
number = 1
{more}
[formulation.cover]
type = "quads"
size = 0.11
degree = 1
[formulation.loading]
increment = 0.1
tolerance = 1e-4
"""


@pytest.mark.parametrize("biot", [1.0, 0.6])
@pytest.mark.parametrize(("more", "counted"), [("", PRESSURE), ('stress = "total"', 0.0)])
def test_a_wet_bar_cracks_where_pull_and_pressure_are_its_strength(biot, more, counted):
    run = nmm.run(nmm.parse_scene(WET.format(biot=biot, more=more)))
    share, factor = run.history["fracture:nucleation:share"], run.history["load_factor"]
    begun = np.flatnonzero(np.asarray(share) >= 1 - 1e-3)[0]
    # The bar is free: all of its stress is the pull. Increments are halved to 1 / 128 of 0.1.
    assert factor[begun] == pytest.approx((STRENGTH - counted) / PULL, abs=1e-3)
    assert "fracture:nucleus 1:length" in run.history
