"""What every cover of blocks is held to."""

import numpy as np
from shapely import area, union_all

from integration.polygons import Polygons
from nmm.geometry.tessellation.block_cover import BlockCover
from nmm.testing.claims import claim, close, finite

# Shares of an area that rounding of coordinates leaves.
EXACT = 1e-9


def check_block_cover(
    cover: BlockCover, blocks: Polygons | None = None, size: float | None = 0.25
) -> None:
    """Hold a cover of blocks to what every one promises.

    Pieces are counter-clockwise, of blocks that there are, fill these and lie in one another
    nowhere; blocks that it does not divide stay as they are; the same blocks have the same pieces
    when they are asked for again, and are not changed.

    Parameters
    ----------
    cover
        The cover.
    blocks
        What it divides; a square beside a rectangle when not given.
    size
        Of ``[cover]`` (m).

    Raises
    ------
    AssertionError
        Naming the property that is not kept.
    """
    name, given = type(cover).__name__, _two_blocks() if blocks is None else blocks
    before = given.points.copy()
    pieces, source = cover.divided(given, size, 0.0, (0.0, 0.0))
    again, _ = cover.divided(given, size, 0.0, (0.0, 0.0))
    finite(f"{name}: vertices of pieces", pieces.points)
    claim(np.array_equal(before, given.points), f"{name}: it changed the blocks")
    claim(np.array_equal(pieces.points, again.points), f"{name}: pieces differ when asked again")
    claim(len(source) == len(pieces), f"{name}: {len(source)} sources of {len(pieces)} pieces")
    known = np.isin(np.arange(len(given)), source).all() and np.isin(source, np.arange(len(given)))
    claim(bool(np.all(known)), f"{name}: sources are not the {len(given)} blocks, each of them")
    claim(pieces.ring_areas.min() > 0, f"{name}: a piece is not counter-clockwise")
    shapes, wholes = pieces.to_shapely(), given.to_shapely()
    for number, whole in enumerate(wholes):  # a handful of blocks
        own = shapes[source == number]
        what, tolerance = f"{name}: block {number}: areas of its pieces", EXACT * whole.area
        close(what, area(own).sum(), whole.area, tolerance)
        close(f"{what} as one", area(union_all(own)), whole.area, tolerance)
        close(f"{what} outside", area(union_all(own).difference(whole)), 0.0, tolerance)
    if not cover.divides:
        claim(np.array_equal(pieces.points, before), f"{name}: it divides and does not say so")


def _two_blocks() -> Polygons:
    """A square of 1 m, and a rectangle of 2 m by 1 m beside it."""
    boxes = [np.array([[x, 0.0], [x + w, 0], [x + w, 1], [x, 1]]) for x, w in ((0, 1), (1, 2))]
    return Polygons.from_vertices(boxes)
