"""Paths past the peak against closed forms: bars that snap back, bundles, columns, a zipper."""

import numpy as np
import pytest

import nmm
from nmm.controls.base import CONTROLS
from nmm.scene import parse_scene
from nmm.testing import check_control
from nmm.testing.resumed.stopping import check_goes_on
from nmm.verification.problems.past_the_peak.lever import Lever
from nmm.verification.problems.past_the_peak.links import bundle, pull
from nmm.verification.problems.past_the_peak.softening_bar import (
    AREA,
    ENERGY,
    MODULUS,
    STRENGTH,
    softening_bar,
)

PARTS = 'type = "dissipation"\nenergy = 2e-4\n'
STIFF = "bonded = true\nnormal_stiffness = 1e13\nshear_stiffness = 1e13"


@pytest.mark.parametrize("ratio", [0.5, 2.0])
def test_steps_that_each_dissipate_the_same_go_round_the_same_path(ratio):
    length = ratio * 2 * MODULUS * ENERGY / STRENGTH**2
    total = ENERGY * AREA
    control = f'type = "dissipation"\nenergy = {total / 10!r}\nend_energy = {0.95 * total!r}\n'
    run = nmm.run(parse_scene(softening_bar(length, ENERGY, control)))
    assert run.summary.failure_factor == pytest.approx(300.0, rel=1e-8)
    # Steps that were cut take a half, a quarter, ... of it.
    lost = np.diff(run.history["friction_loss"])
    assert lost.max() == pytest.approx(total / 10, rel=1e-3)
    assert run.history["friction_loss"][-1] == pytest.approx(0.95 * total, rel=1e-3)
    # A linear law unloading to its origin dissipates ft w / 2: of the load a twentieth is left.
    assert run.history["load_factor"][-1] == pytest.approx(0.05 * 300, rel=5e-3)


def test_links_that_are_driven_soften_by_what_each_step_takes():
    """One softens beside one that holds: the force of the springs that drive both is no load."""
    strength, stiff, opens = 100.0, 5e6, 2 * 0.06 / 1e3  # N, N/m, m at which nothing is left
    energy = 1e-3
    parts = f'type = "dissipation"\nenergy = {energy}\n'
    links = bundle((strength, 200.0), parts, (stiff, stiff))
    soft = '[interfaces.i0]\nlaw = "linear_softening"\nfracture_energy = 0.06\n'
    run = nmm.run(parse_scene(links.replace("[interfaces.i0]\n", soft)))
    factor, force, lost = run.history["load_factor"], pull(run, 2), run.history["friction_loss"]
    whole = run.history["broken"] == 0
    # A line that unloads to its origin loses strength * w / 2; supports give by 3e-4 of a link.
    width = np.arange(whole.sum() - 1) * energy * 2 / strength
    way = width + strength * (1 - width / opens) / stiff
    held = strength * (1 - width / opens) + stiff * way
    assert force[whole][:-1] == pytest.approx(held, rel=1e-4)
    assert 1e-6 * factor[whole][:-1] == pytest.approx(way, rel=1e-4)
    # The other breaks at once at 40 um, where both stand still, and sheds the half of 200 N.
    at = int(whole.sum())
    assert factor[at] == pytest.approx(factor[at - 1], rel=1e-4)
    assert force[at - 1] - force[at] == pytest.approx(200.0, rel=1e-4)
    assert lost[at] - lost[at - 1] == pytest.approx(200 * 40e-6 / 2, rel=1e-3)
    # What softens goes on alone, to less than a step of its energy.
    assert force[at:].min() < 0.2 * strength


def test_brittle_links_break_under_dissipation_as_they_do_under_a_displacement():
    """Forces before and after each break by the stiffness that is left, and an end when none is."""
    run = nmm.run(parse_scene(bundle((200.0, 250.0, 400.0), PARTS, (20e6, 10e6, 5e6))))
    expected = [350, 150, 375, 125, 400, 0]
    assert pull(run, 3) == pytest.approx(expected, abs=0.1)  # supports give by 3e-4 of a link
    assert run.summary.status == "failure_load"


def test_links_of_one_strength_break_in_one_event():
    run = nmm.run(parse_scene(bundle((1.0, 2.0, 1.0), 'type = "events"\n')))
    assert pull(run, 3)[:2] == pytest.approx([3.0, 2.0], rel=1e-6)
    assert run.history["broken"][1] == 4


@pytest.mark.parametrize("apart", [1e-15, 1e-10, 1e-6, 1e-4])
def test_links_of_nearly_one_strength_break_as_their_strengths_tend_to_each_other(apart):
    run = nmm.run(parse_scene(bundle((1.0, 1.0 + apart), 'type = "events"\n')))
    assert pull(run, 2)[0] == pytest.approx(2.0, rel=1e-6)


