"""Bands that soften across rows of cells are told."""

import numpy as np
import pytest

import nmm

SCENE = """plane = "strain"
[materials.clay]
law = "{law}"
young_modulus = 1e9
poisson_ratio = 0.25
{strength}
softening_energy = 2e3
[[blocks]]
name = "layer"
material = "clay"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["y"]
[[supports]]
name = "right"
segment = [[1, 0], [1, 1]]
fix = ["y"]
[[supports]]
name = "foot"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[supports]]
name = "top"
segment = [[0, 1], [1, 1]]
fix = ["x", "y"]
displacement = [0.003, 0]
[[loads]]
name = "more"
kind = "body"
density = [5e4, 0]
[loading]
scaled = ["top"]
until = 1.0
[formulation.loading]
increment = 0.05
[formulation.cover]
type = "{cover}"
size = 0.125
degree = 1
angle = "{angle} deg"
"""
LAWS = {
    "von_mises": "yield_stress = 1e6",
    "mohr_coulomb": "cohesion = 5.5e5\nfriction_angle = 0.2",
}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("cover", "angle"), [("quads", 0), ("quads", 25), ("triangles", 15)])
def test_bands_of_a_sheared_layer_lean_against_the_rows_of_its_cells(law, cover, angle):
    scene = SCENE.format(law=law, strength=LAWS[law], cover=cover, angle=angle)
    found = nmm.run(nmm.parse_scene(scene)).summary
    assert found.status == "converged", found.sentence
    # All of it is sheared along its foot, but for some degrees where strain turns within a band.
    leans = found.audits["softening_across_cells"]
    assert leans == pytest.approx(np.radians(angle), abs=np.radians(3.5))
    warned = [line for line in found.warnings if "audit softening_across_cells" in line]
    assert bool(warned) is (angle > 0)
