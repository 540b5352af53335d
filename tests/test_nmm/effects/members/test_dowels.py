"""Dowels: the beam on its bed on both sides of a joint, yielding, turning; bars that cross none."""

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError
from nmm.verification import text

# BO4: d = 25 mm, E = 200 GPa, k = 50 MPa: l = 7.55592296 / m, V = 20 kN slides by 12.089477 mm.
SLIDES, SHEAR, MOMENT = 12.089477e-3, 20e3, 853.362


def turned(points, angle):
    """Turn points (k, 2) about the origin."""
    c, s = np.cos(angle), np.sin(angle)
    return (np.asarray(points, dtype=float) @ np.array([[c, s], [-s, c]])).tolist()


def joint(way, angle=0.0, dowel="", bar="", points=((-0.9, 0.1), (0.9, 0.1))):
    """Scene of two blocks side by side, the right one moved along the joint between them."""
    c, s = np.cos(angle), np.sin(angle)
    sides = [
        text.block(name, "rock", turned(text.rectangle(*corners), angle))
        for name, corners in (("left", ((-1, -0.5), (0, 0.5))), ("right", ((0, -0.5), (1, 0.5))))
    ]
    moved = [float(-s * way), float(c * way)]
    held = [
        f'[[supports]]\nname = "{name}"\nblock = "{name}"\nfix = ["x", "y"]\n{ways}'
        for name, ways in (("left", ""), ("right", f"displacement = {moved}\n"))
    ]
    steel = f'diameter = "25 mm"\nyoung_modulus = "200 GPa"\nends = "free"\n{bar}'
    return text.scene(
        'title = "dowel"\nplane = "stress"\n[loading]\n[formulation.loading]\nincrement = 0.25\n',
        [
            text.material("rock", modulus=1e13, density=None),
            *sides,
            *held,
            f'[[bars]]\nname = "bolt"\npoints = {turned(points, angle)}\n{steel}\n'
            "bond = { stiffness = 1 }\n"
            f'[bars.dowel]\nbedding_stiffness = "50 MPa"\n{dowel}',
        ],
    )


def ran(scene):
    return nmm.run(nmm.parse_scene(scene, "scene"))


@pytest.mark.parametrize("angle", [0.0, 0.5, 2.0])
def test_a_joint_that_slides_is_resisted_by_the_beam_on_its_bed(angle):
    """V = k w / (4 l), M = 0.3224 V / l: what the blocks strain is 1e-5 of it."""
    run = ran(joint(SLIDES, angle))
    # The way turns the link of 0.13 m by nothing in small displacements.
    assert run.history["dowels:bolt:shear"][-1] == pytest.approx(SHEAR, rel=1e-4)
    assert run.history["dowels:bolt:moment"][-1] == pytest.approx(MOMENT, rel=1e-4)


def test_the_other_way_the_shear_has_the_other_sign():
    assert ran(joint(-SLIDES)).history["dowels:bolt:shear"][-1] == pytest.approx(-SHEAR, rel=1e-4)


def test_supports_carry_what_the_dowel_does_along_the_joint():
    run = ran(joint(SLIDES))
    assert run.history["reaction:right:y"][-1] == pytest.approx(SHEAR, rel=1e-3)


def test_a_dowel_yields_and_what_it_takes_is_told():
    run = ran(joint(SLIDES, dowel='yield_force = "5 kN"'))
    assert run.history["dowels:bolt:shear"][-1] == pytest.approx(5e3, rel=1e-4)
    # 5 kN over the way beyond a quarter of it; elastic energy is left.
    assert run.history["loss:dowels"][-1] == pytest.approx(5e3 * 0.75 * SLIDES, rel=0.01)


def test_a_bending_stiffness_of_its_own_counts():
    """V goes with (E I)^(1/4): sixteen times gives twice."""
    given = f"bending_stiffness = {16 * 200e9 * np.pi * 0.025**4 / 64:.9g}"
    found = ran(joint(SLIDES, dowel=given)).history["dowels:bolt:shear"][-1]
    assert found == pytest.approx(2 * SHEAR, rel=1e-3)


def test_bars_in_the_thickness_add_up():
    run = ran(joint(SLIDES, bar="number = 2.5"))
    assert run.history["dowels:bolt:shear"][-1] == pytest.approx(2.5 * SHEAR, rel=1e-3)


def test_a_bar_that_crosses_no_joint_resists_none():
    run = ran(joint(SLIDES, points=((0.1, 0.1), (0.9, 0.1))))
    assert run.history["dowels:bolt:shear"][-1] == 0.0


def test_blocks_that_turn_together_feel_no_dowel():
    """Two blocks that fly about their common middle, held together by the bar, by 0.15 rad.

    The bar pulls with 11 kN, twice that as it comes at once, and turns by what steps do: the shear
    is a thousandth of it.
    """
    sides = [
        text.block(name, "rock", text.rectangle(*corners))
        for name, corners in (("left", ((-1, -0.5), (0, 0.5))), ("right", ((0, -0.5), (1, 0.5))))
    ]
    spins = [
        f'[[initial_velocities]]\nblock = "{name}"\nvelocity = [0, {speed}]\n'
        "angular_velocity = 3.0\n"
        for name, speed in (("left", -1.5), ("right", 1.5))
    ]
    bar = (
        '[[bars]]\nname = "bolt"\npoints = [[-0.5, 0], [0.5, 0]]\nblocks = ["left", "right"]\n'
        'diameter = "25 mm"\nyoung_modulus = "200 GPa"\n'
        '[bars.dowel]\nbedding_stiffness = "50 MPa"\n'
    )
    head = 'title = "flight"\nplane = "stress"\nduration = 0.05\n[inertia]\n'
    rock = text.material("rock", modulus=1e11, density=2500.0)
    run = ran(text.scene(head, [rock, *sides, *spins, bar]))
    assert run.state.frames.angle == pytest.approx([0.15, 0.15], abs=1e-3)
    assert abs(run.history["dowels:bolt:shear"]).max() < 25.0


@pytest.mark.parametrize(
    ("dowel", "said"),
    [
        ("yield_force = 0", "yield_force"),
        ("bending_stiffness = -1", "bending_stiffness"),
        ("stiffness = 1", "stiffness"),
    ],
)
def test_what_is_no_dowel_is_refused_by_line(dowel, said):
    with pytest.raises(NmmError, match=f"scene:[0-9]+: .*{said}"):
        ran(joint(SLIDES, dowel=dowel))


def test_an_area_alone_says_nothing_of_bending():
    scene = joint(SLIDES).replace('diameter = "25 mm"', "area = 1e-3\nperimeter = 0.1")
    with pytest.raises(NmmError, match="bending_stiffness"):
        ran(scene)