def test_a_path_finds_the_next_event_after_a_joint_came_apart():
    """The first link is wide open when the second is at its limit: 1 and 8 mm on the way."""
    control = 'type = "displacement"\nmonitors = ["top"]\ndirection = [0, 1]\n'
    run = nmm.run(parse_scene(bundle((1e3, 8e3), control + 'increment = "1.5 mm"\nend = "9 mm"\n')))
    breaks = np.flatnonzero(np.diff(run.history["broken"]) > 0)
    assert run.history["load_factor"][breaks] == pytest.approx([1e3, 8e3], rel=1e-2)


def test_a_brittle_bar_is_followed_back_to_nothing_under_no_control_of_its_own():
    control = 'type = "displacement"\nmonitors = ["end"]\nincrement = "50 um"\nend = "0.2 mm"\n'
    run = nmm.run(parse_scene(softening_bar(1.0, None, control)))
    assert run.summary.failure_factor == pytest.approx(300.0, rel=1e-8)
    force, way = run.history["load_factor"], run.history["monitor:end:ux"]
    peak = int(force.argmax())
    assert way[peak] == pytest.approx(1e-4, rel=2e-2)


# Twice as long as a bar that just does not snap back.
BAR = 4 * MODULUS * ENERGY / STRENGTH**2
MOVED = 'type = "displacement"\nmonitors = ["end"]\nincrement = "50 um"\nend = "0.2 mm"\n'
TAKEN = ENERGY * AREA
DISSIPATED = f'type = "dissipation"\nenergy = {TAKEN / 10!r}\nend_energy = {0.95 * TAKEN!r}\n'


class LeverOnTwo(Lever):
    """A lever that two links hold, in place of five: its path has the same kind of events."""

    places = (0.5, 1.0)


CONTROLLED = {
    "opening": lambda: nmm.read_scene("examples/snap_back/bar.toml"),
    "displacement": lambda: parse_scene(softening_bar(1.0, None, MOVED)),
    "dissipation": lambda: parse_scene(softening_bar(BAR, ENERGY, DISSIPATED)),
    "events": lambda: parse_scene(LeverOnTwo().scene()),
}


@pytest.mark.parametrize("name", CONTROLS.table)
def test_every_control_keeps_what_controls_promise(name):
    check_control(CONTROLLED[name]())


@pytest.mark.parametrize(
    ("table", "fault"),
    [
        ('type = "opening"\nmonitors = ["end"]\nincrement = 1e-6\n', "1 monitors"),
        ('type = "displacement"\nmonitors = ["end"]\n', "without increment"),
        ('type = "displacement"\nmonitors = ["nobody"]\nincrement = 1e-6\n', '"nobody"'),
        ('type = "dissipation"\nenergy = -1\n', "energy"),
        ('type = "evnts"\n', "evnts"),
        ('type = "events"\ndirection = [0, 0]\n', "direction"),
    ],
)
def test_a_control_at_fault_is_told_before_anything_runs(table, fault):
    with pytest.raises(nmm.NmmError) as error:
        nmm.run(parse_scene(softening_bar(1.0, ENERGY, table)))
    assert fault in str(error.value)


@pytest.mark.parametrize("control", ['type = "events"\n', 'type = "dissipation"\nenergy = 1e-3\n'])
def test_a_path_that_no_bond_begins_is_refused(control):
    """Bonds that soften on a stiffness of their own come to no limit: there would be no step."""
    scene = softening_bar(1.0, ENERGY, control).replace("bonded = true", STIFF)
    with pytest.raises(nmm.NmmError, match="no bond breaks"):
        nmm.run(parse_scene(scene))


@pytest.mark.parametrize("every", [1, 3])
@pytest.mark.parametrize(
    "control",
    [
        'type = "dissipation"\nenergy = 2e-3\nend_energy = 9e-3\n',
        'type = "opening"\nmonitors = ["one", "other"]\nincrement = "5 um"\nend = "60 um"\n',
    ],
)
def test_a_path_that_was_stopped_goes_on_bit_by_bit(control, every, tmp_path):
    more = f"[output.checkpoint]\nevery_steps = {every}\n"
    check_goes_on(parse_scene(softening_bar(1.0, ENERGY, control, more=more)), tmp_path)


@pytest.mark.parametrize(
    "control",
    [
        'type = "events"\n',
        'type = "displacement"\nmonitors = ["top"]\ndirection = [0, 1]\n'
        'increment = "0.1 mm"\nend = "2 mm"\n',
    ],
)
def test_a_path_on_which_links_break_one_by_one_goes_on_bit_by_bit(control, tmp_path):
    more = "\n[output.checkpoint]\nevery_steps = 1\n"
    scene = bundle((1e3, 2e3, 1.5e3), control) + more
    run = check_goes_on(parse_scene(scene), tmp_path)
    assert run.history["broken"].max() == 4


