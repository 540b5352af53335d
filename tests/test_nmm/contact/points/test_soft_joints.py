"""Joints of a given stiffness that give way visibly: what they carry while pressed and sliding."""

import numpy as np
import pytest

import nmm
from nmm.formulation import parse_formulation

STIFFNESS = 1e7  # Pa/m
WEIGHT = 2000.0 * 9.81 * 0.5  # N for each metre of the sliding block, 0.5 m high

MESHES = {
    "blocks": "",
    "gauss": '[contact]\njoint_points = "gauss"\n',
    "quads": '[cover]\ntype = "quads"\nsize = 0.25\ndegree = 0\n',
}
TWO_BLOCKS = """
plane = "strain"

[materials.rock]
young_modulus = 1e11
poisson_ratio = 0.0
density = 2000

[interfaces.joint]
friction_angle = {friction}
normal_stiffness = {stiffness}
shear_stiffness = {stiffness}

[[blocks]]
name = "base"
material = "rock"
vertices = [[-1, -0.5], [3, -0.5], [3, 0], [-1, 0]]

[[blocks]]
name = "foot"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]

[[supports]]
name = "ground"
block = "base"
fix = ["x", "y"]

[[monitors]]
name = "right"
point = [1, 0]
block = "foot"

[[monitors]]
name = "left"
point = [0, 0]
block = "foot"

[contact]
"""


def run(scene, formulation=""):
    """The run of two texts."""
    return nmm.run(nmm.parse_scene(scene), parse_formulation(formulation))


@pytest.mark.parametrize("force", [1e2, 1e6], ids=["light", "4 mrad"])
def test_a_footing_beyond_its_core_is_carried_by_three_times_the_distance_of_its_force(force):
    text = (
        TWO_BLOCKS.format(stiffness=1e9, friction=0.5)
        + f"""
[[supports]]
name = "aside"
point = [0.5, 0]
fix = ["x"]

[[loads]]
name = "force"
kind = "point"
point = [0.75, 0.5]
force = [0, {-force}]
"""
    )
    done = run(text, '[cover]\ntype = "quads"\nsize = 0.05\ndegree = 1\n')
    # No tension: the pressure is a triangle of three times the distance of the force from the
    # edge, 0.25 m less what the footing of 0.5 m leans.
    slope = 0.0
    for _ in range(9):
        carried = 3 * (0.25 - 0.5 * slope)
        deepest = 2 * force / carried / 1e9
        slope = deepest / carried
    # Two points on each cell of 0.05 m, of which the last carries a part: (0.05 / 0.75)^2, 0.45 %.
    assert done.history["monitor:right:uy"][-1] == pytest.approx(-deepest, rel=6e-3)
    assert done.history["monitor:left:uy"][-1] == pytest.approx(slope - deepest, rel=2e-2)


@pytest.mark.parametrize("formulation", list(MESHES))
def test_a_block_on_a_soft_joint_slides_at_one_height(formulation):
    text = (
        TWO_BLOCKS.format(stiffness=STIFFNESS, friction=0.0)
        + """
[gravity]
[inertia]

[[loads]]
name = "push"
kind = "body"
block = "foot"
density = [2000, 0]

[[stages]]
name = "rest"
loads = []
supports = ["ground", "wall"]

[[stages]]
name = "slide"
loads = ["push"]
supports = ["ground"]
duration = 0.5
"""
    )
    text = text.replace("[[monitors]]", SIDE + "[[monitors]]", 1)
    done = run(text, MESHES[formulation] + "[integrator]\nstep = 5e-3\n")
    h = done.history
    height = np.array([h["monitor:left:uy"], h["monitor:right:uy"]]).mean(axis=0)
    assert h["monitor:left:ux"][-1] == pytest.approx(0.5 * 1.0 * 0.5**2, rel=2e-3)
    # The push at mid height turns the block by 1e-4: with the way slid, 0.1 m, that is 1 %, and
    # Gauss points stand for their face another way than its corners (3 %).
    assert height == pytest.approx(-WEIGHT / STIFFNESS, rel=4e-2)
    names = ("kinetic_energy", "strain_energy", "contact_energy", "support_energy")
    energy = sum(h[name] for name in names) - h["external_work"]
    # Springs hold 4.8 J as the joint is left; a step of 5 ms makes 2e-6 of the turnover, 130 J.
    assert np.diff(energy).max() < 5e-4


