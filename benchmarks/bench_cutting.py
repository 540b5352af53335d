"""Cutting by number of cells, kind of cover and number of blocks; making the cover is counted."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest
import shapely

from covers.cutting.cut import cut
from covers.mathematical.base import Cover
from covers.mathematical.bspline import BSplines
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons

BOUNDS = [[0.0, 0.0], [1.0, 1.0]]
CRACKS = [[[-0.1, 0.5], [0.5, 0.52]], [[0.3, 0.3], [0.7, 0.72]], [[0.2, 0.8], [0.9, 0.75]]]
COVERS: dict[str, Callable[..., Cover]] = {
    # of as many cells as squares of the size
    "triangles": lambda bounds, size, **at: Triangles.regular(bounds, 1.52 * size, **at),
    "quads": Quads.regular,
    "splines of degree 2": partial(BSplines.regular, degree=2),
    "splines of degree 3": partial(BSplines.regular, degree=3),
    "least squares": MovingLeastSquares.regular,
}
CASES = [
    *(("triangles", cells, 0) for cells in (1_000, 100_000)),
    *((name, 10_000, 0) for name in COVERS),
    *(("triangles", 10_000, blocks) for blocks in (10, 100, 1000)),
]


def disc() -> Polygons:
    """A disc of 200 corners: its boundary cuts cells at all angles."""
    return Polygons.from_shapely([shapely.Point(0.5, 0.5).buffer(0.49, quad_segs=50)])


def voronoi(number: int) -> Polygons:
    """Voronoi blocks of the unit square."""
    points = shapely.MultiPoint(np.random.default_rng(1).uniform(size=(number, 2)))
    square = shapely.box(0, 0, 1, 1)
    cells = shapely.get_parts(shapely.voronoi_polygons(points, extend_to=square))
    return Polygons.from_shapely(shapely.intersection(cells, square))


@pytest.mark.parametrize(("name", "cells", "blocks"), CASES)
def test_cutting(benchmark: Any, name: str, cells: int, blocks: int) -> None:
    size = np.sqrt(1.42 / cells)  # a turned net reaches beyond the box
    make = partial(COVERS[name], BOUNDS, size, angle=0.2, shift=(0.3, 0.4))
    regions, cracks = (voronoi(blocks), []) if blocks else (disc(), CRACKS)
    benchmark.group = "cutting"
    found = benchmark.pedantic(lambda: cut(make(), regions, cracks), rounds=3, warmup_rounds=1)
    benchmark.extra_info |= {
        "cover": name,
        "cells": len(make().cell_vertices),
        "region": f"{blocks} blocks" if blocks else "disc, 3 cracks",
        "cut elements": int((~found.element_whole).sum()),
        "area error": float(abs(found.elements.areas.sum() / regions.areas.sum() - 1)),
    }
