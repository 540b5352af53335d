"""The stress across the plane in frames, and von Mises' stress with it: closed forms."""

import numpy as np
import pytest

import nmm
from nmm.materials.orthotropic import Orthotropic
from nmm.outputs.stresses import von_mises
from nmm.study.samples import fields
from nmm.testing.scenes import salt_block
from nmm.verification.text import fixed_edge

E, NU, ALPHA, RISE, YIELD = 200e9, 0.3, 1e-5, 40.0, 250e6
STEEL = f"young_modulus = {E}\npoisson_ratio = {NU}\n"
YIELDS = f'law = "von_mises"\nyield_stress = {YIELD}\n'
WOOD = (
    f'law = "orthotropic"\nyoung_modulus = {E}\npoisson_ratio = 0.25\nyoung_modulus_2 = 5e10\n'
    "shear_modulus = 2e10\nyoung_modulus_3 = 8e10\npoisson_ratio_13 = 0.1\n"
    'poisson_ratio_23 = 0.2\naxis_angle = "30 deg"\n'
)
ROLLERS = fixed_edge("foot", ((0, 0), (1, 0)), "y") + fixed_edge("left", ((0, 0), (0, 1)), "x")
SIDES = {
    "foot": ((0, 0), (1, 0)),
    "left": ((0, 0), (0, 1)),
    "top": ((0, 1), (1, 1)),
    "right": ((1, 0), (1, 1)),
}
WALLS = "".join(fixed_edge(name, side) for name, side in SIDES.items())
HOT = f'[heat]\n[[temperatures]]\nname = "hot"\nblock = "b"\ntemperature = {RISE}\n'
UNDER = '[[initial_stresses]]\nblock = "b"\nstress = [-1e6, -3e6, 5e5]\n'
CELL = (
    '[formulation.cover]\ntype = "quads"\nsize = 1.0\ndegree = 1\n'
    '[formulation.supports]\nmethod = "lagrange"\n'
)
SMALL = '[formulation.rotation]\nupdate = "small"\n'


def pressed(way):
    """Supports of a square that is pressed by ``way`` between smooth plates, free at its right."""
    top = '[[supports]]\nname = "top"\nsegment = [[0, 1], [1, 1]]\nfix = ["y"]\n'
    return f"{ROLLERS}{top}displacement = [0, {-way}]\n"


def square(matter, more, plane="strain", form=SMALL, out=None):
    """Run a square of 1 m."""
    scene = nmm.parse_scene(
        f'plane = "{plane}"\n[materials.m]\nthermal_expansion = {ALPHA}\nconductivity = 50\n'
        f'{matter}\n[[blocks]]\nname = "b"\nmaterial = "m"\n'
        'vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[output]\nquantities = ["von_mises"]\n'
        f"{more}\n{CELL}{form}"
    )
    return nmm.run(scene, out=out)


def measured(run):
    """Stress (3,), that across and von Mises' stress of the square at the end."""
    last = run.frames[-1]
    return (
        last.stress[0],
        last.fields["stress_zz"].values[0],
        last.fields["von_mises"].values[0],
    )


@pytest.mark.parametrize("matter", [STEEL, STEEL + YIELDS], ids=["elastic", "plastic"])
def test_elastic_matter_between_plates_has_nu_of_the_sum_across(matter):
    stress, across, mises = measured(square(matter, pressed(1e-4)))
    push = E / (1 - NU**2) * 1e-4
    np.testing.assert_allclose(stress, [0, -push, 0], atol=1e-9 * push)
    assert across == pytest.approx(-NU * push, rel=1e-9)
    assert mises == pytest.approx(push * np.sqrt(1 - NU + NU**2), rel=1e-9)


def test_matter_that_yields_in_plane_strain_shows_its_yield_stress():
    """Without the stress across it showed up to 2 / sqrt(3) f.

    Backward Euler's returns end on the surface, whatever the way there.
    """
    run = square(STEEL + YIELDS, pressed(2e-2))
    stress, across, mises = measured(run)
    assert mises == pytest.approx(YIELD, rel=1e-9)
    assert von_mises(stress[None])[0] == pytest.approx(2 / np.sqrt(3) * YIELD, rel=1e-3)
    assert stress[1] ** 2 - stress[1] * across + across**2 == pytest.approx(YIELD**2, rel=1e-9)


def test_plane_stress_shows_none_across():
    run = square(STEEL + YIELDS, pressed(2e-2), "stress")
    assert "stress_zz" not in run.frames[-1].fields
    assert run.frames[-1].fields["von_mises"].values == pytest.approx(YIELD, rel=1e-9)


@pytest.mark.parametrize("matter", [STEEL, STEEL + YIELDS], ids=["elastic", "plastic"])
def test_heat_that_is_held_all_around_presses_alike_in_all_directions(matter):
    """``-E alpha T / (1 - 2 nu)``, which no yield of von Mises feels."""
    stress, across, mises = measured(square(matter, WALLS + HOT))
    push = -E * ALPHA * RISE / (1 - 2 * NU)
    np.testing.assert_allclose([*stress, across], [push, push, 0, push], atol=-1e-9 * push)
    assert mises == pytest.approx(0, abs=-1e-7 * push)


