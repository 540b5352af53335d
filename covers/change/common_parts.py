"""The common parts of old and new elements, whatever GEOS makes of sides that nearly coincide."""

import numpy as np
import numpy.typing as npt
import shapely

from integration.arrays import Bools, Floats, Ints

Shapes = npt.NDArray[np.object_]

# Sums of parts within this share of an element are its area: above the rounding of vertices.
WHOLE = 1e-12
# Vertices are laid on a grid of so many roundings of the farthest coordinate where parts are wrong.
GRID = 4.0


def common_parts(old: Shapes, new: Shapes, parent: Ints, child: Ints) -> Shapes:
    """Return the common parts (k,) of pairs of polygons.

    Of two polygons that touch up to rounding GEOS may return the whole of one. So parts of
    polygons whose area their parts do not add up to are found again, with vertices on a grid, for
    which its overlay is robust.

    Parameters
    ----------
    old, new
        (a,) and (b,) polygons, each without overlaps among themselves.
    parent, child
        (k,) numbers of those that are intersected, all pairs that meet.
    """
    found = shapely.intersection(old[parent], new[child])
    area = np.asarray(shapely.area(found))
    doubtful = np.flatnonzero(_off(old, parent, area)[parent] | _off(new, child, area)[child])
    if len(doubtful):
        far = float(np.abs(shapely.bounds(old)).max())
        first, second = old[parent[doubtful]], new[child[doubtful]]
        grid = GRID * float(np.finfo(np.float64).eps) * far
        found[doubtful] = shapely.intersection(first, second, grid_size=grid)
    return np.asarray(found)


def _off(shapes: Shapes, number: Ints, area: Floats) -> Bools:
    """Whether the areas (k,) of parts miss those of the polygons (n,) that they belong to."""
    whole = np.asarray(shapely.area(shapes))
    return np.asarray(np.abs(np.bincount(number, area, len(shapes)) - whole) > WHOLE * whole)
