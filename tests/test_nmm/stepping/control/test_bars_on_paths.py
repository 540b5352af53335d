"""Bars whose bond slides along paths past the peak."""

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError

# Two rigid blocks of half a metre on one bar; the joint between them breaks at 100 N.
PULLED = """
plane = "stress"
thickness = 0.1
[materials.stone]
young_modulus = 1e15
poisson_ratio = 0.0
[interfaces.joint]
bonded = true
tensile_strength = 1e4
cohesion = 1e4
friction_angle = "30 deg"
[[blocks]]
name = "left"
material = "stone"
vertices = [[-0.5, 0], [0, 0], [0, 0.1], [-0.5, 0.1]]
[[blocks]]
name = "right"
material = "stone"
vertices = [[0, 0], [0.5, 0], [0.5, 0.1], [0, 0.1]]
[[bars]]
name = "bar"
points = [[-0.5, 0.05], [0.5, 0.05]]
area = 400e-6
perimeter = 0.2
young_modulus = 200e9
bond = { law = "plastic", stiffness = 1e12, strength = 1.88e6 }
[[supports]]
name = "wall"
segment = [[-0.5, 0], [-0.5, 0.1]]
fix = ["x", "y"]
[[supports]]
name = "rail"
segment = [[0.5, 0], [0.5, 0.1]]
fix = ["y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[0.5, 0], [0.5, 0.1]]
traction = [1e5, 0]
[[monitors]]
name = "left lip"
point = [-0.01, 0.05]
[[monitors]]
name = "right lip"
point = [0.01, 0.05]
[contact]
[loading]
until = "failure"
[loading.control]
type = "opening"
monitors = ["right lip", "left lip"]
increment = "5 um"
end = "100 um"
[formulation.bars]
pieces = 200
"""
# Axial stiffness (N), force of the bond per length (N/m), length over which it is elastic (m).
AXIAL, BOND = 200e9 * 400e-6, 1.88e6 * 0.2
ELASTIC = np.sqrt(AXIAL / (1e12 * 0.2))


@pytest.fixture(scope="module")
def pulled():
    """Return the run of the two blocks that are pulled apart."""
    return nmm.run(nmm.parse_scene(PULLED))


def test_a_bar_across_an_opening_joint_pulls_by_its_bond_and_elasticity(pulled):
    """F^2 = E A t (w - t l^2 / (E A)), t being the bond's force per length, l its elastic length.

    The bond slides over F / t - l on either side. Pieces of 5 mm beside 20 mm of l: 4e-4.
    """
    h = pulled.history
    opening = h["monitor:right lip:ux"] - h["monitor:left lip:ux"]
    slides = opening > 6e-6
    expected = np.sqrt(AXIAL * BOND * opening[slides] - (BOND * ELASTIC) ** 2)
    assert slides.sum() == 19
    np.testing.assert_allclose(1e3 * h["load_factor"][slides], expected, rtol=2e-3)


def test_along_a_path_work_is_what_bars_store_and_their_bond_takes(pulled):
    h = pulled.history
    length = 1e3 * h["load_factor"][-1] / BOND - ELASTIC
    # The integral of t s over the length that slides, s = t / E A (l x + x^2 / 2): both sides.
    taken = 2 * BOND**2 / AXIAL * (ELASTIC * length**2 / 2 + length**3 / 6)
    assert h["loss:bars"][-1] == pytest.approx(taken, rel=5e-3)  # ten steps: 1 %
    assert abs(pulled.summary.energy_balance) < 1e-9
    # The joint lost what was stored in it: 100 N over its spring, next to nothing.
    assert 0 <= h["friction_loss"][-1] < 1e-8 * taken


def test_dissipation_does_not_lead_what_yields_or_slides():
    """Their unloading would count as dissipation: the load turned round to -34 kN of 55."""
    soft = 'law = "linear_softening"\nfracture_energy = 100.0\nbonded = true'
    led = 'type = "dissipation"\nenergy = 0.1\nend_energy = 1.5\n'
    head, tail = PULLED.replace("bonded = true", soft).split('type = "opening"')
    scene = nmm.parse_scene(head + led + tail[tail.index("[formulation") :])
    with pytest.raises(NmmError, match="bars that yield or slide do not unload to their origin"):
        nmm.run(scene)
