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


def allowed(use: Floats, more: Ints, room: int) -> Bools:
    """Return which blocks (m,) may split where only ``room`` blocks more may come to be.

    Those that are most beyond their strength come first; of those that are alike all or none.
    """
    order = np.argsort(-use, kind="stable")
    level = np.concatenate([[0], np.cumsum(np.diff(-use[order]) > ALIKE)])
    needed = np.cumsum(more[order])
    last = np.array([needed[level == one].max() for one in np.unique(level)])
    found = np.zeros(len(use), dtype=bool)
    found[order] = (last <= room)[level]
    return found


def replaced(polygons: Polygons, splits: Mapping[int, Shapes]) -> tuple[Polygons, Ints]:
    """Return polygons with the pieces of some in their places, and the parent of each."""
    count = np.ones(len(polygons), dtype=np.int64)
    count[list(splits)] = [len(shapes) for shapes in splits.values()]
    parent = np.repeat(np.arange(len(polygons)), count)
    found = polygons.to_shapely()[parent]
    for number, shapes in splits.items():  # the blocks that split
        found[parent == number] = shapes
    return Polygons.from_shapely(found).oriented(), parent
