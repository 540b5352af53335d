"""Effects that are named and idle change nothing; those that are not named are not imported."""

import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.assembly.applied_forces import AppliedForces
from nmm.effects.gravity import Gravity
from nmm.effects.members.chains.chains import Chains
from nmm.effects.members.linked import Linked
from nmm.effects.members.links import Links
from nmm.model.effects_table import EFFECTS
from nmm.model.planning.plan import Plan
from nmm.stepping.step.linear.assembly import Assembly
from nmm.water.joints.storage import JointStorage

BENCHMARKS = Path(__file__).resolve().parents[1] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))
from idle_effects import ALWAYS, IDLE  # noqa: E402

sys.path.remove(str(BENCHMARKS))

NEUTRAL = [name for name, idle in IDLE.items() if idle.within]
STEPS = 4


def test_every_effect_that_can_be_idle_has_a_row():
    measured = {effect for idle in IDLE.values() for effect in idle.effects}
    assert measured | set(ALWAYS) == set(EFFECTS.table)


@pytest.mark.parametrize("name", NEUTRAL)
def test_an_idle_effect_changes_no_displacement_beyond_rounding(name):
    idle = IDLE[name]
    runs = [nmm.run(scene) for scene in idle.scenes(STEPS)]
    without, with_it = (run.displacement for run in runs)
    n = len(without)
    assert idle.shared is not None or len(with_it) == n
    assert np.abs(without).max() > 0
    # Displacements are differences of places, with sixteen digits of the size of the scene.
    rounding = 16 * np.finfo(float).eps * np.abs(runs[0].frames[0].points).max()
    assert np.abs(with_it[:n] - without).max() <= idle.within * np.abs(without).max() + rounding


@pytest.mark.parametrize("name", ["a bar of no stiffness", "a dashpot of no viscosity"])
def test_an_idle_member_makes_its_matrix_once_a_run(name, monkeypatch):
    made, stiffness = [], Links.stiffness
    monkeypatch.setattr(Links, "stiffness", lambda *a: made.append(0) or stiffness(*a))
    nmm.run(IDLE[name].scenes(2 * STEPS)[1])
    # Bricks under their weight turn by far less than a thousandth in this time.
    assert len(made) == 1


def test_forces_on_the_outline_are_not_found_for_tips(monkeypatch):
    asked, on = [], AppliedForces.on.__func__
    monkeypatch.setattr(AppliedForces, "on", classmethod(lambda *a: asked.append(0) or on(*a)))
    nmm.run(IDLE["a crack that does not grow in time"].scenes(2)[1])
    # The bar's support and its load are on edges of its outline.
    assert not asked


def test_matrices_of_an_idle_member_are_summed_once_a_run(monkeypatch):
    made, total = Counter(), Plan.total

    def counted(plan, name, parts, make):
        return total(plan, name, parts, lambda: made.update([name]) or make())

    monkeypatch.setattr(Plan, "total", counted)
    nmm.run(IDLE["a dashpot of no viscosity"].scenes(2 * STEPS)[1])
    assert made
    assert max(made.values()) == 1


def test_water_in_joints_is_solved_for_once_for_each_volume_of_a_step(monkeypatch):
    found, balanced = [], JointStorage._balanced
    monkeypatch.setattr(
        JointStorage, "_balanced", lambda *a: found.append(balanced(*a)) or found[-1]
    )
    nmm.run(IDLE["water that is stored in joints that are closed"].scenes(STEPS)[1])
    # At the volumes with which a step begins, and at those at which it ends.
    assert STEPS <= len(found) <= 2 * STEPS


def test_a_bolt_answers_each_solution_of_a_step_once_and_solves_for_no_slips(monkeypatch):
    """Its laws are linear: slips are a product, and a step begins with the answer at its start."""
    counts = Counter()

    def counted(kind, name):
        was = getattr(kind, name)
        monkeypatch.setattr(kind, name, lambda *a: counts.update([name]) or was(*a))

    counted(Chains, "answer")
    counted(Chains, "_nearer")
    counted(Linked, "step_force")
    nmm.run(IDLE["a bolt in a wall at rest"].scenes(2 * STEPS)[1])
    assert counts["step_force"] >= 2 * STEPS
    assert counts["answer"] <= counts["step_force"] + 1  # and where the run begins
    assert counts["_nearer"] == 0


