"""What a second process compiles is what a run calls."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from nmm.contact.enforcement.penalty import Penalty
from nmm.solvers.linear import make_solver
from nmm.stepping import kernels_ahead


def test_each_contact_of_the_column_carries_the_blocks_above_it():
    problem = kernels_ahead.column_of_blocks()
    held = np.zeros(len(problem.force))
    held[1] = 1e12  # the lowest block on the ground
    matrix = problem.matrix.copy()
    matrix.setdiag(1e-9 + held)
    answer = Penalty().solve(
        replace(problem, matrix=matrix.tocsc(), force=np.where(
            np.arange(len(held)) % 6 == 1, -1.0, 0.0)), make_solver("superlu"))  # fmt: skip
    assert answer.verdict.converged
    above = np.arange(kernels_ahead.BLOCKS - 1, 0, -1)
    np.testing.assert_allclose(answer.normal_force, -above, rtol=1e-5)


def test_no_process_is_started_where_the_loops_are_compiled_or_no_core_is_idle(monkeypatch):
    monkeypatch.setattr(
        kernels_ahead.subprocess, "Popen", lambda *given, **more: pytest.fail("started")
    )
    monkeypatch.setattr(kernels_ahead, "kept", lambda loop: True)
    kernels_ahead.begin.__wrapped__()
    monkeypatch.setattr(kernels_ahead, "kept", lambda loop: False)
    monkeypatch.setattr(kernels_ahead, "_cores", lambda: 1)
    kernels_ahead.begin.__wrapped__()


LEFT = """
import nmm, numba.core.event as events
from nmm.results.sink import MemorySink
from nmm.stepping.prepare import prepare
counted = events.RecordingListener()
events.register("numba:compile", counted)
scene = nmm.read_scene("examples/stack/stack.toml").model_copy(update={"duration": 0.01})
prepare(scene, scene.formulation).run([MemorySink()], lambda share, text: None)
print(*{event.data["dispatcher"].py_func.__module__ for _, event in counted.buffer})
"""


@pytest.mark.slow
def test_a_run_after_it_compiles_no_loop_of_the_solution_again(tmp_path):
    place = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    subprocess.run([sys.executable, "-m", kernels_ahead.__name__], check=True, env=place)
    found = subprocess.run(
        [sys.executable, "-c", LEFT], check=True, env=place, capture_output=True, text=True
    )
    left = set(found.stdout.split())
    assert not left & {
        "nmm.solvers.frontal.numbers.fronts",
        "nmm.contact.iteration.newton.compiled_newton",
        "nmm.contact.islands.warm_start",
        "nmm.contact.islands.partition",
        "nmm.contact.problem.pattern_kernels",
        "nmm.contact.problem.answer_kernel",
    }
