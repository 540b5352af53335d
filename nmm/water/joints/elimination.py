"""Subtraction-free elimination of networks of conductances.

The elimination of a node connects its neighbours by ``c_i c_j / sum c``: sums, products and
quotients of positive numbers, so that each head is accurate to rounding whatever the ratio of the
conductances (Grassmann, Taksar and Heyman 1985; Alfa, Xue and Ye 2002). On the diagonal of a matrix
the conductance of a joint of 1 um would be lost beside that of 1 mm, which is 1e9 times as large.
"""

import numpy as np
from scipy.sparse import coo_array, csc_array, diags_array

from integration.arrays import Floats, Ints
from nmm.solvers.linear import make_solver

# Largest number of nodes of dense elimination; larger networks go to a sparse solver.
MANY = 800


def heads_of(ends: Ints, conductance: Floats, ground: Floats, inflow: Floats) -> Floats:
    """Solve ``sum_j c_ij (h_i - h_j) + ground_i h_i = inflow_i`` for the heads (n,).

    Parameters
    ----------
    ends, conductance
        (j, 2) nodes and (j,) conductances of links, >= 0.
    ground
        (n,) conductances to a head of zero, >= 0; at least one above zero in every connected part.
        inflow
        (n,) inflows, >= 0 for accuracy to rounding.
    """
    if len(ground) > MANY:
        return _sparse(ends, conductance, ground, inflow)
    return _eliminated(ends, conductance, ground, inflow)


def _eliminated(ends: Ints, conductance: Floats, ground: Floats, inflow: Floats) -> Floats:
    n = len(ground)
    links, ground, inflow = np.zeros((n, n)), ground.copy(), inflow.copy()
    np.add.at(links, (ends[:, 0], ends[:, 1]), conductance)
    np.add.at(links, (ends[:, 1], ends[:, 0]), conductance)
    np.fill_diagonal(links, 0.0)
    total = np.zeros(n)
    for node in range(n):  # nodes of a small network, one after the other
        rest = slice(node + 1, n)
        total[node] = links[node, rest].sum() + ground[node]
        share = links[rest, node] / total[node]
        links[rest, rest] += share[:, None] * links[node, rest]
        ground[rest] += share * ground[node]
        inflow[rest] += share * inflow[node]
        np.fill_diagonal(links[rest, rest], 0.0)
    heads = np.zeros(n)
    for node in range(n - 1, -1, -1):
        rest = slice(node + 1, n)
        heads[node] = (links[node, rest] @ heads[rest] + inflow[node]) / total[node]
    return heads


def _sparse(ends: Ints, conductance: Floats, ground: Floats, inflow: Floats) -> Floats:
    n, (a, b) = len(ground), ends.T
    off = coo_array((conductance, (a, b)), shape=(n, n))
    links = csc_array(off + off.T)
    matrix = csc_array(diags_array(np.asarray(links.sum(axis=0)).ravel() + ground) - links)
    return make_solver().factorise(matrix).solve(inflow)