SIDE = """
[[supports]]
name = "wall"
segment = [[0, 0], [0, 0.5]]
block = "foot"
fix = ["x"]

"""


@pytest.mark.parametrize("formulation", list(MESHES))
def test_friction_on_a_soft_joint_holds_through_stages(formulation):
    aside = """
[[blocks]]
name = "aside"
material = "rock"
vertices = [[10, 0], [11, 0], [11, 1], [10, 1]]

[[supports]]
name = "held"
block = "aside"
fix = ["x", "y"]

[gravity]
acceleration = [3, -9.81]
"""
    stages = '[[stages]]\nname = "first"\n[[stages]]\nname = "next"\nremove = ["aside"]\n'
    stages += '[[stages]]\nname = "last"\n'
    text = TWO_BLOCKS.format(stiffness=STIFFNESS, friction=0.6) + aside + stages
    h = run(text, MESHES[formulation]).history
    way = h["monitor:left:ux"]
    # Weight over stiffness; the block turns and is deformed by some per cent of it.
    assert way[0] == pytest.approx(2000 * 3 * 0.5 / STIFFNESS, rel=0.2)
    # What two stages that change nothing may move: rounding, and the tolerance of contact.
    assert way[1:] == pytest.approx(way[0], rel=1e-6)
    assert h["change_energy"][-1] == pytest.approx(0.0, abs=1e-3 * h["contact_energy"][0])


@pytest.mark.parametrize("degree", [0, 1, 2])
def test_a_bar_is_as_stiff_across_a_joint_as_its_parts_and_the_joint_are(degree):
    bar = """
plane = "stress"

[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.0

[interfaces.joint]
friction_angle = 0.5
normal_stiffness = 1e10
shear_stiffness = 1e10

[[blocks]]
name = "left"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]

[[blocks]]
name = "right"
material = "rock"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]

[[supports]]
name = "wall"
segment = [[0, 0], [0, 1]]
fix = ["x", "y"]

[[loads]]
name = "push"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [-1e5, 0]

[[monitors]]
name = "end"
point = [2, 0.5]
block = "right"

[contact]
"""
    cover = f'[cover]\ntype = "quads"\nsize = 0.5\ndegree = {degree}\n'
    done = run(bar, cover)
    # Length over modulus, and one over the stiffness; a strain of 1e-4 and the springs of the
    # wall, 1e-4 of it. Forces at corners of cells add 2e-5 (degree 1) and 4e-5 m to 2.1e-4 m.
    assert done.history["monitor:end:ux"][-1] == pytest.approx(-1e5 * (2e-9 + 1e-10), rel=1e-3)


@pytest.mark.parametrize("bonds", ["auto", "spring"])
def test_a_core_hangs_in_a_ring_about_its_own_middle(bonds):
    """Joints as long as the way between middles on both sides of them; here both are on one."""
    ring, core = (
        [[-h, -h], [h, -h], [h, h], [-h, h]]  # half of a side, m
        for h in (2, 1)
    )
    text = (
        'plane = "stress"\n[gravity]\nacceleration = [0, -10]\n[contact]\n[materials.rock]\n'
        "young_modulus = 1e9\npoisson_ratio = 0.0\ndensity = 1000\n[interfaces.any]\n"
        "bonded = true\nfriction_angle = 0.5\ncohesion = 1e9\ntensile_strength = 1e9\n"
        f'[[blocks]]\nname = "ring"\nmaterial = "rock"\nvertices = {ring}\nholes = [{core}]\n'
        f'[[blocks]]\nname = "core"\nmaterial = "rock"\nvertices = {core}\n'
        '[[supports]]\nname = "held"\nblock = "ring"\nfix = ["x", "y"]\n'
        '[[monitors]]\nname = "core"\npoint = [0, 0]\nblock = "core"\n'
    )
    found = run(text, f'[contact]\nbonds = "{bonds}"\n')
    # The weight of 12 and 4 m2; two faces carry by pressure and two by shear, 2 m each, as springs
    # of half of the modulus over 2 m. The ring gives way by 1e-3 of that on its supports.
    assert found.history["reaction:held:y"][-1] == pytest.approx(16e4, rel=1e-9)
    if bonds == "spring":
        sinks = 4e4 / (4 * 2 * 0.5e9 / 2)
        assert found.history["monitor:core:uy"][-1] == pytest.approx(-sinks, rel=1e-3)