@pytest.mark.parametrize(
    "name", ["a bolt in a wall at rest", "water that is stored in joints that are closed"]
)
def test_forces_that_no_instant_changes_are_asked_once_a_solution(name, monkeypatch):
    asked, solved, force, of = [], [], Gravity.force, Assembly.of
    monkeypatch.setattr(Gravity, "force", lambda *a: asked.append(0) or force(*a))
    monkeypatch.setattr(Assembly, "of", lambda *a: solved.append(0) or of(*a))
    nmm.run(IDLE[name].scenes(STEPS)[1])
    assert len(solved) >= STEPS
    assert len(asked) <= len(solved) + 1  # and where the run begins


OF_CONTACT = """
import importlib, os, sys
sys.path.insert(0, {benchmarks!r})
import nmm, idle_effects
from nmm.model.effects_table import EFFECTS
from nmm.scene.model import Scene

idle_effects.CELL = 0.5

def loaded_by(work):
    end, into = os.pipe()
    if not os.fork():
        work()
        os.write(into, " ".join(name for name in sys.modules if "nmm.contact" in name).encode())
        os._exit(0)
    os.close(into)
    found = os.fdopen(end).read()
    assert not os.wait()[1]
    return found

for name, place in EFFECTS.table.items():
    print(name, loaded_by(lambda: importlib.import_module(place.partition(":")[0])), sep=": ")
for make in (idle_effects.bar, idle_effects.still_bar):
    print(make.__name__, loaded_by(lambda: nmm.run(Scene.model_validate(make(1)))), sep=": ")
"""
JOINTS = {
    "nmm.contact",
    *(f"nmm.contact.detection{name}" for name in ("", ".surface", ".tolerances", ".joints")),
    *(f"nmm.contact.points{name}" for name in ("", ".side_kernels", ".boundary_points")),
}
"""What finds the edges that bodies share."""
ACROSS_JOINTS = {"bonded interfaces", "artificial joints", "heat", "seepage", "consolidation"}
ACROSS_JOINTS |= {"joint flow", "transient joint flow", "fracture"}
"""Effects that glue, conduct or flow across such edges."""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs processes that are copied")
def test_no_effect_but_contact_imports_contact_beyond_the_joints_that_it_crosses():
    code = OF_CONTACT.format(benchmarks=str(BENCHMARKS))
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert not answer.returncode, answer.stderr[-2000:]
    lines = [line.split(": ") for line in answer.stdout.splitlines()]
    found = {name: set(modules.split()) for name, modules in lines}
    assert set(found) == {*EFFECTS.table, "bar", "still_bar"}
    assert found.pop("contact") > JOINTS
    assert {name for name, modules in found.items() if modules} == ACROSS_JOINTS
    assert set.union(*found.values()) == JOINTS


IMPORTS = """
import os, sys
sys.path.insert(0, {benchmarks!r})
import numba, scipy.optimize, scipy.spatial, skfem
import nmm.contact.candidates.candidates, nmm.contact.solution.driver
import idle_effects
from nmm.model.called_for import called_for
from nmm.model.effects_table import EFFECTS
from nmm.stepping.prepare import prepare

idle_effects.COURSES, idle_effects.CELL = 5, 1.0
modules = {{name: place.partition(":")[0] for name, place in EFFECTS.table.items()}}
for name, idle in idle_effects.IDLE.items():
    scene = idle.scenes(1)[1]
    if os.fork():
        if os.wait()[1]:
            sys.exit(1)
        continue
    prepare(scene, scene.formulation)
    named = {{modules[one] for one, wanted in called_for(scene).items() if wanted}}
    loaded = sorted(set(modules.values()) & set(sys.modules) - named)
    if loaded:
        print(name, loaded, flush=True)
    os._exit(bool(loaded))
"""


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs processes that are copied")
def test_no_scene_imports_an_effect_that_it_does_not_name():
    code = IMPORTS.format(benchmarks=str(BENCHMARKS))
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert not found.returncode, found.stdout + found.stderr[-2000:]
