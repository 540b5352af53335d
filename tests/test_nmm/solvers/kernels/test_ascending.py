import numpy as np
import pytest

from nmm.solvers.kernels.ascending import ascend, extended, place_of


@pytest.mark.parametrize("kind", [np.int32, np.int64])
@pytest.mark.parametrize("length", [0, 1, 2, 3, 10, 257, 5000])
def test_numbers_ascend(length, kind):
    values = np.random.default_rng(length).integers(0, 3 * length + 1, length).astype(kind)
    expected = np.sort(values)
    ascend(values)
    assert np.array_equal(values, expected)


def test_a_slice_is_sorted_where_it_stands():
    values = np.array([9, 3, 2, 1, 0])
    ascend(values[1:4])
    assert values.tolist() == [9, 1, 2, 3, 0]


def test_numbers_are_found_in_a_stretch():
    values = np.array([7, 0, 2, 5, 8, 11, 1], dtype=np.int32)
    assert [place_of(number, values, 1, 6) for number in (0, 2, 5, 8, 11)] == [1, 2, 3, 4, 5]


def test_what_is_extended_keeps_its_numbers():
    longer = extended(np.arange(3, dtype=np.int32), 8)
    assert (len(longer), longer.dtype, longer[:3].tolist()) == (8, np.int32, [0, 1, 2])
