"""What loads do along a path and what its bonds take hang on no step."""

import math

import pytest

import nmm
from nmm.scene.read import parse_scene
from nmm.verification import text


def pulled(increment: float) -> "nmm.Run":
    """Two stiff squares of 1 m are pulled 3 mm apart; their joint bears 100 kPa, then softens."""
    bond = {
        "bonded": True,
        "cohesion": 1e6,
        "tensile_strength": 1e5,
        "fracture_energy": 100.0,
    }
    held = '[[supports]]\nname = "{}"\nsegment = [[{}, 0], [{}, 1]]\nfix = {}\n'
    control = (
        '[loading]\nuntil = "failure"\n[loading.control]\ntype = "displacement"\nfall = 0.0\n'
        f'monitors = ["end"]\ndirection = [1, 0]\nincrement = {increment}\nend = 3e-3\n'
    )
    tables = [
        text.material("rock", 1e12, 0.0),
        text.interface("joint", 30.0, more=bond) + 'law = "bilinear_softening"\n',
        text.box("a", (0, 0), (1, 1)),
        text.box("b", (1, 0), (1, 1)),
        held.format("left", 0, 0, '["x", "y"]'),
        held.format("right", 2, 2, '["y"]'),
        '[[loads]]\nname = "pull"\nkind = "edge"\nsegment = [[2, 0], [2, 1]]\n'
        "traction = [1e5, 0]\n",
        text.monitor("end", (2, 0.5), "b"),
        control,
    ]
    return nmm.run(parse_scene(text.scene('plane = "strain"\n[contact]\n', tables)))


@pytest.mark.parametrize("increment", [1e-3, 0.7e-3, 0.1e-3])
def test_work_is_the_area_under_the_curve_whatever_the_steps(increment):
    """Petersson's chords to 0.8 and 3.6 mm: 0.6 / 8.4 of the strength is left at 3 mm."""
    history = pulled(increment).history
    left = 0.6 / 8.4
    area = 1e5 * (0.8e-3 * (1 + 1 / 3) / 2 + 2.2e-3 * (1 / 3 + left) / 2)
    # Squares stretch by 2e-7 m; the knee lies within steps of 1 and 0.7 mm.
    assert history["external_work"][-1] == pytest.approx(area, rel=1e-4)
    taken = area - 1e5 * left * 3e-3 / 2
    assert history["friction_loss"][-1] == pytest.approx(taken, rel=1e-4)


ROPE, WAY, FRICTION = 1e3, 0.02, 1000 * 9.81 * math.tan(math.radians(20))
"""Stiffness of a spring that holds a block aside (N/m), its way (m), its friction (N)."""


@pytest.mark.parametrize(("increment", "rope"), [(WAY, ROPE), (WAY / 4, ROPE), (WAY / 4, 0.0)])
def test_friction_takes_its_force_times_the_way_from_the_first_step_on(increment, rope):
    """The load is friction as soon as the block slides, and half of it the first step's mean.

    Without the rope friction alone holds the block, by nothing before its weight presses.
    """
    held = (
        '[[springs]]\nname = "rope"\npoints = [[1, 0.1], [3, 0.1]]\n'
        f'blocks = ["block", "ground"]\nstiffness = {rope}\n'
    )
    tables = [
        text.material("rock", 1e9, 0.2, 1000.0),
        text.interface("joint", 20.0),
        text.box("slab", (-1, -1), (3, 1)),
        text.box("block", (0, 0), (1, 1)),
        text.fixed_block("slab"),
        '[[loads]]\nname = "push"\nkind = "point"\npoint = [0, 0.1]\nblock = "block"\n'
        "force = [1000, 0]\n",
        *([held] if rope else []),
        text.monitor("middle", (0.5, 0.5), "block"),
        '[loading]\nscaled = ["push"]\nuntil = "failure"\n[loading.control]\n'
        'type = "displacement"\nmonitors = ["middle"]\ndirection = [1, 0]\n'
        f"increment = {increment}\nend = {WAY}\n",
    ]
    run = nmm.run(parse_scene(text.scene('plane = "stress"\n[gravity]\n[contact]\n', tables)))
    work = run.history["external_work"][-1] - run.history["external_work"][0]
    # The block is in balance under its weight at first. It strains, and slides less, by 1e-5 m.
    assert run.history["friction_loss"][-1] == pytest.approx(FRICTION * WAY, rel=1e-3)
    assert work == pytest.approx(FRICTION * WAY + rope * WAY**2 / 2, rel=1e-3)
    assert abs(run.summary.energy_balance) < 1e-4
