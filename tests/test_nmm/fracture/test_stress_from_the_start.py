"""Cracks under stress that is no strain's: where they begin, and what holds new faces in time."""

import numpy as np
import pytest

import nmm

COOLED = """
plane = "stress"
[materials.m]
young_modulus = 1e10
poisson_ratio = 0.0
thermal_expansion = 1e-5
conductivity = 2.0
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]
[[supports]]
name = "l"
segment = [[0, 0], [0, 0.5]]
fix = ["x"]
[[supports]]
name = "r"
segment = [[1, 0], [1, 0.5]]
fix = ["x"]
[[supports]]
name = "p"
point = [0, 0]
fix = ["y"]
[heat]
[[temperatures]]
name = "t"
block = "b"
temperature = -60
history = [[0, 0], [1, 1]]
{more}
[fracture]
toughness = 1e6
increment = 0.05
max_growth = 0.05
[fracture.nucleation]
tensile_strength = 3e6
length = 0.1
number = 1
[formulation.cover]
type = "quads"
size = 0.11
degree = 1
[formulation.loading]
increment = 0.1
tolerance = 1e-4
"""
STARTED = '[[initial_stresses]]\nblock = "b"\nstress = [{stress}, 0, 0]\n'


@pytest.mark.parametrize("stress", [0.0, 1e6, -1.2e6])
def test_a_bar_between_walls_cracks_as_it_has_cooled_to_its_strength(stress: float) -> None:
    more = STARTED.format(stress=stress) if stress else ""
    run = nmm.run(nmm.parse_scene(COOLED.format(more=more)))
    share, factor = run.history["fracture:nucleation:share"], run.history["load_factor"]
    begun = np.flatnonzero(np.asarray(share) >= 1 - 1e-3)[0]
    # E alpha T + s = f_t at the factor T / 60 K; increments are halved to 1 / 128 of 0.1.
    assert factor[begun] == pytest.approx((3e6 - stress) / (1e10 * 1e-5 * 60), abs=1e-3)
    assert "fracture:nucleus 1:length" in run.history


RUNNING = """
plane = "strain"
duration = "120 us"
[materials.m]
density = 2400
young_modulus = "20 GPa"
poisson_ratio = 0.2
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [0.4, 0], [0.4, 0.4], [0, 0.4]]
[[cracks]]
name = "c"
points = [[-0.01, 0.2], [0.13, 0.2]]
[[initial_stresses]]
block = "b"
stress = [0, "3 MPa", 0]
[[supports]]
name = "u"
segment = [[0, 0.4], [0.4, 0.4]]
fix = ["x", "y"]
[[supports]]
name = "d"
segment = [[0, 0], [0.4, 0]]
fix = ["x", "y"]
[inertia]
[fracture]
toughness = "0.8 MPa m^0.5"
increment = 0.03
[formulation.cover]
type = "quads"
size = 0.0213
degree = 1
[formulation.integrator]
type = "newmark"
step = "1 us"
"""


@pytest.mark.slow
@pytest.mark.xfail(strict=True, reason="7 % less since tips have their own speed: limits")
def test_faces_that_open_in_stressed_ground_take_the_fracture_energy() -> None:
    history = nmm.run(nmm.parse_scene(RUNNING)).history
    assert history["fracture:growth"][-1] == pytest.approx(0.09, rel=1e-3)
    # Three pieces of a fifth of the crack: 0.1 to 2 % on nets of 17 to 21 mm. Held without stress
    # from the start they took 6 to 9 % less.
    assert history["loss:fracture"][-1] == pytest.approx(history["fracture:energy"][-1], rel=0.03)
