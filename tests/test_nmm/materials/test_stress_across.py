"""An initial stress across the plane: it takes part in the yield, and changes nothing before it."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing.scenes import biaxial_test
from nmm.verification.text import fixed_edge

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


@pytest.mark.parametrize(
    ("plane", "law"),
    [
        ("stress", 'law = "von_mises"\nyield_stress = 1e6'),
        ("strain", 'law = "maxwell"\nviscosity = 1e15'),
    ],
)
def test_it_is_refused_where_nothing_would_know_of_it(plane, law):
    """Matter that creeps went on as if it had the stress of elastic matter across."""
    text = f'plane = "{plane}"\nduration = 1.0\n' if plane == "strain" else 'plane = "stress"\n'
    text += f"[materials.salt]\n{law}\nyoung_modulus = 1e10\npoisson_ratio = 0.25\n"
    text += '[[blocks]]\nname = "b"\nmaterial = "salt"\nvertices = [[0, 0], [1, 0], [1, 1]]\n'
    text += fixed_edge("foot", ((0, 0), (1, 0)))
    text += f'[[initial_stresses]]\nblock = "all"\nstress = [-1e5, -1e5, 0]\n{ACROSS}\n'
    with pytest.raises(SceneError, match=r"initial_stresses.*across: .*remove it"):
        nmm.run(nmm.parse_scene(text, "salt.toml"))


def test_without_it_the_stress_across_is_that_of_elastic_matter():
    run = biaxial(across="")
    matter = run.stepper.model.matter
    stress = np.tile([-1e5, -1e5, 0.0], (len(matter.law), 1))
    start = matter.prestressed(matter.start(), stress, np.full(len(matter.law), np.nan))
    assert not start["plastic_strain"].any()
    assert run.summary.status == "converged"