def test_wood_has_the_stress_across_of_its_compliance():
    """Held in the plane and heated: ``sigma = -C alpha T (1, 1, 1)`` of the whole matrix ``C``."""
    _, across, _ = measured(square(WOOD, WALLS + HOT))
    n1, n2, n3 = E, 5e10, 8e10
    solid = np.array(
        [
            [1 / n1, -0.25 / n1, -0.1 / n1],
            [-0.25 / n1, 1 / n2, -0.2 / n2],
            [-0.1 / n1, -0.2 / n2, 1 / n3],
        ]
    )
    stress = -np.linalg.solve(solid, np.full(3, ALPHA * RISE))
    assert across == pytest.approx(stress[2], rel=1e-8)


def test_the_share_of_wood_is_minus_its_compliance_across_in_turned_axes():
    """A stress along axis 1 at 30 degrees raises ``nu_13 E_3 / E_1`` of itself across."""
    law = Orthotropic(E, 0.25, 5e10, 2e10, np.pi / 6, 8e10, 0.1, 0.2)
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    along = np.array([c * c, s * s, c * s])
    assert law.across_share("strain") @ along == pytest.approx(0.1 * 8e10 / E, rel=1e-12)
    assert not law.across_share("stress").any()


@pytest.mark.parametrize("matter", [STEEL, STEEL + YIELDS], ids=["elastic", "plastic"])
@pytest.mark.parametrize(("given", "expected"), [("", -1.2e6), ("across = -2e6\n", -2e6)])
def test_initial_stress_is_shown_across_from_the_first_frame(matter, given, expected):
    run = square(matter, WALLS + UNDER + given)
    for frame in run.frames:
        assert frame.fields["stress_zz"].values[0] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("matter", [STEEL, STEEL + YIELDS], ids=["elastic", "plastic"])
def test_pore_pressure_acts_across_as_well(matter):
    """Ground that nothing strains under a pressure p has ``-b p`` in all directions."""
    wet = "hydraulic_conductivity = 1e-6\nbiot = 0.5\n"
    head = '[seepage]\n[[heads]]\nname = "level"\nsegment = [[0, 1], [1, 1]]\nhead = 100.0\n'
    stress, across, _ = measured(square(matter + wet, WALLS + head))
    assert across == pytest.approx(stress[:2].mean(), rel=1e-9)
    assert across < -4e5


@pytest.mark.parametrize("way", [pytest.param(1e-6, id="small"), pytest.param(0.1, id="finite")])
@pytest.mark.parametrize("law", ["elastic", "neo_hookean"])
def test_in_finite_strain_it_is_that_of_the_potential(law, way):
    """Pressed by a way between plates and walls: lambda times the strain, or ln J, over J."""
    still = pressed(way) + fixed_edge("right", ((1, 0), (1, 1)), "x")
    form = '[formulation.rotation]\nupdate = "finite"\n'
    _, across, _ = measured(square(f'{STEEL}law = "{law}"\n', still, form=form))
    lame = E * NU / (1 + NU) / (1 - 2 * NU)
    volume = 1 - way
    strain = np.log(volume) if law == "neo_hookean" else (volume**2 - 1) / 2
    assert across == pytest.approx(lame * strain / volume, rel=1e-8)


def test_creeping_matter_ends_under_half_of_what_presses_it():
    """Free sideways, nothing strains along z: ``nu p`` at once, and p / 2 once shape has flowed."""
    text = salt_block("maxwell", "viscosity = 4e10", {"press": -1.0}, 'duration = "200 s"\n')
    run = nmm.run(nmm.parse_scene(f"{text}[formulation.integrator]\nstep = 5.0\n"))
    across = [frame.fields["stress_zz"].values[0] for frame in run.frames]
    assert across[-1] == pytest.approx(-5e5, rel=1e-3)


def test_sampled_and_stored_fields_have_it_too(tmp_path):
    run = square(STEEL + YIELDS, pressed(2e-2), out=tmp_path / "run")
    found = fields(run, np.array([[0.3, 0.6]]))
    assert found.mises == pytest.approx(YIELD, rel=1e-9)
    stored = nmm.read_run(tmp_path / "run").frames[-1]
    assert stored.fields["stress_zz"].values == pytest.approx(found.across, rel=1e-9)


def test_matter_that_stays_elastic_under_initial_stress_loses_nothing():
    """Without the stress across at the start ``(nu s)^2 / 2 E`` seemed lost: 3.6 J of 18 done."""
    run = square(STEEL + YIELDS, ROLLERS + UNDER)
    assert run.history["material_loss"][-1] == pytest.approx(0, abs=1e-9)
