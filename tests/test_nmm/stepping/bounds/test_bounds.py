"""What the static theorem may say of blocks that members hold."""

import numpy as np
import pytest

import nmm
from nmm.formulation import Formulation, parse_formulation
from nmm.stepping.bounds.member_forces import TURN
from nmm.stepping.bounds.static_theorem import carried, load_bound
from nmm.stepping.prepare import prepare
from nmm.stepping.step.anchors import largest_mover

SLIDING = """
plane = "stress"
[materials.rock]
young_modulus = "10 GPa"
poisson_ratio = 0.0
density = 1000
[interfaces.joint]
friction_angle = "30 deg"
[[blocks]]
name = "base"
material = "rock"
vertices = [[-3, -1], [5, -1], [5, 0], [-3, 0]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "base"
block = "base"
fix = ["x", "y"]
[[loads]]
name = "push"
kind = "point"
point = [0, 0.5]
block = "block"
force = ["1 kN", 0]
[gravity]
[contact]
[loading]
until = "failure"
"""
TIE = """
[[springs]]
name = "tie"
points = [[0, 0.5], [-2, 0.5]]
blocks = ["block", "ground"]
stiffness = "10 MN/m"
"""


OTHER = """
[[blocks]]
name = "other"
material = "rock"
vertices = [[-2.5, 0], [-0.5, 0], [-0.5, 1], [-2.5, 1]]
[[springs]]
name = "cable"
points = [[0, 0.5], [-0.5, 0.5]]
blocks = ["block", "other"]
stiffness = "10 MN/m"
"""
BOLT = """
[[bars]]
name = "bolt"
points = [[0.4, 0.5], [-1.6, 0.5]]
blocks = ["block", "ground"]
area = "100 mm^2"
perimeter = "0.1 m"
young_modulus = "200 GPa"
ends = ["free", "ground"]
%s
[bars.bond]
law = "plastic"
stiffness = "1 GPa/m"
strength = "%s kPa"
"""
FRICTION = 2 * 1000 * 9.81 * np.tan(np.pi / 6)


def bound(members, backwards=False):
    push = "force = [%s, 0]"
    pushed = SLIDING.replace(push % '"1 kN"', push % ('"-1 kN"' if backwards else '"1 kN"'))
    made = prepare(nmm.parse_scene(pushed + members), Formulation())
    return load_bound(made.stepper, made.start)


@pytest.mark.parametrize(
    ("member", "most"),
    [
        ("", FRICTION),
        (TIE + 'yield_force = "1 kN"\n', FRICTION + 1e3),
        (TIE + 'carries = "compression"\n', FRICTION),
        (TIE + 'carries = "tension"\nyield_force = "3 kN"\n', FRICTION + 3e3),
        # A cable drags the other block along, a strut does not.
        (OTHER + 'carries = "tension"\n', 2 * FRICTION),
        (OTHER + 'carries = "compression"\n', FRICTION),
        # 0.4 m of bond in the block at 0.1 m2 a metre; beyond that the bolt yields at 10 kN.
        (BOLT % ("", 50), FRICTION + 2e3),
        (BOLT % ('yield_stress = "100 MPa"', 500), FRICTION + 1e4),
    ],
)
def test_members_carry_their_limit_beside_friction(member, most):
    assert bound(member).factor == pytest.approx(most / 1e3, rel=1e-6)


@pytest.mark.parametrize(
    ("member", "most"),
    [('carries = "tension"\n', FRICTION), ('carries = "compression"\n', 2 * FRICTION)],
)
def test_a_cable_pushes_no_block_and_a_strut_does(member, most):
    assert bound(OTHER + member, backwards=True).factor == pytest.approx(most / 1e3, rel=1e-6)


@pytest.mark.parametrize("member", [TIE, TIE + 'carries = "tension"\n'])
def test_no_bound_is_told_where_a_member_without_limit_pulls_against_the_load(member):
    found = bound(member)
    assert np.isinf(found.factor)
    assert not found.motion.any()


HANGING = """
[[blocks]]
name = "hanging"
material = "rock"
vertices = [[0, -4], [1, -4], [1, -3], [0, -3]]
[[springs]]
name = "cable"
points = [[0.5, -3], [0.5, -1]]
blocks = ["hanging", "ground"]
stiffness = "10 MN/m"
%s
[[loads]]
name = "aside"
kind = "point"
point = [0.5, -3]
block = "hanging"
force = [%s, 0]
"""


@pytest.mark.parametrize(
    ("member", "share", "fails"),
    [
        ('carries = "tension"', 0.9 * TURN, False),
        ('carries = "tension"', 1.1 * TURN, True),
        # Slack by 10 mm: where it will hang is not known.
        ('carries = "tension"\nforce = "-100 kN"', 1.1 * TURN, False),
        ('carries = "compression"', 0.0, True),
    ],
)
def test_what_hangs_on_a_cable_may_swing_a_little_before_its_fall_is_proven(member, share, fails):
    scene = SLIDING.replace('["1 kN", 0]', "[0, 0]") + HANGING % (member, share * 1000 * 9.81)
    made = prepare(nmm.parse_scene(scene), Formulation())
    assert carried(made.stepper, made.start, 1.0).fails == fails


