"""Bodies that nothing holds, in statics without contact: told, and left where they stand."""

import numpy as np
import pytest

import nmm

# A plate of 2 m by 1 m, of steel.
SCENE = """plane = "stress"
[materials.steel]
young_modulus = 2e11
poisson_ratio = 0.3
density = 7800.0
conductivity = 50.0
thermal_expansion = 1.2e-5
[[blocks]]
name = "plate"
material = "steel"
vertices = [[{left}, {low}], [{right}, {low}], [{right}, {high}], [{left}, {high}]]
[[monitors]]
name = "corner"
point = [{right}, {high}]
block = "plate"
"""
WARM = '[heat]\n[[temperatures]]\nname = "t"\nblock = "all"\ntemperature = 50.0\n'
EDGE = (
    '[[loads]]\nname = "{name}"\nkind = "edge"\n'
    "segment = [[{x}, {low}], [{x}, {high}]]\ntraction = [{pull}, 0.0]\n"
)
HELD = '[[supports]]\nname = "held"\nsegment = [[{left}, {low}], [{left}, {high}]]\nfix = {fix}\n'
COVERS = {
    "block": 'type = "block"',
    "triangles": 'type = "triangles"\nsize = 0.3\ndegree = 1',
    "quads": 'type = "quads"\nsize = 0.3\ndegree = 1',
    "bspline": 'type = "bspline"\nsize = 0.4',
    "mls": 'type = "mls"\nsize = 0.3\ndegree = 1',
}


def solved(
    more: str, cover: str = "triangles", left: float = 0.0, low: float = 0.0, rest: str = ""
) -> nmm.Run:
    """Run the plate with its lower left corner at a place."""
    at = {"left": left, "low": low, "right": left + 2.0, "high": low + 1.0}
    text = SCENE.format(**at) + more.format(**at)
    return nmm.run(nmm.parse_scene(f"{text}[formulation.cover]\n{COVERS[cover]}\n{rest}"))


def corner(run: nmm.Run) -> np.ndarray:
    return np.array([run.history[f"monitor:corner:{axis}"][-1] for axis in ("ux", "uy")])


def pulled(at: float, pull: float) -> str:
    """Return the table of a traction on the left edge, or on the right one."""
    edge = EDGE.replace("{x}", "{right}" if at else "{left}")
    return edge.replace("{name}", f"at {at:g}").replace("{pull}", f"{pull:g}")


@pytest.mark.parametrize("place", [(0.0, 0.0), (-7e3, 1.3e4)])
@pytest.mark.parametrize("cover", COVERS)
def test_a_free_plate_that_warms_grows_about_its_middle_and_is_told_to_be_free(cover, place):
    run = solved(WARM, cover, *place)
    # u = alpha T (x - middle), free of stress; anchors, and rounding of places at 1e4 m over the
    # motion of 6e-4 m, leave some 1e-6 of it.
    np.testing.assert_allclose(corner(run), 1.2e-5 * 50 * np.array([1.0, 0.5]), rtol=1e-5)
    assert run.summary.status == "converged"
    assert "block plate is in neutral equilibrium" in run.summary.sentence
    assert not [one for one in run.summary.warnings if "digits" in one]


@pytest.mark.parametrize("cover", COVERS)
def test_a_free_plate_that_is_pulled_at_both_ends_stretches_about_its_middle(cover):
    run = solved(pulled(0.0, -1e8) + pulled(2.0, 1e8), cover)
    # sigma / E along, -nu sigma / E across; anchors of 1e-8 leave 3e-7 of the motion as a turn on
    # splines, and weights that are no polynomials are integrated to some 1e-3.
    near, motion = 1e-3 if cover == "mls" else 1e-6, 1e8 / 2e11
    right = motion * np.array([1.0, -0.3 * 0.5])
    np.testing.assert_allclose(corner(run), right, rtol=0, atol=near * motion)
    assert "block plate is in neutral equilibrium" in run.summary.sentence


def test_a_free_plate_that_is_pulled_at_one_end_is_said_to_be_held_by_nothing():
    summary = solved(pulled(2.0, 1e8)).summary
    assert summary.status == "collapsed"
    assert "block plate is held by nothing" in summary.sentence
    assert "neutral" not in summary.sentence


@pytest.mark.parametrize("method", ["penalty", "nitsche", "lagrange"])
def test_a_plate_that_is_held_is_not_told_to_be_free_whatever_holds_it(method):
    rest = f'[formulation.supports]\nmethod = "{method}"\n'
    held = solved(WARM + HELD.replace("{fix}", '["x", "y"]'), rest=rest).summary.sentence
    assert "neutral" not in held
    assert "anchors" not in held


def test_a_plate_that_may_slide_is_told_which_way():
    sentence = solved(WARM + HELD.replace("{fix}", '["x"]')).summary.sentence
    assert "block plate is in neutral equilibrium: it moves along (" in sentence
    direction = sentence.split("moves along (")[1].split(")")[0]
    assert abs(float(direction.split(",")[0])) < 0.01
