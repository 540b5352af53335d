"""The answer does not depend on where the axes are, how blocks are numbered, or on the unit."""

import numpy as np
import pytest

from nmm.errors import SceneError
from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text
from nmm.verification.formulations import chosen
from nmm.verification.reading import last_way

SLOPE = np.radians(30)
# Half of g (sin 30 - cos 30 tan 20) times 0.5 s squared.
SLID = 1.81281473 * 0.125


def on_slope(
    friction, dynamic, turn=0.0, shift=(0.0, 0.0), scale=1.0, order=(0, 1), roll=0, form="dda"
):
    """A block of 1 m on a slope; way down the slope and away from it, and forces, in metres."""
    stretch = np.sqrt(scale)

    def place(low, high):
        return scale * text.turned(text.rectangle(low, high), SLOPE + turn) + shift

    base, block = place((0, -1), (6, 0)), place((4, 0), (5, 1))
    down = text.turned(np.array([[0.0, -text.G]]), turn)[0].tolist()
    time = f"duration = {float(0.5 * stretch)!r}\n[inertia]\n" if dynamic else ""
    corners = {"base": base, "block": block}
    blocks = [text.block(name, "rock", np.roll(each, roll, 0)) for name, each in corners.items()]
    scene = text.scene(
        f'plane = "strain"\n{time}[contact]\n[gravity]\nacceleration = {down}\n'
        "[formulation.contact]\nnormal_penalty = 100.0\n"
        f"[formulation.integrator]\nstep = {float(0.01 * stretch)!r}\n",
        [
            text.material("rock", modulus=20e9 * scale),
            text.interface("slope", friction),
            *(blocks[number] for number in order),
            text.fixed_block("base"),
            text.monitor("toe", block[0], "block"),
        ],
    )
    scene = parse_scene(scene)
    found = run(scene, chosen(form, scene.formulation))
    assert found.summary.status == "converged", found.summary.sentence
    way = text.turned(last_way(found, "toe")[None], -SLOPE - turn)[0] / scale
    return way, found.contact_forces.sum(axis=0) / scale**2


def held_weight(shift):
    """Vertical reaction of the base with the block at rest on it."""
    base, block = (
        text.turned(text.rectangle(*corners), SLOPE) + shift
        for corners in (((0, -1), (6, 0)), ((4, 0), (5, 1)))
    )
    scene = text.scene(
        text.weighty(),
        [
            text.material("rock"),
            text.interface("slope", 40.0),
            text.block("base", "rock", base),
            text.block("block", "rock", block),
            text.fixed_block("base"),
        ],
    )
    found = run(parse_scene(scene))
    assert found.summary.status == "converged", found.summary.sentence
    return found.history["reaction:hold base:y"][-1]


CHANGES = {
    "turned by 0.7": {"turn": 0.7},
    "turned by 90 degrees": {"turn": np.pi / 2},
    "numbered backwards": {"order": (1, 0)},
    "corners listed from the third": {"roll": 2},
    "a thousand times as large": {"scale": 1e3},
    "a thousandth as large": {"scale": 1e-3},
}


@pytest.fixture(scope="module")
def plain():
    return {
        (friction, dynamic): on_slope(friction, dynamic)
        for friction, dynamic in ((20.0, True), (40.0, False))
    }


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_sliding_block_goes_the_same_way(change, plain):
    way, force = on_slope(20.0, True, **change)
    # Rounding of coordinates over penetrations, 1e-16 over 6e-9, through 50 steps.
    assert way == pytest.approx(plain[20.0, True][0], abs=1e-10)
    assert force == pytest.approx(plain[20.0, True][1], rel=1e-6)


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_resting_block_gives_way_the_same(change, plain):
    way, force = on_slope(40.0, False, **change)
    # The same 1e-16, a few of them, of ways of 1e-8.
    assert way == pytest.approx(plain[40.0, False][0], abs=1e-14)
    assert force == pytest.approx(plain[40.0, False][1], rel=1e-8)


OTHERS = ("augmented", "lagrange", "cone", "barrier")
AWAY = {"a thousand kilometres away": {"turn": 0.7, "shift": (1e6, -1e6)}}


@pytest.mark.parametrize("form", OTHERS)
@pytest.mark.parametrize("change", (CHANGES | AWAY).values(), ids=CHANGES | AWAY)
def test_a_resting_block_is_held_the_same_by_every_enforcement(change, form):
    _, force = on_slope(40.0, False, form=form, **change)
    # Statics: weight along and across the slope; coordinates far away are rounded to 1e-10 m.
    weight = 2600 * text.G
    expected = [weight * np.cos(SLOPE), weight * np.sin(SLOPE)]
    assert -force == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("form", OTHERS)
