"""A cable across a crack that grows: loads by the stress intensities of tension and of forces."""

from pathlib import Path

import numpy as np
import pytest

import nmm

pytestmark = pytest.mark.slow

SCENE = Path(__file__).parents[2] / "examples/bridged_crack/plate.toml"
TOUGHNESS, TENSION, WIDTH, AWAY, POISSON = 1e6, 1e6, 2.0, 0.15, 0.2
MODULUS = 30e9 / (1 - POISSON**2)  # of plane strain (Pa)
CABLE = 2 * 200e9 * 0.007 / (2 * AWAY)  # N/m, both halves


def of_tension(a):
    """K_I under a stress of 1, in a long plate (Feddersen; Tada: 0.3 % for a < 0.8 W)."""
    return np.sqrt(np.pi * a / np.cos(np.pi * a / 2 / WIDTH))


def of_cable(a):
    """K_I of two forces of 1 at a distance that press on the crack, by Kelvin's solution."""
    x = a * np.sin((np.arange(1000) + 0.5) / 1000 * np.pi / 2)
    r2 = x**2 + AWAY**2
    pressed = AWAY / (2 * np.pi * (1 - POISSON) * r2) * (1 - 2 * POISSON + 2 * AWAY**2 / r2)
    q = a / WIDTH
    wide = (1 - 0.5 * q + 0.957 * q**2 - 0.16 * q**3) / np.sqrt(1 - q)  # Tada, at the middle
    return wide * np.sqrt(np.pi * a) * pressed.mean()


def stretches(a, load):
    """Of the cable under the load and under a force of 1, without its anchors (Castigliano)."""
    parts = (np.arange(200) + 0.5) / 200 * a
    cable = np.array([of_cable(one) for one in parts])
    tension = np.array([of_tension(one) for one in parts])
    scale = 4 / MODULUS * a / 200
    opened = load * (TENSION * 2 * AWAY / MODULUS + scale * TENSION * (tension @ cable))
    return opened, 1 / CABLE + scale * (cable @ cable)


@pytest.fixture(scope="module")
def run():
    return nmm.run(nmm.read_scene(SCENE))


def test_a_bridged_crack_grows_where_tension_less_the_cable_is_its_toughness(run):
    assert run.summary.status == "converged"
    length, load = run.history["fracture:crack:length"], run.history["load_factor"]
    force = 2 * run.history["bars:cable:force"]
    np.testing.assert_allclose(length, 0.2 + 0.02 * np.arange(6), atol=1e-9)
    closing = force * [of_cable(a) for a in length]
    found = load * TENSION * of_tension(length) - closing
    # The formulas are within 0.3 % in a plate without end, this one is twice as long as wide.
    np.testing.assert_allclose(found, TOUGHNESS, rtol=3e-3)
    # The cable takes a fifth of what the tension makes.
    assert (closing > 0.24 * TOUGHNESS).all()


def test_a_cable_is_stretched_by_what_the_crack_opens(run):
    length, load = run.history["fracture:crack:length"], run.history["load_factor"]
    force = 2 * run.history["bars:cable:force"]
    opened, each = np.transpose([stretches(a, f) for a, f in zip(length, load, strict=True)])
    anchors = MODULUS * (opened / force - each)
    # Points of a net give way by a number that hangs on its cells alone, not on the crack: within
    # 2.5 %, as cells about the tip have more functions. Forces follow from it to a third of that.
    np.testing.assert_allclose(anchors, anchors.mean(), rtol=0.03)
    assert 1 < anchors.mean() < 3
    np.testing.assert_allclose(force, opened / (each + anchors.mean() / MODULUS), rtol=8e-3)


def test_a_crack_grows_at_its_toughness_where_the_cable_yields(run):
    # The cable yields at 150 kN, below the 209 kN that the elastic one takes at first. The
    # load was scaled once, as if all were linear: the run ended after a piece.
    yields = SCENE.read_text().replace(
        "[[supports]]", 'yield_stress = "10.71 MPa"\n[[supports]]', 1
    )
    found = nmm.run(nmm.parse_scene(yields.replace("cable", "strand")))
    length, load = found.history["fracture:crack:length"], found.history["load_factor"]
    np.testing.assert_allclose(length, 0.2 + 0.02 * np.arange(6), atol=1e-9)
    np.testing.assert_allclose(found.history["fracture:crack:end:share"], 1, atol=1e-8)
    force = 2 * found.history["bars:strand:force"]
    assert (force < 0.75 * 2 * run.history["bars:cable:force"]).all()
    closing = force * [of_cable(a) for a in length]
    np.testing.assert_allclose(load * TENSION * of_tension(length) - closing, TOUGHNESS, rtol=3e-3)
