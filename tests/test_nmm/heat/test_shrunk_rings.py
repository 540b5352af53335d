"""A warm ring in a cold one: the pressure between them, and how far both give way, after Lamé."""

import numpy as np
import pytest

import nmm

INNER, FACE, OUTER = 1.0, 1.5, 2.0  # radii (m)
STIFF, SOFT, POISSON, WARMTH, EXPANSION = 2e9, 1e9, 0.25, 50.0, 1e-5
PIECES = 16
HEAD = """
plane = "stress"
[contact]
[heat]
[interfaces.face]
friction_angle = 0.0
"""
RING = """
[materials.{name}]
young_modulus = {modulus}
poisson_ratio = {poisson}
conductivity = 2.0
thermal_expansion = 1e-5
[[blocks]]
name = "{name}"
material = "{name}"
vertices = {corners}
[[temperatures]]
name = "{name}"
block = "{name}"
temperature = {warmth}
[[supports]]
name = "{name} along x"
segment = [[0, {low}], [0, {high}]]
fix = ["x"]
[[supports]]
name = "{name} along y"
segment = [[{high}, 0], [{low}, 0]]
fix = ["y"]
[[monitors]]
name = "{name}"
block = "{name}"
point = [{point}, 0]
"""
FORMULATION = """
[formulation.loading]
increment = 1.0
[formulation.contact]
enforcement = "{enforcement}"
[formulation.cover]
type = "{cover}"
size = 0.25
degree = {degree}
"""


def quarter(low, high, **more):
    angle = np.linspace(0, np.pi / 2, PIECES + 1)
    unit = np.column_stack([np.cos(angle), np.sin(angle)])
    unit[0], unit[-1] = (1, 0), (0, 1)
    corners = np.vstack([high * unit, low * unit[::-1]]).tolist()
    return RING.format(poisson=POISSON, low=low, high=high, corners=corners, **more)


@pytest.mark.parametrize(
    ("cover", "degree", "enforcement"),
    [("triangles", 1, "augmented"), ("triangles", 1, "barrier"), ("quads", 1, "cone")],
)
def test_a_warm_ring_presses_on_a_cold_one_with_the_pressure_of_lame(cover, degree, enforcement):
    warm = quarter(INNER, FACE, name="warm", modulus=STIFF, warmth=WARMTH, point=INNER)
    cold = quarter(FACE, OUTER, name="cold", modulus=SOFT, warmth=0.0, point=OUTER)
    method = FORMULATION.format(cover=cover, degree=degree, enforcement=enforcement)
    run = nmm.run(nmm.parse_scene(HEAD + warm + cold + method))
    assert run.summary.status == "converged"
    a2, b2, c2 = INNER**2, FACE**2, OUTER**2
    give = ((c2 + b2) / (c2 - b2) + POISSON) / SOFT + ((b2 + a2) / (b2 - a2) - POISSON) / STIFF
    pressure = EXPANSION * WARMTH / give
    outwards = 2 * pressure * b2 * OUTER / (c2 - b2) / SOFT
    inwards = 2 * pressure * b2 * INNER / (b2 - a2) / STIFF
    # A polygon of 16 sides in the quarter is (pi / 32)^2 / 6 = 2e-3 smaller than its circle.
    forces = np.abs(run.frames[-1].contact_force[:, 0]).sum()
    assert forces == pytest.approx(pressure * FACE * np.pi / 2, rel=2.5e-3)
    h = run.history
    pull = abs(h["reaction:cold along x:x"][-1])
    assert pull == pytest.approx(pressure * FACE, rel=2.5e-3)
    assert h["monitor:cold:ux"][-1] == pytest.approx(outwards, rel=2.5e-3)
    expected = EXPANSION * WARMTH * INNER - inwards
    assert h["monitor:warm:ux"][-1] == pytest.approx(expected, rel=2.5e-3)
