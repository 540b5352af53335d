"""The polygons of bodies: those of their blocks, or what cracks have left of them."""

import numpy as np
import shapely

from integration.arrays import Ints
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.geometry.blocks import Regions
from nmm.splitting.cuts import Shapes


def outlines(model: Model, regions: Regions) -> tuple[Polygons, Ints]:
    """Return the polygons (B,) of all bodies, and in which of the regions each lies.

    A body that is all that is left in a region has its polygon, a sub-block that of its element;
    where cracks have parted a region under a mesh each body is the union of its elements.
    """
    manifold = model.manifold
    n, body = manifold.n_bodies, manifold.element_body
    shapes = manifold.elements.to_shapely()
    one = np.zeros(n, dtype=np.int64)
    one[body[::-1]] = np.arange(len(body))[::-1]
    blocks = regions.polygons.to_shapely()
    home = _home(shapes[one], blocks)
    single = np.bincount(body, minlength=n) == 1
    shared = np.bincount(home, minlength=len(blocks))[home] > 1
    found = np.where(single, shapes[one], blocks[home])
    for number in np.flatnonzero(shared & ~single):
        # Bodies under a mesh that share a polygon are few: those that cracks have freed.
        found[number] = shapely.union_all(shapes[body == number])
    return Polygons.from_shapely(found).oriented(), home


def _home(elements: Shapes, blocks: Shapes) -> Ints:
    """Return which block each element lies in."""
    inside = shapely.point_on_surface(elements)
    index, home = shapely.STRtree(blocks).query(inside, predicate="within")
    found = np.zeros(len(inside), dtype=np.int64)
    found[index] = home
    return found
