"""Bonded joints between meshes: faces stay together between the points of the joint too."""

import numpy as np
import pytest

import nmm

HALVES = """
plane = "strain"
[contact]
[materials.rock]
young_modulus = 56e6
poisson_ratio = 0.2
[interfaces.joint]
friction_angle = 0.9
bonded = true
cohesion = 1e9
tensile_strength = 1e9
[[blocks]]
name = "low"
material = "rock"
vertices = [[0, 0.1], [0.46, 0.28], [0.46, 0], [0, 0]]
[[blocks]]
name = "high"
material = "rock"
vertices = [[0.46, 0.28], [0, 0.1], [0, 0.33], [0.46, 0.33]]
[[supports]]
name = "held"
segment = [[0, 0], [0.46, 0]]
fix = ["x", "y"]
[[loads]]
name = "push"
kind = "edge"
segment = [[0, 0.33], [0.46, 0.33]]
traction = [-7e3, -24e3]
[formulation.cover]
type = "{cover}"
size = 0.16
degree = {degree}
"""
MONITOR = """
[[monitors]]
name = "{block} {number}"
point = [{x}, {y}]
block = "{block}"
"""
COVERS = [
    *(("quads", degree) for degree in (1, 2)),
    *(("triangles", degree) for degree in (1, 2)),
    *(("bspline", degree) for degree in (1, 2)),
    *(("mls", degree) for degree in (0, 1, 2)),
]


@pytest.mark.parametrize(("cover", "degree"), COVERS)
def test_a_bonded_joint_does_not_open_between_its_points(cover, degree):
    """Nitsche's terms leave a hundredth of the motion on three cells; two points left a half."""
    places = [(0.46 * t, 0.1 + 0.18 * t) for t in np.linspace(0, 1, 9)]
    monitors = "".join(
        MONITOR.format(block=block, number=number, x=float(x), y=float(y))
        for number, (x, y) in enumerate(places)
        for block in ("low", "high")
    )
    history = nmm.run(nmm.parse_scene(HALVES.format(cover=cover, degree=degree) + monitors)).history
    low, high = (
        np.array([[history[f"monitor:{block} {k}:u{axis}"][-1] for axis in "xy"] for k in range(9)])
        for block in ("low", "high")
    )
    assert np.abs(low - high).max() < 0.02 * np.abs(low).max()
