"""Ghost stabilisation: small cut elements follow the fields of their neighbours."""

import numpy as np
from scipy.sparse import csc_array, diags_array

from covers.manifold import Manifold
from covers.rows import Rows
from integration.arrays import Bools, Floats, Ints
from integration.rules import polygon_rule


def neighbours(manifold: Manifold, elements: Ints) -> tuple[Ints, Ints]:
    """Pairs of elements, one of them among ``elements``, that share an edge within a body."""
    first, second = manifold.shared_edges
    mine = np.zeros(len(manifold.elements), dtype=bool)
    mine[elements] = True
    kept = mine[first] | mine[second]
    return first[kept], second[kept]


def ghost(manifold: Manifold, elements: Ints, weight: Floats, degree: int) -> csc_array:
    """Matrix of ``sum over pairs of int |E u_1 - E u_2|^2`` over both elements of each pair.

    ``E`` continues the polynomials of an element; the form vanishes for polynomials over both, so
    that it keeps the order of the approximation (Burman 2010; Lehrenfeld and Olshanskii 2019).
    Elements whose fields have no values beyond them (meshless covers, fields singular at a crack)
    are left out.

    Parameters
    ----------
    elements
        Elements to stabilise: pairs are they and their neighbours.
    weight
        (E,) factor of the form by element; that of the first of a pair serves.
    degree
        Degree of the displacements.
    """
    n = manifold.n_unknowns
    first, second = neighbours(manifold, elements)
    known = _extend(manifold)
    both = known[first] & known[second]
    first, second = first[both], second[both]
    if not len(first):
        return csc_array((n, n))
    pair = np.tile(np.arange(len(first)), 2)
    rule = polygon_rule(manifold.elements.take(np.concatenate([first, second])), 2 * degree)
    pair = pair[rule.owner]
    factor = rule.weights * weight[first[pair]]
    one = manifold.rows(first[pair], rule.points)
    two = manifold.rows(second[pair], rule.points)
    jump = Rows(
        np.concatenate([one.unknowns, two.unknowns], axis=1),
        np.concatenate([one.values, -two.values], axis=2),
    ).matrix(n)
    # Neighbours share covers, and half of the entries are those of the other component.
    jump.sum_duplicates()
    jump.eliminate_zeros()
    return csc_array(jump.T @ (diags_array(np.repeat(factor, 2)) @ jump))


def _extend(manifold: Manifold) -> Bools:
    """Elements whose fields can be continued beyond them."""
    found = np.zeros(len(manifold.elements), dtype=bool)
    for group in manifold.groups:  # a handful of groups
        found[group.elements] = group.extends
    return found
