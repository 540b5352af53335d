"""Blocks divided along planes through a place, by the rules of size and number."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import shapely

from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons
from nmm.splitting.cuts import Shapes, face_length, pieces

# Uses of strength as near to one another as this come together: above their rounding, below any
# number that says something.
ALIKE = 1e-9
# Faces that differ by less than this share of their length are as long: supports and contacts by
# springs turn blocks by 1e-7 and less.
AS_LONG = 1e-5


@dataclass(frozen=True)
class SplitRules:
    """Limits of splitting: smallest size (m) of a piece (`sizes`), largest number of blocks."""

    smallest: float
    most: int


def sizes(shapes: Shapes) -> Floats:
    """Return four areas over the perimeters (n,) of polygons (m): the sides of squares."""
    return np.asarray(4 * shapely.area(shapes) / shapely.length(shapes), dtype=np.float64)


def parts_of(
    polygon: shapely.Polygon, through: Floats, planes: Floats, rules: SplitRules
) -> Shapes:
    """Return the pieces of a block that splits; only the block if a piece would be too small.

    Of two planes (2,) it splits along the one on which its new faces are shorter, for less strength
    holds it there, and along both where they are as long.
    """
    wanted = planes[~np.isnan(planes)]
    if len(wanted) == 2:
        one, other = (face_length(polygon, through, float(angle)) for angle in wanted)
        if abs(one - other) > AS_LONG * max(one, other):
            wanted = wanted[[0]] if one < other else wanted[[1]]
    found = pieces(polygon, through, wanted.tolist())
    return found if sizes(found).min() >= rules.smallest else np.array([polygon])


def first_cuts(
    shapes: Shapes, bodies: Ints, points: Floats, planes: Floats, rules: SplitRules
) -> tuple[Ints, list[Shapes]]:
    """Return which of the places (k,) cut their bodies, and the pieces of each.

    A body is cut at the first of its places, in their order, that leaves no piece too small.
    """
    found: dict[int, tuple[int, Shapes]] = {}
    for place, body in enumerate(bodies.tolist()):  # a polygon after the other is cut
        if body not in found:
            parts = parts_of(shapes[body], points[place], planes[place], rules)
            if len(parts) > 1:
                found[body] = place, parts
    at = np.array([place for place, _ in found.values()], dtype=np.int64)
    return at, [parts for _, parts in found.values()]


def ranks(use: Floats) -> Ints:
    """Return how many larger uses (m,) there are, counting as one those that are alike."""
    order = np.argsort(-use, kind="stable")
    falls = np.diff(use[order]) < -ALIKE * use[order][1:]
    found = np.zeros(len(use), dtype=np.int64)
    found[order[1:]] = np.cumsum(falls)
    return found


def allowed(use: Floats, more: Ints, room: int) -> Bools:
    """Return which blocks (m,) may split where only ``room`` blocks more may come to be.

    Those that are most beyond their strength come first; of those that are alike all or none.
    """
    rank = ranks(use)
    needed = np.cumsum(np.bincount(rank, more))
    return np.asarray((needed <= room)[rank])


def replaced(polygons: Polygons, splits: Mapping[int, Shapes]) -> tuple[Polygons, Ints]:
    """Return polygons with the pieces of some in their places, and the parent of each."""
    count = np.ones(len(polygons), dtype=np.int64)
    count[list(splits)] = [len(shapes) for shapes in splits.values()]
    parent = np.repeat(np.arange(len(polygons)), count)
    found = polygons.to_shapely()[parent]
    for number, shapes in splits.items():  # the blocks that split
        found[parent == number] = shapes
    return Polygons.from_shapely(found).oriented(), parent
