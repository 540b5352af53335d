"""Orders of elimination of large graphs."""

import numpy as np
import pytest
from scipy.sparse import coo_array, csc_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import Delaunay

from integration.arrays import Ints
from nmm.solvers.frontal import ordering
from nmm.solvers.frontal.cholesky import Cholesky
from nmm.solvers.frontal.dissection import SMALL_PART, dissect
from nmm.solvers.frontal.ordering import metis_order
from nmm.solvers.libraries.optional import METIS
from nmm.testing.solvers import is_cholesky


def graph(first: Ints, second: Ints, n: int) -> csc_array:
    """Graph with loops from pairs of nodes."""
    own = np.arange(n)
    rows, columns = np.concatenate([first, second, own]), np.concatenate([second, first, own])
    made = csc_array(coo_array((np.ones(len(rows)), (rows, columns)), shape=(n, n)))
    made.sum_duplicates()
    made.sort_indices()
    return made


def net(side: int) -> csc_array:
    """Square grid whose cells have one diagonal."""
    k = np.arange(side * side).reshape(side, side)
    first = [k[:, :-1].ravel(), k[:-1].ravel(), k[:-1, :-1].ravel()]
    second = [k[:, 1:].ravel(), k[1:].ravel(), k[1:, 1:].ravel()]
    return graph(np.concatenate(first), np.concatenate(second), side * side)


def scattered(n: int) -> csc_array:
    """Delaunay triangulation of random points: long thin triangles along the hull."""
    t = Delaunay(np.random.default_rng(0).uniform(size=(n, 2))).simplices.astype(np.int64)
    return graph(t[:, [0, 1, 2]].ravel(), t[:, [1, 2, 0]].ravel(), n)


@pytest.mark.parametrize("made", [net(60), scattered(4000)])
def test_separators_leave_small_parts_that_are_not_connected(made: csc_array) -> None:
    n = made.shape[0]
    weight = np.full(n, 6)
    inside, separators = dissect(made.indptr, made.indices, weight)
    np.testing.assert_array_equal(np.sort(np.concatenate([inside, separators])), np.arange(n))
    parts, label = connected_components(made[inside][:, inside])
    # Parts whose separator does not pay are left whole; on planar graphs they are few and small.
    assert np.bincount(label).max() <= 4 * SMALL_PART
    assert parts >= n // (4 * SMALL_PART)


def test_separators_of_a_grid_are_short() -> None:
    # Halving a 60 x 60 grid straight across until parts hold fewer than 100 nodes (George 1973)
    # takes 60 + 2 * 30 + 4 * 30 + 8 * 15 + 16 * 15 + 32 * 7.5 nodes.
    _, separators = dissect(net(60).indptr, net(60).indices, np.full(3600, 6))
    assert len(separators) <= 840


def test_order_with_fewer_operations_is_taken() -> None:
    for made in (net(120), scattered(6000)):
        weight = np.full(made.shape[0], 6)
        args = made.indptr, made.indices
        plain = ordering.Columns.of(*args, ordering._minimum_degree(*args))
        chosen = ordering.columns(*args, weight)
        assert chosen.operations(weight) <= plain.operations(weight)


def test_dissected_matrix_is_factorised_and_solved() -> None:
    pattern = net(120)
    columns = np.repeat(np.arange(14400), np.diff(pattern.indptr))
    data = np.where(pattern.indices == columns, 8.0, -1.0)
    matrix = csc_array((data, pattern.indices, pattern.indptr), shape=pattern.shape)
    exact = np.random.default_rng(1).normal(size=14400)
    before, ordering.WORTH = ordering.WORTH, 0.0
    try:
        found = Cholesky().decompose(matrix)
    finally:
        ordering.WORTH = before
    assert is_cholesky(found)
    np.testing.assert_allclose(found.solve(matrix @ exact), exact, rtol=1e-9, atol=1e-12)


@pytest.mark.skipif(not METIS.loads, reason="pymetis is an extra; own dissection is tested above")
def test_metis_orders_large_graphs_where_it_is_installed() -> None:
    made = net(60)
    weight = np.full(made.shape[0], 2)
    order = metis_order(made.indptr, made.indices, weight)
    assert (np.sort(order) == np.arange(made.shape[0])).all()
    found = ordering.Columns.of(made.indptr, made.indices, order).operations(weight)
    # nested dissection of a square grid takes 829/84 n^3 multiplications and additions for five
    # neighbours (George 1973), n^3 times 2^3 with two unknowns a node; diagonals cost up to twice
    assert found < 2 * 829 / 84 * (60 * 2) ** 3


def test_own_dissection_serves_where_metis_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ordering, "metis", lambda: None)
    monkeypatch.setattr(ordering, "WORTH", 0.0)
    made = net(40)
    columns = ordering.columns(made.indptr, made.indices, np.ones(made.shape[0], dtype=int))
    assert (np.sort(columns.order) == np.arange(made.shape[0])).all()
