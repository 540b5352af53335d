"""An initial stress across the plane: it takes part in the yield, and changes nothing before it."""

import numpy as np
import pytest

import nmm
from nmm.testing.scenes import biaxial_test

ACROSS = "across = -1e5"
SMALL = '[formulation.loading]\nincrement = 0.05\n[formulation.rotation]\nupdate = "small"\n'


def biaxial(psi=0, across=ACROSS):
    """Run a biaxial test of one block that is under its side pressure all around from the start."""
    start = f'[[initial_stresses]]\nblock = "all"\nstress = [-1e5, -1e5, 0]\n{across}\n'
    return nmm.run(nmm.parse_scene(biaxial_test(psi, start + SMALL)))


@pytest.mark.parametrize(("psi", "widening"), [(0, 0.0166339746), (10, 0.02291751441)])
def test_soil_under_even_pressure_yields_and_widens_as_in_closed_form(psi, widening):
    """``s_y = 369.282032 kPa``; supports give way by 4e-4 of the way."""
    run = biaxial(psi)
    assert run.history["monitor:side:ux"][-1] == pytest.approx(widening, rel=5e-4)
    assert -run.frames[-1].stress[:, 1].mean() == pytest.approx(369282.032, rel=1e-5)
    assert run.state.history["stress_zz"].mean() == pytest.approx(-167320.508, rel=1e-5)


def test_without_it_the_stress_across_is_that_of_elastic_matter():
    run = biaxial(across="")
    matter = run.stepper.model.matter
    stress = np.tile([-1e5, -1e5, 0.0], (len(matter.law), 1))
    start = matter.prestressed(matter.start(), stress, np.full(len(matter.law), np.nan))
    assert not start["plastic_strain"].any()
    assert run.summary.status == "converged"