SLOPE = """
plane = "strain"
[gravity]
acceleration = [%s, %s]
[contact]
[interfaces.rough]
between = ["upper", "ground"]
friction_angle = "45 deg"
[interfaces.smooth]
between = ["lower", "ground"]
friction_angle = "%s deg"
[[supports]]
name = "ground"
block = "ground"
fix = ["x", "y"]
[[springs]]
name = "cable"
points = [[-1.2, 0.5], [1.2, 0.5]]
blocks = ["lower", "upper"]
stiffness = "10 MN/m"
carries = "tension"
%s
"""
"""Two blocks of one weight on a floor that is turned, tied by a cable along it."""


def on_a_slope(angle, smooth, member=""):
    turned = np.radians(angle)
    head = SLOPE % (-9.81 * np.sin(turned), -9.81 * np.cos(turned), smooth, member)
    outlines = {
        "ground": [[-8, -1], [8, -1], [8, 0], [-8, 0]],
        "lower": [[-2, 0], [-1, 0], [-1, 1], [-2, 1]],
        "upper": [[1, 0], [2, 0], [2, 1], [1, 1]],
    }
    return head + "".join(
        f'[materials.{name}]\nyoung_modulus = "10 GPa"\npoisson_ratio = 0.2\ndensity = 2600\n'
        f'[[blocks]]\nname = "{name}"\nmaterial = "{name}"\nvertices = {outline}\n'
        for name, outline in outlines.items()
    )


# Both slide where tan(slope) exceeds the mean of both coefficients of friction, 1 of the upper one.
@pytest.mark.parametrize("smooth", [20, 30])
def test_two_blocks_on_a_cable_hold_each_other_by_the_mean_of_their_friction(smooth):
    mean = np.degrees(np.arctan((1 + np.tan(np.radians(smooth))) / 2))
    for angle, factor in ((mean - 0.01, np.inf), (mean + 0.01, None)):
        made = prepare(nmm.parse_scene(on_a_slope(angle, smooth)), Formulation())
        found = load_bound(made.stepper, made.start)
        assert found.factor == factor, (angle, found)


@pytest.mark.parametrize(
    "member",
    [
        pytest.param("", id="taut"),
        pytest.param('force = "-100 kN"', id="slack", marks=pytest.mark.slow),
    ],
)
def test_two_blocks_that_slide_on_a_cable_have_collapsed(member):
    found = nmm.run(nmm.parse_scene(on_a_slope(40, 30, member))).summary
    assert found.status == "collapsed", found.sentence
    assert "members" in found.sentence


# Yielding with T at 40 degrees to a plane of phi = 30, a bolt holds T (cos b + sin b tan phi) as
# drawn. It turns as its block slides, and at b = phi holds the largest value, T / cos(phi).
@pytest.mark.parametrize(
    ("update", "held", "told"),
    [
        ("small", np.cos(np.radians(40)) + np.sin(np.radians(40)) / np.sqrt(3), 0),
        ("exact", 1 / np.cos(np.pi / 6), 1),
    ],
)
def test_a_bolt_that_turns_passes_the_bound_of_its_drawn_place_and_tells_it(update, held, told):
    anchor = [0.5 - 2 * float(np.cos(np.radians(40))), 0.5 - 2 * float(np.sin(np.radians(40)))]
    bolt = (
        f'[[springs]]\nname = "bolt"\npoints = [[0.5, 0.5], {anchor}]\nyield_force = "20 kN"\n'
        'blocks = ["block", "ground"]\nstiffness = "10 MN/m"\n'
    )
    how = f'[rotation]\nupdate = "{update}"\n[loading]\nincrement = 4\ntolerance = 2e-3\n'
    found = nmm.run(nmm.parse_scene(SLIDING + bolt), parse_formulation(how)).summary
    # Within the search's tolerance below; the bolt yields fully, no more than rounding above.
    assert (1 - 2e-3) * (FRICTION / 1e3 + 20 * held) < found.failure_factor
    assert found.failure_factor < (1 + 1e-3) * (FRICTION / 1e3 + 20 * held)
    assert sum("bound of the static theorem" in one for one in found.warnings) == told


@pytest.mark.parametrize(("push", "how"), [("", "clockwise"), ("-", "counter-clockwise")])
def test_a_tower_falls_the_way_that_it_is_pushed_though_its_weight_resists(push, how):
    tower = SLIDING.replace("[2, 0], [2, 1], [0, 1]]", "[1, 0], [1, 3], [0, 3]]")
    pushed = tower.replace("point = [0, 0.5]", "point = [0.5, 2]").replace(
        '"1 kN"', f'"{push}1 kN"'
    )
    made = prepare(nmm.parse_scene(pushed.replace("30 deg", "45 deg")), Formulation())
    found = load_bound(made.stepper, made.start)
    assert found.factor == pytest.approx(3 * 9.81 * 0.5 / 2, rel=1e-6)  # W b / 2 h, of 3 tonnes
    _, said = largest_mover(made.stepper.model, made.start, found.motion)
    assert said == f"it turns {how}"
