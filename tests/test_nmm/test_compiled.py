import cProfile
import pstats

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
    assert [str(one) for (one,) in _square.signatures] == ["float64"]


def test_calls_after_the_first_pass_through_no_function_of_python():
    values = np.arange(4.0)
    total_of_squares(values)
    profile = cProfile.Profile()
    profile.runcall(total_of_squares, values)
    assert not any(file.endswith("nmm/compiled.py") for file, _, _ in pstats.Stats(profile).stats)
