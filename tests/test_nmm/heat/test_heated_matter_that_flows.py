"""Heat in matter that yields and creeps: closed forms of what is held while it swells."""

import numpy as np
import pytest

import nmm
from nmm.errors import FormulationError, SceneError
from nmm.materials.von_mises import VonMisesPlasticity

E, NU, ALPHA, RISE = 200e9, 0.3, 1e-5, 200.0
YIELD, HARDENS = 250e6, 2e9
STEEL = f'law = "von_mises"\nyield_stress = {YIELD}\nhardening_modulus = {HARDENS}'
COVERS = {
    "quads": 'type = "quads"\nsize = 0.5\ndegree = 1',
    "triangles": 'type = "triangles"\nsize = 0.7\ndegree = 2',
    "constant strain": 'type = "triangles"\nsize = 0.7\ndegree = 0',
}


def held(law, plane, cover="quads", head="", heat="", more=""):
    """A bar that cannot grow longer, free across; heated evenly."""
    return nmm.parse_scene(
        f"""plane = "{plane}"
        {head}
        [materials.m]
        young_modulus = {E}
        poisson_ratio = {NU}
        density = 7800
        conductivity = 50
        thermal_expansion = {ALPHA}
        {law}
        [[blocks]]
        name = "bar"
        material = "m"
        vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
        [[supports]]
        name = "left"
        segment = [[0, 0], [0, 1]]
        fix = ["x"]
        [[supports]]
        name = "right"
        segment = [[2, 0], [2, 1]]
        fix = ["x"]
        [[supports]]
        name = "down"
        point = [0, 0]
        fix = ["y"]
        [heat]
        reference = "20 degC"
        [[temperatures]]
        name = "hot"
        block = "bar"
        temperature = "{20 + RISE} degC"
        {heat}
        [formulation.cover]
        {COVERS[cover]}
        [formulation.supports]
        method = "lagrange"
        {more}
        """
    )


CYCLE = {
    "heat": 'history = [[0, 0], [0.5, 1], [1, 0]]\n[[loads]]\nname = "none"\nkind = "edge"\n'
    "segment = [[0, 1], [2, 1]]\ntraction = [0, 0]\n[loading]\nuntil = 1.0",
    "more": "[formulation.loading]\nincrement = 0.05",
}


def stresses(run):
    """Return the stress (Pa) along the bar where it is hottest and when it has cooled."""
    assert (run.summary.status, run.summary.warnings) == ("converged", [])
    return run.history["reaction:right:x"][[9, -1]]


@pytest.mark.parametrize("cover", COVERS)
def test_a_bar_heated_past_yield_is_pulled_when_it_has_cooled(cover):
    """``s = Y + H (a T - s / E)`` while it flows; cooling takes ``E a T`` off."""
    hot = -(YIELD + HARDENS * ALPHA * RISE) / (1 + HARDENS / E)
    found = stresses(nmm.run(held(STEEL, "stress", cover, **CYCLE)))
    assert found == pytest.approx([hot, hot + E * ALPHA * RISE], rel=1e-9)


@pytest.mark.parametrize("law", ["mohr_coulomb", "drucker_prager"])
def test_heated_ground_fails_under_stress_from_two_sides_and_is_pulled_apart_as_it_cools(law):
    """In plane strain the stress across is that along, ``s``: Mohr and Coulomb's strengths.

    The cone is that of triaxial extension, which goes through both edges of the pyramid where two
    stresses are alike and pressed more.
    """
    angle = np.pi / 6
    text = f'law = "{law}"\ncohesion = 50e6\nfriction_angle = {angle}\ndilation_angle = {angle}\n'
    if law == "drucker_prager":
        text += 'match = "extension"\n'
    hot, cold = stresses(nmm.run(held(text, "strain", **CYCLE)))
    assert hot == pytest.approx(-2 * 50e6 * np.cos(angle) / (1 - np.sin(angle)), rel=1e-8)
    if law == "mohr_coulomb":
        assert cold == pytest.approx(2 * 50e6 * np.cos(angle) / (1 + np.sin(angle)), rel=1e-8)


def test_stress_of_heat_relaxes_as_maxwell_says():
    """Along and across held, free upwards: ``s = s0 exp(-t / T)``, ``T = v/G (1 + 4 G / 3 K)``."""
    law, head = 'law = "maxwell"\nviscosity = 1e16', "duration = 2e5"
    run = nmm.run(held(law, "strain", head=head, more="[formulation.integrator]\nstep = 2e3"))
    assert (run.summary.status, run.summary.warnings) == ("converged", [])
    shear, bulk = E / 2 / (1 + NU), E / 3 / (1 - 2 * NU)
    time = 1e16 / shear * (1 + 4 * shear / 3 / bulk)
    expected = -E * ALPHA * RISE / (1 - NU) * np.exp(-run.history["time"] / time)
    # Steps of a hundredth of the time, exact for strain of constant rate.
    assert run.history["reaction:right:x"] == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize(
    ("law", "plane"),
    [
        *(("von_mises", "stress"), ("von_mises", "strain"), ("mohr_coulomb", "strain")),
        *(("drucker_prager", "strain"), ("maxwell", "stress"), ("maxwell", "strain")),
    ],
)
def test_matter_that_does_not_flow_is_heated_as_elastic_matter(law, plane):
    """A linear temperature across, on covers that hold the strain that it makes."""
    constants = {
        "von_mises": "yield_stress = 1e12",
        "maxwell": "viscosity = 1e25",
    }.get(law, "cohesion = 1e12\nfriction_angle = 0.5")
    slope = "gradient = [0, 150]"
    known = nmm.run(held("", plane, heat=slope))
    found = nmm.run(held(f'law = "{law}"\n{constants}', plane, heat=slope))
    assert found.stress == pytest.approx(known.stress, abs=1e-9 * E * ALPHA * RISE)
    assert found.displacement == pytest.approx(known.displacement, abs=1e-12)


def test_heat_that_is_there_at_once_gives_no_energy_in_motion():
    """The bar begins under all of its stress and springs from there."""
    steps = '[inertia]\n[formulation.integrator]\ntype = "newmark"\nstep = 1e-5'
    run = nmm.run(held(STEEL, "stress", head="duration = 2e-3", more=steps))
    assert (run.summary.status, run.summary.warnings) == ("converged", [])


def test_a_law_that_knows_of_no_swelling_is_refused_by_line(monkeypatch):
    monkeypatch.setattr(VonMisesPlasticity, "swells", False)
    with pytest.raises(SceneError, match="scene:8: .*thermal_expansion.*swells"):
        nmm.run(held(STEEL, "stress"))


def test_a_heated_law_is_not_changed_for_one_of_another_kind():
    stages = (
        f"[materials.w]\nyoung_modulus = {E}\npoisson_ratio = {NU}\ndensity = 7800\n"
        f"conductivity = 50\nthermal_expansion = {ALPHA}\n"
        '[[stages]]\nname = "hot"\n[[stages]]\nname = "weak"\nmaterials = { bar = "w" }'
    )
    with pytest.raises(FormulationError, match="block bar: heated matter.*same law"):
        nmm.run(held(STEEL, "stress", heat=stages))
