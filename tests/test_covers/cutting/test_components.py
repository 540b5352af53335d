"""Connected components, beside those of scipy, in the order of their first members."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from covers.cutting.components import components


def by_scipy(n, first, second):
    """Components by depth-first search, renumbered by first members."""
    graph = coo_array((np.ones(len(first)), (first, second)), shape=(n, n))
    label = connected_components(graph, directed=False)[1]
    _, at, back = np.unique(label, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(at))[back]


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("share", [0.0, 0.2, 0.5, 2.0])
def test_random_pairs(seed, share):
    random = np.random.default_rng(seed)
    n = int(random.integers(1, 300))
    first, second = random.integers(0, n, (2, int(share * n)))
    assert (components(n, first, second) == by_scipy(n, first, second)).all()


@pytest.mark.parametrize("shuffled", [False, True])
def test_long_ways_and_rings(shuffled):
    n = 2000
    order = np.random.default_rng(1).permutation(n) if shuffled else np.arange(n)
    way = components(n, order[:-1], order[1:])
    assert not way.any()
    apart = components(n, order[: n // 2], np.r_[order[1 : n // 2], order[0]])
    assert (apart == by_scipy(n, order[: n // 2], np.r_[order[1 : n // 2], order[0]])).all()


def test_nothing():
    none = np.empty(0, dtype=np.int64)
    assert len(components(0, none, none)) == 0
    assert components(3, none, none).tolist() == [0, 1, 2]
