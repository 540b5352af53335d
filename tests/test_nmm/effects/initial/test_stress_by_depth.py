"""Stress in the ground that grows with depth, in a ratio of horizontal to vertical."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing import check_effect_of

GROUND = """
plane = "strain"
[materials.soil]
young_modulus = "50 MPa"
poisson_ratio = 0.3
density = 2000
{law}
[[blocks]]
name = "soil"
material = "soil"
vertices = [[{left}, {low}], [{right}, {low}], [{right}, {high}], [{left}, {high}]]
[gravity]
acceleration = [0, -10]
[[initial_stresses]]
block = "soil"
surface = {high}
unit_weight = "20 kN/m^3"
surcharge = "30 kPa"
ratio = {ratio}
{across}
[[loads]]
name = "fill"
kind = "edge"
segment = [[{left}, {high}], [{right}, {high}]]
traction = [0, -30e3]
[[supports]]
name = "floor"
segment = [[{left}, {low}], [{right}, {low}]]
fix = ["y"]
[[supports]]
name = "left"
segment = [[{left}, {low}], [{left}, {high}]]
fix = ["x"]
[[supports]]
name = "right"
segment = [[{right}, {low}], [{right}, {high}]]
fix = ["x"]
[formulation.supports]
method = "{method}"
[formulation.cover]
{cover}
"""
COHESIVE = 'law = "mohr_coulomb"\ncohesion = "5 kPa"\nfriction_angle = "30 deg"'
COVERS = {
    "quads": 'type = "quads"\nsize = 3.0\ndegree = 0',
    "linear quads": 'type = "quads"\nsize = 3.0\ndegree = 1',
    "triangles": 'type = "triangles"\nsize = 4.0\ndegree = 1',
    "quadratic triangles": 'type = "triangles"\nsize = 5.0\ndegree = 2',
    "splines": 'type = "bspline"\nsize = 4.0\ndegree = 2',
}


def ground(cover="triangles", far=0.0, ratio=0.8, law="", across="", method="auto"):
    """Ground of 10 m by 12 m under its weight and a fill, in equilibrium with what is given."""
    places = {"left": far, "right": far + 10.0, "low": far - 12.0, "high": far}
    text = GROUND.format(
        cover=COVERS[cover], ratio=ratio, law=law, across=across, method=method, **places
    )
    return nmm.parse_scene(text)


@pytest.mark.parametrize("far", [0.0, 1e5])
@pytest.mark.parametrize("cover", COVERS)
def test_ground_under_the_stress_of_its_weight_does_not_move(cover, far):
    run = nmm.run(ground(cover, far))
    assert run.summary.status == "converged", run.summary.sentence
    # Alone it would settle by (30e3 * 12 + 20e3 * 72) / 67.3e6 = 2.7e-2 m.
    assert np.abs(run.displacement).max() < 1e-12


@pytest.mark.parametrize("law", ["", COHESIVE])
def test_rounding_of_ground_that_does_not_move_is_no_change_of_it(law):
    """It was told as 1e-2 and 5e-2 of displacements of 1e-15 m."""
    run = nmm.run(ground("triangles", 1e5, ratio=0.6, law=law, method="lagrange"))
    assert np.abs(run.displacement).max() < 1e-12
    assert list(run.summary.warnings) == []


def test_its_stress_is_depth_times_weight_and_the_ratio_of_it():
    run = nmm.run(ground("linear quads", ratio=0.8))
    frame = run.frames[-1]
    # The lowest cells are 3 m high: the mean of their stress is that 10.5 m below the surface.
    lowest = -(30e3 + 20e3 * 10.5)
    assert frame.stress[:, 1].min() == pytest.approx(lowest, rel=1e-12)
    assert frame.stress[:, 0].min() == pytest.approx(0.8 * lowest, rel=1e-12)


@pytest.mark.parametrize(("ratio", "moves"), [(0.6, False), (0.3, True)])
def test_ground_that_its_ratio_does_not_bring_to_yield_stays(ratio, moves):
    """With 30 degrees active failure is at a ratio of 1/3, here less some cohesion."""
    scene = ground(
        "triangles", ratio=ratio, law=COHESIVE, across=f"ratio_across = {ratio}", method="lagrange"
    )
    run = nmm.run(scene)
    assert run.summary.status == "converged", run.summary.sentence
    assert (np.abs(run.displacement).max() > 1e-6) == moves


@pytest.mark.parametrize("cover", ["triangles", "quadratic triangles"])
def test_it_keeps_what_every_effect_promises(cover):
    check_effect_of(ground(cover), "initial stress")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("ratio = 0.8\n", "", "no ratio: expected surface, unit_weight, ratio together"),
        ("surcharge", "stress = [0, 0, 0]\nsurcharge", "stress and surface"),
        ('unit_weight = "20 kN/m^3"', "unit_weight = 0", "a weight of the ground in N/m3, > 0"),
        ("surface = 0.0\n", "", "no surface"),
    ],
)
def test_what_contradicts_itself_is_refused_by_line(old, new, said):
    places = {"left": 0.0, "right": 10.0, "low": -12.0, "high": 0.0}
    text = GROUND.format(
        cover=COVERS["quads"], ratio=0.8, law="", across="", method="auto", **places
    )
    assert old in text
    with pytest.raises(SceneError, match=said):
        nmm.parse_scene(text.replace(old, new, 1))


@pytest.mark.parametrize(("surface", "told"), [(0.0, ""), (-1.5, ""), (-3.0, "1.5 m above")])
def test_matter_above_the_surface_that_begins_under_tension_is_told(surface, told):
    # 30 kPa of surcharge are 1.5 m of 20 kN/m3: what is higher above the surface is pulled.
    scene = ground("quads")
    stress = scene.initial_stresses[0].model_copy(update={"surface": surface})
    run = nmm.run(scene.model_copy(update={"initial_stresses": (stress,)}))
    found = [one for one in run.summary.warnings if "stress by depth" in one]
    assert len(found) == bool(told)
    assert told in "".join(found)
