"""Statics of ground under an initial stress far from balance: work is what is stored."""

import pytest

import nmm
from nmm.verification import text

BOND = {"bonded": True, "cohesion": 1e9, "tensile_strength": 1e9}
NET = '[formulation.cover]\ntype = "triangles"\nsize = 0.5\n'


def pressed(joint: dict[str, object], more: str, size: float = 1e5) -> "nmm.Run":
    """Two boxes on each other between walls, under a pressure (Pa) and a top that is free."""
    stress = '[[initial_stresses]]\nblock = "{}"\nstress = [{}, {}, 0]\n'
    wall = '[[supports]]\nname = "{0}"\nsegment = [[{0}, 0], [{0}, 2]]\nfix = ["x"]\n'
    tables = [
        text.material("rock", 1e9, 0.2, 2500.0),
        text.interface("joint", 30.0, more=joint),
        text.box("low", (0, 0), (2, 1)),
        text.box("top", (0, 1), (2, 1)),
        wall.format(0),
        wall.format(2),
        '[[supports]]\nname = "foot"\nsegment = [[0, 0], [2, 0]]\nfix = ["y"]\n',
        "[gravity]\nacceleration = [0, -9.81]\n",
        stress.format("low", -size, -size),
        stress.format("top", -size, -size),
        more,
    ]
    return nmm.run(nmm.parse_scene(text.scene('plane = "strain"\n[contact]\n', tables)))


@pytest.mark.parametrize("net", ["", NET], ids=["blocks", "triangles"])
@pytest.mark.parametrize(
    "joint",
    [{}, {"normal_stiffness": 1e10}, {**BOND, "normal_stiffness": 1e9}],
    ids=["touching", "joint", "bond"],
)
def test_forces_of_contacts_that_carry_an_initial_stress_are_withdrawn_evenly(joint, net):
    """It was 3e-3 to 0.19 without a word: what springs held from the start did no work."""
    summary = pressed(joint, net).summary
    # Corrections of the moved place leave 3e-8 where meshes touch.
    assert abs(summary.energy_balance) < 1e-6
    assert list(summary.warnings) == []


@pytest.mark.parametrize("degree", [1, 2])
def test_a_stress_of_forty_times_the_weight_springs_up_and_is_at_rest(degree):
    """Search lost contacts that push while they stand apart by what the stress had closed them."""
    run = pressed({}, f"{NET}degree = {degree}\n", size=1e6)
    assert run.summary.status == "converged"
    assert "brought to rest" not in run.summary.sentence
    weight = 2500.0 * 9.81 * 4.0
    assert run.history["reaction:foot:y"][-1] == pytest.approx(weight, rel=1e-6)
    assert abs(run.summary.energy_balance) < 1e-6
