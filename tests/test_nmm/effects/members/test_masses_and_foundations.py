"""Masses at points and springs under foundations against closed forms."""

import numpy as np
import pytest

import nmm
from nmm.testing import check_effect_of

SWING = """
plane = "strain"
duration = "0.05 s"
[materials.stone]
young_modulus = "50 GPa"
poisson_ratio = 0.2
density = 1000
[[blocks]]
name = "stone"
material = "stone"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[springs]]
name = "s"
points = [[-2, 0.5], [0, 0.5]]
blocks = ["ground", "stone"]
stiffness = "1 MN/m"
[[masses]]
name = "m"
point = [0.5, 0.5]
mass = "3 t"
[[initial_velocities]]
block = "stone"
velocity = [0.1, 0]
[inertia]
[formulation.integrator]
type = "newmark"
step = "1 ms"
"""


def test_a_mass_at_a_point_slows_the_swing_of_its_block():
    found = nmm.run(nmm.parse_scene(SWING))
    omega = np.sqrt(1e6 / 4000)
    exact = 0.1 / omega * 1e6 * np.sin(omega * found.history["time"])
    # As for two masses: the first step is off by w dt / 4 once.
    error = np.abs(found.history["springs:s:force"] - exact).max()
    assert error / np.abs(exact).max() < 5e-3
    assert found.history["kinetic_energy"][0] == pytest.approx(4000 * 0.1**2 / 2, rel=1e-3)


def test_a_mass_falls_with_its_block_and_its_momentum_is_known():
    text = SWING.replace("[[springs]]", "[gravity]\n[[springs]]").replace("1 MN/m", "1e-20 N/m")
    text = text.replace("[inertia]", '[[monitors]]\nname = "p"\npoint = [0, 0]\n[inertia]')
    text = text.replace('blocks = ["ground", "stone"]', 'blocks = ["stone", "stone"]')
    text = text.replace("[[-2, 0.5], [0, 0.5]]", "[[0, 0], [1, 0]]").replace("[0.1, 0]", "[0, 0]")
    found = nmm.run(nmm.parse_scene(text))
    assert found.history["monitor:p:uy"][-1] == pytest.approx(-9.81 * 0.05**2 / 2, rel=1e-6)
    assert found.summary.audits["momentum"] < 1e-10
    assert abs(found.summary.energy_balance) < 1e-10


RAFT = """
plane = "strain"
[materials.raft]
young_modulus = "30000 GPa"
poisson_ratio = 0.0
density = 2500
[[blocks]]
name = "raft"
material = "raft"
vertices = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[foundations]]
name = "soil"
segment = [[0, 0], [4, 0]]
normal_stiffness = "10 MPa/m"
shear_stiffness = "5 MPa/m"
{more}
[[loads]]
name = "load"
kind = "point"
point = [{x}, 1]
force = ["40 kN", "-400 kN"]
[[monitors]]
name = "left"
point = [0, 0]
[[monitors]]
name = "right"
point = [4, 0]
"""


def test_a_rigid_raft_settles_and_tilts_as_its_springs_ask():
    found = nmm.run(nmm.parse_scene(RAFT.format(more="", x=2.5)))
    left, right = (found.history[f"monitor:{n}:uy"][-1] for n in ("left", "right"))
    assert (left + right) / 2 == pytest.approx(-400e3 / 40e6, rel=1e-4)
    moment = 400e3 * 0.5 + 40e3 * 1.0
    assert (left - right) / 4 == pytest.approx(moment / (10e6 * 4**3 / 12), rel=1e-4)
    assert found.history["monitor:left:ux"][-1] == pytest.approx(40e3 / 20e6, rel=1e-4)


COVERS = {
    "block": "",
    "triangles": '[formulation.cover]\ntype = "triangles"\nsize = 0.8\n',
    "cubic": '[formulation.cover]\ntype = "quads"\nsize = 2.0\ndegree = 3\n',
}


@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize("carries", ["both", "compression"])
def test_forces_of_a_foundation_are_those_of_its_whole_edge(cover, carries):
    """It bears the load, however many points it is integrated at; its edge falls by 30 degrees."""
    turn = np.array([[0.75**0.5, 0.5], [-0.5, 0.75**0.5]])  # rows: along the edge, out of the raft
    corners, out = np.array([[0, 0], [4, 0], [4, 1], [0, 1]]) @ turn, [40e3, -400e3] @ turn
    text = RAFT.format(more=f'carries = "{carries}"', x=2.5)
    for given, there in (
        ("[[0, 0], [4, 0], [4, 1], [0, 1]]", corners),
        ("[[0, 0], [4, 0]]", corners[:2]),
        ("[4, 0]", corners[1]),
        ("[2.5, 1]", np.array([2.5, 1]) @ turn),
        ('["40 kN", "-400 kN"]', out),
    ):
        assert given in text
        text = text.replace(given, str(there.tolist()))
    found = nmm.run(nmm.parse_scene("thickness = 0.2\n" + text + COVERS[cover])).history
    # Equilibrium, to the residual of statics.
    assert found["foundations:soil:x"][-1] == pytest.approx(-out[0], rel=1e-8)
    assert found["foundations:soil:y"][-1] == pytest.approx(-out[1], rel=1e-8)
    assert found["foundations:soil:force"][-1] == pytest.approx(-400e3, rel=1e-8)


def test_a_foundation_without_tension_lets_the_far_edge_lift_off():
    more = 'carries = "compression"'
    found = nmm.run(nmm.parse_scene(RAFT.format(more=more, x=3.5).replace("40 kN", "0 N", 1)))
    left, right = (found.history[f"monitor:{n}:uy"][-1] for n in ("left", "right"))
    # A triangle of pressure over three times the distance to the edge: 1.5 m, 2 F / (3 c k).
    assert right == pytest.approx(-2 * 400e3 / (1.5 * 10e6), rel=0.03)
    assert left > 0
    assert -right / (left - right) * 4 == pytest.approx(1.5, rel=0.03)


@pytest.mark.parametrize("effect", ["foundations", "loads"])
def test_foundations_keep_what_every_effect_promises(effect):
    check_effect_of(nmm.parse_scene(RAFT.format(more="", x=2.5)), effect)


def test_masses_keep_what_every_effect_promises():
    check_effect_of(nmm.parse_scene(SWING.replace("[inertia]", "[inertia]\n[gravity]")), "masses")


STAGED = """
plane = "strain"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[gravity]
acceleration = [0, -10]
[[blocks]]
name = "fill"
material = "rock"
vertices = [[3, 0], [4, 0], [4, 1], [3, 1]]
[[blocks]]
name = "pier"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 2], [0, 2]]
[[masses]]
name = "machine"
point = [0.5, 2]
block = "pier"
mass = 500
[[supports]]
name = "left"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[supports]]
name = "right"
segment = [[3, 0], [4, 0]]
fix = ["x", "y"]
[[stages]]
name = "both"
[[stages]]
name = "dug"
remove = ["fill"]
supports = ["left"]
"""


def test_a_mass_weighs_on_its_block_when_one_listed_before_it_has_left():
    found = nmm.run(nmm.parse_scene(STAGED))
    assert found.summary.status == "converged", found.summary.sentence
    # The pier's 2 m2 of 2000 kg/m3 and the machine; supports are springs to rounding.
    assert found.history["reaction:left:y"][-1] == pytest.approx((4000 + 500) * 10, rel=1e-9)
