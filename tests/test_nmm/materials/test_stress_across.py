"""An initial stress across the plane: it takes part in the yield, and changes nothing before it."""

import numpy as np
import pytest

import nmm

# PL1: from 100 kPa all around, E = 50 MPa, nu = 0.25, c = 20 kPa, phi = 30, psi = 0.
SCENE = """
title = "biaxial test"
plane = "strain"
[materials.soil]
law = "mohr_coulomb"
young_modulus = 5e7
poisson_ratio = 0.25
cohesion = 2e4
friction_angle = "30 deg"
dilation_angle = "{psi} deg"
[[blocks]]
name = "soil"
material = "soil"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[initial_stresses]]
block = "all"
stress = [-1e5, -1e5, 0]
{across}
[[supports]]
name = "base"
segment = [[0, 0], [1, 0]]
fix = ["y"]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x"]
[[supports]]
name = "top"
segment = [[0, 1], [1, 1]]
fix = ["y"]
displacement = [0, -0.02]
[[loads]]
name = "cell"
kind = "edge"
segment = [[1, 0], [1, 1]]
traction = [-1e5, 0]
[[monitors]]
name = "side"
point = [1.0, 0.5]
[loading]
scaled = ["top"]
[formulation.loading]
increment = 0.05
[formulation.rotation]
update = "small"
"""


def biaxial(psi=0, across="across = -1e5"):
    """Run a biaxial test of one block."""
    return nmm.run(nmm.parse_scene(SCENE.replace("{psi}", str(psi)).replace("{across}", across)))


@pytest.mark.parametrize(("psi", "widening"), [(0, 0.0166339746), (10, 0.02291751441)])
def test_soil_under_even_pressure_yields_and_widens_as_in_closed_form(psi, widening):
    """``s_y = 369.282032 kPa``; supports give way by 4e-4 of the way."""
    run = biaxial(psi)
    assert run.history["monitor:side:ux"][-1] == pytest.approx(widening, rel=5e-4)
    assert -run.frames[-1].stress[:, 1].mean() == pytest.approx(369282.032, rel=1e-5)
    assert run.state.history["stress_zz"].mean() == pytest.approx(-167320.508, rel=1e-5)


def test_without_it_the_stress_across_is_that_of_elastic_matter():
    run = biaxial(across="")
    start = run.stepper.model.matter.prestressed({}, np.array([[-1e5, -1e5, 0.0]]))
    assert set(start) == {"initial_strain"} or len(start) == 1
    assert run.summary.status == "converged"
