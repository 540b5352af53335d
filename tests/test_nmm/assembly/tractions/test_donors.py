"""Which element gives the traction of a sliver."""

import numpy as np
import pytest

import nmm
from covers.approximation.ghost import neighbours
from nmm.assembly.tractions.donors import donors
from nmm.stepping.prepare import prepare

# One piece of a cell beside the end of the crack touches two whole cells.
CRACKED = """
plane = "stress"
[contact]
[materials.rock]
young_modulus = {modulus}
poisson_ratio = 0.45
[interfaces.joint]
friction_angle = 0.3
bonded = true
tensile_strength = {modulus}
cohesion = {modulus}
[[blocks]]
name = "plate"
material = "rock"
vertices = [[0, 0], [{width}, 0], [{width}, {height}], [0, {height}]]
[[cracks]]
name = "crack"
points = [[{outside}, {middle}], [{end}, {middle}]]
bonded = true
[[supports]]
name = "held"
segment = [[0, 0], [{width}, 0]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[0, {height}], [{width}, {height}]]
traction = [0, {traction}]
[formulation.cover]
type = "triangles"
size = {size}
degree = 2
"""
LENGTHS = {"width": 0.36940546432335497, "height": 0.3956336654474944, "size": 0.20403983390830482}
CRACK = {"outside": 0.4063460107556905, "middle": 0.1978168327237472, "end": 0.147762185729342}


def cracked(unit):
    """The scene in metres over ``unit``."""
    lengths = {name: unit * value for name, value in {**LENGTHS, **CRACK}.items()}
    return nmm.parse_scene(CRACKED.format(**lengths, modulus=1e8, traction=1e4))


def test_of_whole_cells_beside_a_sliver_the_nearest_is_its_donor():
    """They are as large as each other but for rounding, which must not choose."""
    for unit in (1.0, 1e3):
        scene = cracked(unit)
        model = prepare(scene, scene.formulation).stepper.model
        area, middle = model.element_area, model.manifold.elements.centroids
        first, second = neighbours(model.manifold, np.arange(len(area)))
        whole, chosen = area > (1 - 1e-9) * area.max(), 0
        for sliver in np.flatnonzero(area < 0.3 * area.max()):
            near = np.concatenate([second[first == sliver], first[second == sliver]])
            near = near[whole[near]]
            if len(near) > 1:
                away = np.hypot(*(middle - middle[sliver]).T)
                chosen += 1
                assert donors(model, np.array([sliver]))[0] == near[away[near].argmin()]
        assert chosen


def test_a_bonded_crack_gives_way_alike_in_other_units():
    one, other = (nmm.run(cracked(unit)).history["contact_energy"][-1] for unit in (1.0, 1e3))
    assert other / 1e6 == pytest.approx(one, rel=1e-6)
