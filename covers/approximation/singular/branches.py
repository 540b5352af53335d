"""The branch of the angle about a singular point in each element, continuous within covers.

The angle about the tip of a crack must jump across the crack and nowhere else, even if it is
kinked, curved or ended by another. The topology of the cut shows where that is: elements are joined
across edges without a crack. The angle is continued from element to element of a cover across these
edges, and the crack that leads to the tip separates the two sides.
"""

from dataclasses import dataclass

import numpy as np

from covers.approximation.singular.enrichment import Enrichment, near, polar
from covers.cutting.components import components
from covers.cutting.connectivity import Joins
from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons

# A vertex nearer to the point than this share of the size of its polygon is the point.
AT = 1e-9


@dataclass(frozen=True)
class Branches:
    """Branches of the angle about one point.

    Attributes
    ----------
    bearing
        (n,) central angle of each branch (rad): angles of an element lie within pi of it.
    torn
        (n,) whether no continuous angle exists in the part: a path about the point is not blocked,
        as about a crack that lies within one cover.
    """

    bearing: Floats
    torn: Bools


def branches(cut: CutCells, item: Enrichment, element: Ints, part: Ints) -> Branches:
    """Return the branches on n pairs of an element and a connected part.

    Parameters
    ----------
    element, part
        (n,) element and number of the part of each pair: a cover, or 0 for a single part.
    """
    middle = middles(cut.elements.take(element), item)
    first, second, turns = _edges(cut.joins, item, element, part, middle)
    group = components(len(element), first, second)
    roots = np.lexsort((np.abs(middle), group))
    roots = roots[np.unique(group[roots], return_index=True)[1]]
    lift, known = np.zeros(len(element)), np.zeros(len(element), dtype=bool)
    known[roots] = True
    one, two = np.concatenate([first, second]), np.concatenate([second, first])
    step = np.concatenate([turns, -turns])
    while True:  # as many passes as the longest path from element to element
        reached = np.flatnonzero(known[one] & ~known[two])
        if not len(reached):
            break
        lift[two[reached]] = lift[one[reached]] + step[reached]
        known[two[reached]] = True
    wrong = lift[first] + turns != lift[second]
    torn = np.isin(group, group[first[wrong]])
    return Branches(middle + 2 * np.pi * lift, torn)


def middles(polygons: Polygons, item: Enrichment) -> Floats:
    """Middle (n,) of the angles that polygons span about a point, from the bisector (rad)."""
    radius, angle = polar(item, polygons.points)
    owner, follower = polygons.polygon_of_point, polygons.next_point
    first = polygons.first_point
    size = np.maximum.reduceat(radius, first)[owner]
    there = radius <= AT * size
    turn = near(angle[follower] - angle, np.zeros(len(angle)))
    turn[there | there[follower]] = 0.0
    # At a corner at the point the angle returns by the sum of the turns at the others.
    whole = np.add.reduceat(turn, first)
    turn[np.flatnonzero(there[follower])] = -whole[owner[there[follower]]]
    # A ring that begins at the point has no angle there: take that of the next vertex.
    began = first[there[first]]
    angle = angle.copy()
    angle[began] = angle[follower[began]]
    turn[began] = 0.0
    gone = np.cumsum(turn) - turn
    at = angle[first][owner] + gone - gone[first][owner]
    low = np.minimum.reduceat(np.where(there, np.inf, at), first)
    high = np.maximum.reduceat(np.where(there, -np.inf, at), first)
    return near((low + high) / 2, np.zeros(len(first)))


def _edges(
    joins: Joins, item: Enrichment, element: Ints, part: Ints, middle: Floats
) -> tuple[Ints, Ints, Floats]:
    """Joined pairs of one part, and the number of turns by which their angles differ."""
    n = 1 + max(int(one.max(initial=-1)) for one in (joins.first, joins.second, element))
    there = np.zeros(n, dtype=bool)
    there[element] = True
    joins = joins.take(there[joins.first] & there[joins.second])
    key = part * n + element
    order = np.argsort(key)
    ordered = key[order]
    found = []
    for number in np.unique(part):  # the covers about one point
        sides = []
        for side in (joins.first, joins.second):
            at = np.searchsorted(ordered, number * n + side).clip(max=len(order) - 1)
            sides.append(np.where(ordered[at] == number * n + side, order[at], -1))
        both = np.flatnonzero((sides[0] >= 0) & (sides[1] >= 0))
        found.append(np.stack([sides[0][both], sides[1][both], both]))
    first, second, join = np.concatenate(found, axis=1)
    angle = polar(item, (joins.start[join] + joins.end[join]) / 2)[1]
    one, two = near(angle, middle[first]), near(angle, middle[second])
    return first, second, np.round((one - two) / (2 * np.pi))
