"""What a stepper keeps for speed alone may be dropped at any time."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.stepping.step.stepper import Stepper

SPEC = importlib.util.spec_from_file_location(
    "restart_scenes", Path(__file__).with_name("restart_scenes.py")
)
scenes = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(scenes)

# What a relative residual of 1e-8, the loosest of the scenes' solvers, leaves of a displacement
# over tens of steps in which blocks slide; active sets end at the same tolerance. Other exact
# solutions and those of statics are alike to rounding, which choices of a step's length amplify:
# errors count by how far they are above the rounding of places, and of blocks nearly at rest they
# are just above it. Lengths of steps then differ by 6e-8, times of a wall by 8e-6 of its run.
TOLERANCES = {
    "slope": 1e-5,
    "mesh": 1e-6,
    "wall lagrange": 1e-7,
    "cone by error": 1e-6,
    "wall by error": 1e-6,
}
TIGHT = 1e-9


def dropping(self, attempt, accept=Stepper.accept):
    """Accept an attempt and drop the workspace."""
    found = accept(self, attempt)
    self.forget()
    return found


def way(run):
    """From the first frame to the last of those with the blocks of the last one."""
    last = run.frames[-1]
    return last.points - next(one.points for one in run.frames if one.topology == last.topology)


@pytest.mark.parametrize("name", scenes.SCENES)
def test_a_workspace_dropped_after_every_step_changes_no_digit_that_counts(name, monkeypatch):
    kept = nmm.run(nmm.parse_scene(scenes.scene_of(name), name))
    monkeypatch.setattr(Stepper, "accept", dropping)
    dropped = nmm.run(nmm.parse_scene(scenes.scene_of(name), name))
    assert dropped.summary.steps == kept.summary.steps > 5
    ways = [way(run) for run in (kept, dropped)]
    size = np.abs(ways[0]).max()
    assert np.abs(ways[1] - ways[0]).max() <= TOLERANCES.get(name, TIGHT) * size


def test_the_workspace_of_contact_was_in_use_and_is_empty_after_it_was_dropped():
    run = nmm.run(nmm.parse_scene(scenes.scene_of("wall"), "wall"))
    contact = run.stepper.plan.contact
    memory = contact.solver.memory
    assert memory.kept
    assert memory.found
    before = contact.record
    run.stepper.forget()
    assert (memory.kept, memory.found, memory.pattern, memory.answered) == ([], [], None, None)
    assert contact.record is before
