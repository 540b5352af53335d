"""Networks of conductances solved without subtracting anything.

Eliminating a node of a network joins its neighbours by ``c_i c_j / sum c``: sums, products and
quotients of positive numbers, so that each head has all its digits whatever the ratio of the
conductances (Grassmann, Taksar and Heyman 1985; Alfa, Xue and Ye 2002). In a matrix the diagonal of
a joint of 1 mm would swallow that of one of 1 um beside it, which is 1e9 times less.
"""

import numpy as np
from scipy.sparse import coo_array, csc_array, diags_array

from integration.arrays import Floats, Ints
from nmm.solvers.linear import make_solver

# Nodes up to which a network is eliminated densely; larger ones are left to a sparse solver.
MANY = 800


def heads_of(ends: Ints, conductance: Floats, ground: Floats, driven: Floats) -> Floats:
    """Solve ``sum_j c_ij (h_i - h_j) + ground_i h_i = driven_i``.

    Parameters
    ----------
    ends, conductance
        (j, 2) nodes and (j,) conductances of links, >= 0.
    ground
        (n,) conductances to a head of zero, >= 0; at least one in every connected part.
    driven
        (n,) what flows in, >= 0 for full accuracy.
    """
    if len(ground) > MANY:
        return _sparse(ends, conductance, ground, driven)
    return _eliminated(ends, conductance, ground, driven)


def _eliminated(ends: Ints, conductance: Floats, ground: Floats, driven: Floats) -> Floats:
    n = len(ground)
    links, leak, inflow = np.zeros((n, n)), ground.copy(), driven.copy()
    np.add.at(links, (ends[:, 0], ends[:, 1]), conductance)
    np.add.at(links, (ends[:, 1], ends[:, 0]), conductance)
    np.fill_diagonal(links, 0.0)
    total = np.zeros(n)
    for node in range(n):  # nodes of a small network, one after the other
        rest = slice(node + 1, n)
        total[node] = links[node, rest].sum() + leak[node]
        share = links[rest, node] / total[node]
        links[rest, rest] += share[:, None] * links[node, rest]
        leak[rest] += share * leak[node]
        inflow[rest] += share * inflow[node]
        np.fill_diagonal(links[rest, rest], 0.0)
    heads = np.zeros(n)
    for node in range(n - 1, -1, -1):
        rest = slice(node + 1, n)
        heads[node] = (links[node, rest] @ heads[rest] + inflow[node]) / total[node]
    return heads


def _sparse(ends: Ints, conductance: Floats, ground: Floats, driven: Floats) -> Floats:
    n, (a, b) = len(ground), ends.T
    off = coo_array((conductance, (a, b)), shape=(n, n))
    links = csc_array(off + off.T)
    matrix = csc_array(diags_array(np.asarray(links.sum(axis=0)).ravel() + ground) - links)
    return make_solver().factorise(matrix).solve(driven)
