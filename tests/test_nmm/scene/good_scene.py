"""A scene without a fault, and the faults of what is made of it."""

import pytest

from nmm.errors import SceneError
from nmm.scene import parse_scene

GOOD = """
plane = "stress"
thickness = "100 mm"
[materials.concrete]
young_modulus = "27.5 GPa"
poisson_ratio = 0.2
[interfaces.crack]
bonded = true
friction_angle = "37 deg"
cohesion = "4.7 MPa"
tensile_strength = "2.9 MPa"
[[blocks]]
name = "beam"
material = "concrete"
vertices = [[0, 0], ["400 mm", 0], [0.4, 0.1], [0, 0.1]]
[[supports]]
name = "left"
point = [0.05, 0]
fix = ["x", "y"]
[[loads]]
name = "jack"
kind = "point"
point = [0.2, 0.1]
force = [0, "-1 kN"]
[contact]
[loading]
until = "failure"
"""


def faults_of(text: str) -> list[str]:
    with pytest.raises(SceneError) as caught:
        parse_scene(text, "s.toml")
    return str(caught.value).splitlines()


def fault_of(text: str) -> str:
    (line,) = faults_of(text)
    return line
