"""Which unknowns and contacts depend on each other, but for what goes through held bodies.

A body whose own matrix is much stiffer than the springs of its contacts, as one that supports hold,
hardly moves whatever its neighbours do: islands that share it are solved one after the other.
"""

import math
from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.compiled import compiled
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.residual_kernel import SpringColumns
from nmm.contact.problem.row_products import Compressed, compressed
from nmm.contact.problem.step_problem import StepProblem

STIFF = 0.05
"""Largest stiffness of contacts over that of the matrix (-) at every unknown of a held body. What
one island does to another through it is less than the square of that."""


@dataclass(frozen=True)
class Islands:
    """Unknowns and contacts by island; each held body is an island besides.

    Attributes
    ----------
    unknown, contact
        (n,) and (m,) number of the island. A contact belongs to what is not held of its two sides.
    held
        (I,) islands that are one held body.
    """

    unknown: Ints
    contact: Ints
    held: Bools

    @classmethod
    def of(cls, springs: CutSprings) -> "Islands":
        """Find the islands of a problem."""
        p = springs.problem
        diagonal = p.matrix.diagonal()
        stiff = springs.weight**-2 - diagonal <= STIFF * diagonal
        return cls(*_labels(compressed(p.matrix), p.compressed_rows, stiff))

    @property
    def count(self) -> int:
        """Number of islands."""
        return len(self.held)

    @property
    def apart(self) -> bool:
        """Whether there is anything to be solved apart."""
        return int((~self.held).sum()) > 1

    def around(self, problem: StepProblem, chosen: Bools) -> tuple[Ints, Ints]:
        """Unknowns of ``chosen`` islands (I,) and of held bodies they touch, and their contacts."""
        within, contacts = chosen[self.unknown], np.flatnonzero(chosen[self.contact])
        also = np.zeros(self.count, dtype=bool)
        for rows in problem.compressed_rows:
            _touched(rows, contacts, self.unknown, also)
        within |= (also & self.held)[self.unknown]
        return np.flatnonzero(within), contacts


@compiled
def balances(
    increment: Floats, force: Floats, island: Ints, islands: int, springs: SpringColumns
) -> tuple[Floats, Floats]:
    """(I,) out-of-balance ``force`` (n,) of each island, and the largest of its own parts.

    These are no less than what counts in the whole (`StepProblem.least`). See
    `nmm.contact.problem.residual_kernel.residual`, which says the same of the whole.
    """
    load, weight = springs.load, springs.weight
    pointers, indices, entries = springs.matrix
    rest, largest = np.zeros(islands), np.empty((3, islands))
    for one in range(islands):
        for part in range(3):
            largest[part, one] = springs.least**2
    for i in range(len(increment)):
        inner = 0.0
        for k in range(pointers[i], pointers[i + 1]):
            inner += entries[k] * increment[indices[k]]
        one, square = island[i], weight[i] ** 2
        rest[one] += square * force[i] ** 2
        largest[0, one] += square * inner**2
        largest[1, one] += square * (force[i] + load[i] - inner) ** 2
        largest[2, one] += square * load[i] ** 2
    for one in range(islands):
        rest[one] = math.sqrt(rest[one])
        largest[0, one] = math.sqrt(max(largest[0, one], largest[1, one], largest[2, one]))
    return rest, largest[0]


@compiled
def _touched(rows: Compressed, contacts: Ints, island: Ints, also: Bools) -> None:
    pointers, columns, _ = rows
    for c in contacts:
        for k in range(pointers[c], pointers[c + 1]):
            also[island[columns[k]]] = True


@compiled
def _root(parent: Ints, at: int) -> int:
    while parent[at] != at:
        parent[at] = parent[parent[at]]
        at = parent[at]
    return at


@compiled
def _labels(
    matrix: Compressed, rows: tuple[Compressed, Compressed], stiff: Bools
) -> tuple[Ints, Ints, Bools]:
    """Islands in the order of their first unknowns."""
    pointers, indices, _ = matrix
    n, m = len(stiff), len(rows[0][0]) - 1
    parent = np.arange(n)
    for j in range(n):
        for k in range(pointers[j], pointers[j + 1]):
            a, b = _root(parent, j), _root(parent, parent[indices[k]])
            parent[max(a, b)] = min(a, b)
    fixed = np.ones(n, dtype=np.bool_)  # at the root of a body: whether all of it is stiff
    for j in range(n):
        fixed[_root(parent, j)] &= stiff[j]
    owner = np.full(m, -1)
    for c in range(m):
        for pointer, column, _ in rows:
            for k in range(pointer[c], pointer[c + 1]):
                owner[c] = _joined(parent, fixed, owner[c], _root(parent, parent[column[k]]))
    return _numbered(parent, fixed, owner)


@compiled
def _joined(parent: Ints, fixed: Bools, owner: int, root: int) -> int:
    """Owner of a contact (-1: none yet) that holds the body at ``root`` as well.

    What is not fixed on both sides becomes one island.
    """
    if owner < 0 or fixed[owner]:
        return root if owner < 0 or not fixed[root] else owner
    if fixed[root]:
        return owner
    own = _root(parent, owner)
    parent[max(own, root)] = min(own, root)
    return min(own, root)


@compiled
def _numbered(parent: Ints, fixed: Bools, owner: Ints) -> tuple[Ints, Ints, Bools]:
    """Islands of unknowns and contacts in the order of their first unknowns, and which are held."""
    n, m = len(parent), len(owner)
    number = np.full(n, -1)
    unknown, contact = np.empty(n, dtype=np.int64), np.zeros(m, dtype=np.int64)
    held = np.empty(n, dtype=np.bool_)
    count = 0
    for j in range(n):
        root = _root(parent, j)
        if number[root] < 0:
            number[root], held[count] = count, fixed[root]
            count += 1
        unknown[j] = number[root]
    for c in range(m):
        if owner[c] >= 0:
            contact[c] = number[_root(parent, owner[c])]
    return unknown, contact, held[:count].copy()
