"""Rigid bodies that an exact enforcement throws apart by where in a step they meet are told."""

import pytest

import nmm
from nmm.verification import text

STEP, SPEED = 1e-3, 1.0
"""Of ten times what waves take through a block (s), and of the one that hits (m/s)."""


@pytest.mark.parametrize("enforcement", ["cone", "lagrange"])
@pytest.mark.parametrize("share", [0.25, 0.5, 0.75])
def test_the_energy_with_which_two_blocks_part_is_that_of_where_in_a_step_they_met(
    share, enforcement
):
    gap = (5 + share) * STEP * SPEED
    tables = [
        text.material("rock", 1e14, 0.0, 2000.0),
        "[interfaces.any]\nfriction_angle = 0.0\n",
        text.box("hits", (0, 0), (1, 1)),
        text.box("waits", (1 + gap, 0), (1, 1)),
        f'[[initial_velocities]]\nblock = "hits"\nvelocity = [{SPEED}, 0]\n',
    ]
    head = 'plane = "stress"\nduration = 0.01\n[contact]\n[inertia]\n'
    table = {
        "contact": {"enforcement": enforcement},
        "integrator": {"type": "newmark", "step": STEP},
    }
    run = nmm.run(nmm.parse_scene(text.scene(head, tables)), nmm.Formulation.model_validate(table))
    # The way s v dt that is left of the gap is closed at a mean of v and w = (2 s - 1) v: they part
    # at |w| in this step or the next. A corner of two squares bears m / 5, all energy is m v^2 / 2.
    parted = (2 * share - 1) ** 2 / 5
    assert run.summary.audits["rebound_in_step"] == pytest.approx(parted, rel=1e-3, abs=1e-6)
    told = [one for one in run.summary.warnings if "audit rebound_in_step" in one]
    assert len(told) == (share != 0.5)
    assert all("hits and waits" in one or "waits and hits" in one for one in told)
