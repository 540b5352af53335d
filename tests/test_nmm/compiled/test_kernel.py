import cProfile
import os
import pstats
import subprocess
import sys

import numpy as np
import pytest

from nmm.compiled import Kernel, compiled


@compiled
def _square(x: float) -> float:
    return x * x


@compiled
def total_of_squares(values) -> float:
    total = 0.0
    for value in values:
        total += _square(value)
    return total


@pytest.fixture
def kernel():
    return compiled(lambda x: 2.0 * x)


def test_nothing_is_compiled_before_the_first_call(kernel):
    assert isinstance(kernel, Kernel)
    assert "made" not in vars(kernel)
    assert kernel(3.0) == 6.0
    assert "made" in vars(kernel)


def test_a_kernel_calls_another_as_compiled_code():
    assert total_of_squares(np.arange(4.0)) == 14.0
    assert len(total_of_squares.signatures) == 1


def test_calls_after_the_first_pass_through_no_function_of_python():
    values = np.arange(4.0)
    total_of_squares(values)
    profile = cProfile.Profile()
    profile.runcall(total_of_squares, values)
    files = {file for file, _, _ in pstats.Stats(profile).stats}
    assert not any(file.endswith("compiled/kernel.py") for file in files)


COUNTED = """
import gc, nmm, numba.core.event as events
from nmm.compiled import Kernel
from nmm.results.sink import MemorySink
from nmm.stepping.prepare import prepare
counted = events.RecordingListener()
events.register("numba:compile", counted)
scene = nmm.read_scene("examples/stack/stack.toml").model_copy(update={"duration": 0.01})
prepare(scene, scene.formulation).run([MemorySink()], lambda share, text: None)
kernels = [one for one in gc.get_objects() if isinstance(one, Kernel) and "made" in vars(one)]
kinds = {one.python.__qualname__: len(one.signatures) for one in kernels}
print(sum(event.is_start for _, event in counted.buffer))
print(*(name for name, count in kinds.items() if count > 1))
"""


@pytest.mark.slow
def test_a_wall_compiles_few_functions_each_but_once(tmp_path):
    """158, 107 of them the project's; an array set to a slice costs 37 more, sorts as many."""
    answer = subprocess.run(
        [sys.executable, "-c", COUNTED],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)},
    )
    count, several = answer.stdout.splitlines()
    assert int(count) <= 159
    assert set(several.split()) <= {"ascend", "extended"}  # of numbers of four and of eight bytes