def test_a_sliding_block_goes_the_way_of_its_friction_under_every_enforcement(form):
    way, force = on_slope(20.0, True, form=form)
    # Benchmark B2: position to 0.2 %; rate of the load put on at once besides, 1 %.
    assert way[0] == pytest.approx(-SLID, rel=2e-3)
    assert force[1] / force[0] == pytest.approx(np.tan(np.radians(20)), rel=1e-3)


@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_a_block_a_thousand_kilometres_from_the_origin_slides_the_same_way(turn):
    way, force = on_slope(20.0, True, turn, shift=(1e6, -1e6))
    # Coordinates are rounded to 1e-10 there, a fiftieth of the penetration; of the corners alone.
    assert way[0] == pytest.approx(-SLID, abs=2e-7 + 1e-10)
    assert abs(way[1]) < 1e-8
    weight = 2600 * text.G * np.cos(SLOPE)
    # The last step of Shi's rule overshoots by 0.1 %.
    assert -force == pytest.approx([weight, weight * np.tan(np.radians(20))], rel=2e-3)


@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_a_block_a_thousand_kilometres_from_the_origin_rests(turn):
    _, force = on_slope(40.0, False, turn, shift=(1e6, -1e6))
    weight = 2600 * text.G
    expected = [weight * np.cos(SLOPE), weight * np.sin(SLOPE)]
    # The sum is balanced by the solution to 1e-8, wherever the block is.
    assert -force == pytest.approx(expected, rel=1e-6)


def test_the_base_carries_all_weight():
    # Springs of 1000 E turn the rounding of coordinates, 1e-16, into 2e-3 N each.
    assert held_weight((0.0, 0.0)) == pytest.approx(7 * 2600 * text.G, rel=1e-6)


def test_a_base_a_thousand_kilometres_from_the_origin_carries_all_weight():
    # The same springs; worked on around an origin of its own, the scene is rounded no more.
    assert held_weight((1e6, -1e6)) == pytest.approx(7 * 2600 * text.G, rel=1e-6)


def dropped(shift, cover="block"):
    """History and last frame of a block that falls by 1/64 m and hops; numbers of few bits."""
    base, block = (
        text.rectangle(low, high) + shift for low, high in (((0, -1), (4, 0)), ((1, 0), (2, 1)))
    )
    scene = text.scene(
        'plane = "strain"\nduration = 0.25\n[inertia]\n[contact]\n'
        "[gravity]\nacceleration = [0, -8]\n[formulation.integrator]\nstep = 0.0078125\n",
        [
            text.material("rock", modulus=2.0**34, density=2048.0),
            text.interface("floor", 30.0),
            text.block("base", "rock", base),
            text.block("block", "rock", block + np.array([0, 2.0**-6])),
            text.fixed_block("base"),
            text.monitor("toe", block[0] + np.array([0, 2.0**-6]), "block"),
        ],
    )
    found = run(parse_scene(scene))
    assert found.summary.status == "converged", found.summary.sentence
    return found


def test_a_scene_moved_by_numbers_without_rounding_gives_the_same_bits():
    near, far = dropped(np.zeros(2)), dropped(np.array([2.0**20, -(2.0**21)]))
    # The origin of its own may differ from that of the scene near by: rounding of 1e-16 of 4 m,
    # times springs of 2e13 N/m on 1.6e4 N of weight.
    assert far.frames[-1].contact_force == pytest.approx(
        near.frames[-1].contact_force, rel=1e-6, abs=1e-3
    )
    for name, values in near.history.items():
        if name.startswith("monitor"):
            assert far.history[name] == pytest.approx(values, abs=1e-14)
    place = far.frames[-1].points - [2.0**20, -(2.0**21)]
    assert place == pytest.approx(near.frames[-1].points, abs=2.0**-31)
    assert far.topologies[0].elements.points - [2.0**20, -(2.0**21)] == pytest.approx(
        near.topologies[0].elements.points, abs=0
    )


def test_faults_far_from_the_origin_name_places_of_the_scene():
    """Blocks of materials without an interface, at 1e6 m."""
    clay = text.material("clay")
    blocks = [
        text.block(name, name, text.rectangle(low, high) + np.array([1e6, 0]))
        for name, low, high in (("rock", (0, 0), (1, 1)), ("clay", (0, 1), (1, 2)))
    ]
    interface = text.interface("only", 30.0, ("rock", "rock"))
    scene = text.scene(
        text.weighty(), [text.material("rock"), clay, interface, *blocks, text.fixed_block("rock")]
    )
    with pytest.raises(SceneError, match=r"\(100000[01], 1\)"):
        run(parse_scene(scene))
