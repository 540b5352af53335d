"""Compiled loops of contact made by a second process, while the first looks for contacts.

On a machine where nothing is compiled yet, a run of blocks spends most of its first half minute on
the compiler, one function after the other. Here a process of its own solves a problem of no scene:
so the loops of solution are compiled with the types that they always have, and kept where the run
finds them. It begins with those that a run needs last, to meet it about half way.
"""

import atexit
import os
import subprocess
import sys
from contextlib import suppress
from functools import cache

import numpy as np
from scipy.sparse import csc_array, csr_array

from nmm.compiled.store import kept
from nmm.contact.enforcement.penalty import Penalty
from nmm.contact.islands.partition import Islands
from nmm.contact.islands.warm_start import start_from
from nmm.contact.iteration.newton import compiled_newton
from nmm.contact.iteration.newton.modified_newton import ModifiedNewton
from nmm.contact.problem.contact_state import ContactState
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.step_problem import StepProblem
from nmm.interfaces.limits import Limits
from nmm.solvers.linear import make_solver

BLOCKS = 24
"""Of the problem: more unknowns than are solved for with full matrices."""


@cache
def begin() -> None:
    """Start the process, once, where the loops are not compiled and a second core is idle."""
    if kept(compiled_newton.loop) or not _second_core() or not sys.executable:
        return
    with suppress(OSError):  # a run does without it
        process = subprocess.Popen(
            [sys.executable, "-m", __name__],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        atexit.register(_end, process)


def _end(process: "subprocess.Popen[bytes]") -> None:
    process.kill()
    process.wait()


def _second_core() -> bool:
    """Whether a core is left beside this process, so that nobody waits for the other one."""
    busy = os.getloadavg()[0] if hasattr(os, "getloadavg") else 0.0
    return _cores() - max(busy, 1.0) >= 0.5


def _cores() -> int:
    """How many cores this process may use, which may be fewer than the machine has."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def column_of_blocks() -> StepProblem:
    """Return a step of blocks on top of each other, of six unknowns each, that press and stick."""
    n, m = 6 * BLOCKS, BLOCKS - 1
    columns = (6 * np.arange(m)[:, None] + [0, 1, 6, 7]).astype(np.int32).ravel()
    ends = np.arange(0, 4 * m + 1, 4, dtype=np.int32)
    normal = np.tile([0.0, -1.0, 0.0, 1.0], m)
    tangent = np.tile([-1.0, 0.0, 1.0, 0.0], m)
    zero, one = np.zeros(m), np.ones(m)
    return StepProblem(
        csc_array((np.ones(n), np.arange(n), np.arange(n + 1)), shape=(n, n)),
        np.tile([0.1, -1.0, 0.0, 0.0, 0.0, 0.0], BLOCKS),
        csr_array((normal, columns, ends), shape=(m, n)),
        csr_array((tangent, columns, ends), shape=(m, n)),
        gap=zero,
        slip=zero,
        normal_stiffness=10.0 * one,
        shear_stiffness=10.0 * one,
        limits=Limits(zero, zero, 0.5 * one),
        state=np.full(m, int(ContactState.STICK)),
        normal_force=zero,
        shear_force=zero,
    )


def solve_in_turn() -> None:
    """Solve it, the last of what a step calls first."""
    problem, enforcement, solver = column_of_blocks(), Penalty(), make_solver("auto").beside(True)
    springs, nothing = CutSprings.of(problem), np.zeros_like(problem.force)
    memory = enforcement.memory()
    factor = memory.factor_of(springs, solver)[0].factor
    ModifiedNewton(springs, factor, nothing, springs.residual(nothing)).run(9, 1e-8)
    start_from(springs, [nothing, problem.force], True, Islands.of(springs))
    enforcement.solve(problem, solver, memory)


if __name__ == "__main__":
    solve_in_turn()
