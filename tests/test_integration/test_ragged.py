"""Ranges of rows: where they begin, what they hold, where each row stands in its own."""

import numpy as np

from integration.ragged import offsets, ranges, within


def test_rows_of_ranges_are_those_that_a_loop_counts():
    counts = np.array([2, 0, 3, 1])
    bounds = offsets(counts)
    assert bounds.tolist() == [0, 2, 2, 5, 6]
    assert within(counts).tolist() == [0, 1, 0, 1, 2, 0]
    rows, lengths = ranges(bounds, np.array([2, 1, 0, 2]))
    assert rows.tolist() == [2, 3, 4, 0, 1, 2, 3, 4]
    assert lengths.tolist() == [3, 0, 2, 3]
