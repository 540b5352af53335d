"""Contacts that are hardly there: no gap, a rounding's gap, corners on corners, near parallels."""

import numpy as np
import pytest

from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text
from nmm.verification.reading import energy_gain, joint_force, last_way, rates

UP = np.array([0.0, 1.0])
WEIGHT = 2600 * text.G


def done(head, tables):
    found = run(parse_scene(text.scene(head, [text.material("rock"), *tables])))
    assert found.summary.status == "converged", found.summary.sentence
    return found


@pytest.mark.parametrize("gap", [0.0, 1e-12, -1e-12, 1e-9, -1e-9])
@pytest.mark.parametrize(("step", "tolerance"), [(None, 1e-8), (0.01, 0.01)])
def test_gaps_of_rounding_do_not_matter(gap, step, tolerance):
    blocks = [
        text.box("low", (-0.5, gap), (1, 1)),
        text.box("top", (-0.3, 1 + 2 * gap), (0.6, 0.6)),
    ]
    found = done(text.weighty(step), [*text.floor(), *blocks])
    under = -joint_force(found, UP * gap, UP)[0]
    between = -joint_force(found, UP * (1 + 2 * gap), UP)[0]
    # Statics to rounding; in time the overshoot of a load put on at once, after twenty steps.
    assert under == pytest.approx(1.36 * WEIGHT, rel=tolerance)
    assert between == pytest.approx(0.36 * WEIGHT, rel=tolerance)


@pytest.mark.parametrize("tilt", [1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4])
def test_a_block_tilted_by_next_to_nothing_comes_to_lie_on_its_face(tilt):
    tilted = text.block("block", "rock", text.turned(text.rectangle((0, 0), (1, 1)), tilt))
    found = done(text.weighty(), [*text.floor(), tilted])
    # Its centre lies over the middle of the face but for the Poisson effect of a tilt of 1e-4.
    assert -found.contact_forces[:, 0] == pytest.approx([WEIGHT / 2, WEIGHT / 2], rel=1e-6)
    assert found.state.frames.angle[1] == pytest.approx(-tilt, abs=1e-9 + 1e-5 * tilt)


@pytest.mark.parametrize("aside", [0.0, 1e-13, 1e-10, -1e-10])
def test_a_corner_that_falls_on_a_joint_between_blocks_stays_there(aside):
    diamond = text.turned(text.rectangle((0, 0), (1, 1)), np.pi / 4) + np.array([aside, 0.05])
    tables = [
        text.interface("contact", 30.0),
        text.box("left", (-2, -1), (2, 1)),
        text.box("right", (0, -1), (2, 1)),
        text.fixed_block("left"),
        text.fixed_block("right"),
        text.block("diamond", "rock", diamond),
        text.monitor("middle", (aside, 0.6), "diamond"),
    ]
    found = done(text.weighty(1e-3, duration=0.3), tables)
    # Symmetric but for the shift: it falls 0.05 m and hops, upright.
    assert last_way(found, "middle")[0] == pytest.approx(0.0, abs=1e-9)
    assert -0.0501 < last_way(found, "middle")[1] < 0
    assert abs(rates(found)[-1, 2]) < 1e-8
    # Rounding of the work, 1e-9 of m g h.
    assert energy_gain(found) < 1e-9 * 0.05 * WEIGHT


@pytest.mark.parametrize("aside", [0.0, 1e-13, 1e-10, -1e-10])
def test_a_corner_that_falls_on_a_corner_tips_over_it_and_gains_no_energy(aside, tipped):
    peak = text.turned(text.rectangle((-1, -1), (0, 0)), np.pi / 4)
    diamond = text.turned(text.rectangle((0, 0), (1, 1)), np.pi / 4) + np.array([aside, 0.05])
    tables = [
        text.interface("contact", 0.0),
        text.block("peak", "rock", peak),
        text.fixed_block("peak"),
        text.block("diamond", "rock", diamond),
        text.monitor("centre", (aside, 0.05 + np.sqrt(0.5)), "diamond"),
    ]
    found = done(text.weighty(1e-3, duration=0.3), tables)
    assert energy_gain(found) < 1e-9 * 0.05 * WEIGHT
    # The blow falls within a step of 1 ms, at 1 m/s: 1 mm of the way; it hops, which turns it by
    # up to 1 % more.
    way, angle = tipped
    assert np.abs(last_way(found, "centre")) == pytest.approx(np.abs(way), abs=1e-3)
    assert abs(found.state.frames.angle[1]) == pytest.approx(abs(angle), rel=0.015)
    assert found.summary.largest_penetration < 1e-4


def shot(thickness, turn, integrator="shi"):
    """A block of 0.1 m flies at 100 m/s at a plate: in a step of 10 ms ten times its size; run."""
    shape = text.turned(text.rectangle((-0.05, -0.05), (0.05, 0.05)), turn) + np.array([0.3, 0.5])
    tables = [
        text.interface("contact", 20.0),
        text.box("plate", (-1, -thickness), (2, thickness)),
        text.fixed_block("plate"),
        text.block("block", "rock", shape),
        '[[initial_velocities]]\nblock = "block"\nvelocity = [0, -100]\n',
        text.monitor("middle", (0.3, 0.5), "block"),
    ]
    head = text.weighty(0.01, duration=0.1) + f'type = "{integrator}"\n'
    return done(head, tables)


@pytest.mark.parametrize("integrator", ["shi", "newmark", "generalized_alpha"])
@pytest.mark.parametrize("thickness", [0.05, 1e-3])
def test_a_fast_block_does_not_pass_through_a_thin_plate(thickness, integrator):
    found = shot(thickness, 0.3, integrator)
    assert 0.5 + last_way(found, "middle")[1] > 0
    assert rates(found)[1, 1] > 0


@pytest.mark.parametrize("turn", [0.0, np.pi / 4])
def test_a_fast_block_that_hits_head_on_needs_no_shorter_steps(turn):
    """It finds its partner before it crosses; without friction it would not turn either."""
    found = shot(1e-3, turn)
    assert found.summary.steps == 10
    assert 0.5 + last_way(found, "middle")[1] > 0


def test_springs_too_soft_for_a_fall_end_the_run_with_their_name():
    """A block that sinks deeper than a tenth of its thickness is not let through."""
    tables = [
        *text.floor(),
        text.box("block", (0, 0.001), (1, 1)),
        '[[initial_velocities]]\nblock = "block"\nvelocity = [0, -4.4]\n',
    ]
    scene = text.scene(text.weighty(1e-3, penalty=2e-5), [text.material("rock"), *tables])
    found = run(parse_scene(scene))
    assert found.summary.status == "failed"
    assert "normal_penalty" in found.summary.sentence