@pytest.mark.parametrize("more", ['[formulation.contact]\nenforcement = "lagrange"\n'])
def test_a_path_without_springs_of_contact_is_refused(more):
    with pytest.raises(nmm.NmmError, match=r"loading\.control"):
        nmm.run(parse_scene(softening_bar(1.0, ENERGY, 'type = "events"\n', more=more)))


@pytest.mark.parametrize(
    "control", ['type = "events"\n', 'type = "dissipation"\nenergy = 42\nend_energy = 200\n']
)
def test_reactions_balance_the_load_where_a_step_to_the_first_event_turns_blocks(control):
    run = nmm.run(
        parse_scene(
            f"""
plane = "strain"

[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2

[interfaces.joint]
friction_angle = 0.0
bonded = true
cohesion = 6e5
tensile_strength = 3e5

[[blocks]]
material = "rock"
vertices = [[0, 0], [6, 0], [6, 3], [0, 4]]

[[blocks]]
material = "rock"
vertices = [[0, 4], [6, 3], [6, 6], [0, 6]]

[[supports]]
name = "ground"
segment = [[0, 0], [6, 0]]
fix = ["x", "y"]

[[loads]]
kind = "edge"
name = "wind"
segment = [[0, 6], [6, 6]]
traction = [-11e3, -12e3]

[loading]
until = "failure"
[loading.control]
{control}
[contact]
"""
        )
    )
    h = run.history
    for axis, traction in (("x", -11e3), ("y", -12e3)):
        # Points move by 2 cm, blocks turn by 3 mrad: stiff supports were out of balance by a half.
        # A correction ends as it moves 1e-8 of that, under springs 1e3 times as stiff as blocks.
        held = np.array(h[f"reaction:ground:{axis}"])
        assert held[0] == pytest.approx(-6 * traction * h["load_factor"][0], rel=1e-6)


def test_a_path_is_followed_once_from_each_state(monkeypatch):
    from nmm.stepping.control import limit_point as room

    asked = []
    monkeypatch.setattr(room, "limit_point", lambda stepper, state, factor: asked.append(factor))
    seek, first, then = room.LimitPoints(None), object(), object()
    for state, factor in ((first, 2.0), (first, 1.5), (first, 3.0), (then, 1.5)):
        assert seek(state, factor) is None
    # A shorter part of a path without a limit point has none either.
    assert asked == [2.0, 3.0, 1.5]


@pytest.mark.parametrize(("way", "sign"), [([0, 1], 1.0), ([0, -1], -1.0)])
def test_a_path_counts_from_where_weight_has_been_borne(way, sign):
    """A bar of E A / L = 1e6 N/m sinks by rho g L^2 / 2 E = 0.25 mm and is led on from there."""
    run = nmm.run(
        parse_scene(
            f"""
plane = "stress"

[materials.rock]
young_modulus = 1e7
poisson_ratio = 0.0
density = 500

[interfaces.joint]
friction_angle = 0.0
bonded = true
cohesion = 1e9
tensile_strength = 1e9

[[blocks]]
name = "bar"
material = "rock"
vertices = [[0, 0], [0.1, 0], [0.1, 1], [0, 1]]

[[blocks]]
name = "foot"
material = "rock"
vertices = [[0, -0.01], [0.1, -0.01], [0.1, 0], [0, 0]]

[[supports]]
name = "held"
block = "foot"
fix = ["x", "y"]

[[monitors]]
name = "top"
block = "bar"
point = [0.05, 1.0]

[[loads]]
name = "pull"
kind = "edge"
segment = [[0, 1], [0.1, 1]]
traction = [0, 1e3]

[gravity]
acceleration = [0, -10]

[contact]

[formulation.cover]
type = "quads"
size = 0.1

[loading]
until = "failure"

[loading.control]
type = "displacement"
monitors = ["top"]
direction = {way}
increment = "0.1 mm"
end = "0.4 mm"
"""
        )
    )
    sunk = run.history["monitor:top:uy"][0]
    assert sunk == pytest.approx(-2.5e-4, rel=0.02)
    # From there by 0.1 mm a step: 1e6 N/m over a load of 100 N.
    assert run.history["monitor:top:uy"] - sunk == pytest.approx(
        sign * np.linspace(0, 4e-4, 5), abs=1e-8
    )
    assert run.history["load_factor"] == pytest.approx(sign * np.arange(5.0), rel=0.02, abs=1e-9)
    assert run.summary.status == "converged"
