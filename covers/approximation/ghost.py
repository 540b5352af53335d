"""Ghost penalty: stabilisation of small cut elements by the fields of their neighbours."""

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints
from integration.rules import polygon_rule
from integration.sparse import coo_array, csc_array, eye_array, kron


def neighbours(manifold: Manifold, elements: Ints) -> tuple[Ints, Ints]:
    """Return pairs of elements of a body that share an edge, at least one of ``elements``."""
    first, second = manifold.shared_edges
    mine = np.zeros(len(manifold.elements), dtype=bool)
    mine[elements] = True
    kept = mine[first] | mine[second]
    return first[kept], second[kept]


def ghost(manifold: Manifold, elements: Ints, weight: Floats, degree: int) -> csc_array:
    """Return the matrix (n, n) of ``sum over pairs of int |E u_1 - E u_2|^2`` over both elements.

    ``E`` extends the polynomials of an element; the form vanishes for polynomials over both, so
    that it keeps the order of the approximation (Burman 2010; Lehrenfeld and Olshanskii 2019).
    Elements whose fields cannot be extended (meshless covers, fields singular at a crack) are left
    out.

    Parameters
    ----------
    elements
        Elements to stabilise, each in pairs with its neighbours.
    weight
        (E,) factor of the form by element; that of the first of a pair counts.
    degree
        Degree of the displacements.
    """
    n = manifold.n_unknowns
    first, second = neighbours(manifold, elements)
    known = manifold.extends
    both = known[first] & known[second]
    first, second = first[both], second[both]
    if not len(first):
        return csc_array((n, n))
    rule = polygon_rule(manifold.elements.take(np.concatenate([first, second])), 2 * degree)
    pair = rule.owner % len(first)
    factor = rule.weights * weight[first[pair]]
    if all(group.combination is None for group in manifold.groups):
        # Both components alike: half the unknowns, and one form for both.
        one, ours = manifold.scalar_rows(first[pair], rule.points)
        two, theirs = manifold.scalar_rows(second[pair], rule.points)
        jump = np.concatenate([ours, -theirs], axis=1)
        form = _summed(pair, factor, np.concatenate([one, two], axis=1), jump, n // 2)
        return csc_array(kron(form, eye_array(2), format="csc"))
    near, far = manifold.rows(first[pair], rule.points), manifold.rows(second[pair], rule.points)
    unknowns = np.concatenate([near.unknowns, far.unknowns], axis=1)
    jump = np.concatenate([near.values, -far.values], axis=2).reshape(2 * len(pair), -1)
    return _summed(
        np.repeat(pair, 2), np.repeat(factor, 2), np.repeat(unknowns, 2, axis=0), jump, n
    )


def _summed(pair: Ints, factor: Floats, unknowns: Ints, jump: Floats, n: int) -> csc_array:
    """Sum over points of ``factor jump^T jump``, first over the many points of each pair."""
    order = np.argsort(pair, kind="stable")
    counts = np.bincount(pair)
    begin = np.cumsum(counts) - counts
    rows, columns, values = [], [], []
    for number in np.unique(counts[counts > 0]):  # pairs of equal numbers of points
        some = order[begin[counts == number, None] + np.arange(number)]
        part = jump[some]
        square = np.swapaxes(part * factor[some][:, :, None], 1, 2) @ part
        mine = unknowns[some[:, 0]]
        rows.append(np.repeat(mine, mine.shape[1], axis=1).ravel())
        columns.append(np.tile(mine, mine.shape[1]).ravel())
        values.append(square.ravel())
    places = np.concatenate(rows), np.concatenate(columns)
    return csc_array(coo_array((np.concatenate(values), places), shape=(n, n)))
