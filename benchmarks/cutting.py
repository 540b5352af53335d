"""What cutting costs: seconds by number of cells, by kind of cover, by number of blocks.

Median of repeated runs after a warm-up, CPU seconds of one process. Run: ``python
benchmarks/cutting.py``.
"""

from __future__ import annotations

import platform
import time
from collections.abc import Callable, Sequence
from statistics import median

import numpy as np
import shapely
from numpy.typing import ArrayLike

from covers.cutting.cut import cut
from covers.cutting.cut_cells import CutCells
from covers.mathematical.base import Cover
from covers.mathematical.bspline import BSplines
from covers.mathematical.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons

BOUNDS = [[0.0, 0.0], [1.0, 1.0]]
ANGLE, SHIFT = 0.2, (0.3, 0.4)
CRACKS = [[[-0.1, 0.5], [0.5, 0.52]], [[0.3, 0.3], [0.7, 0.72]], [[0.2, 0.8], [0.9, 0.75]]]


def disc() -> Polygons:
    """A disc of 200 corners: its boundary cuts cells at all angles."""
    return Polygons.from_shapely([shapely.Point(0.5, 0.5).buffer(0.49, quad_segs=50)])


def voronoi(number: int) -> Polygons:
    """Voronoi blocks of the unit square."""
    points = shapely.MultiPoint(np.random.default_rng(1).uniform(size=(number, 2)))
    square = shapely.box(0, 0, 1, 1)
    cells = shapely.get_parts(shapely.voronoi_polygons(points, extend_to=square))
    return Polygons.from_shapely(shapely.intersection(cells, square))


def timed(work: Callable[[], CutCells], repeats: int) -> tuple[CutCells, float]:
    """Result and median CPU seconds."""
    result, seconds = work(), []
    for _ in range(repeats):
        begin = time.process_time()
        result = work()
        seconds.append(time.process_time() - begin)
    return result, median(seconds)


def row(
    name: str,
    make: Callable[[], Cover],
    regions: Polygons,
    cracks: Sequence[ArrayLike],
    repeats: int,
) -> str:
    """One line of the table; making the cover is counted."""
    result, seconds = timed(lambda: cut(make(), regions, cracks), repeats)
    cells = len(make().cell_vertices)
    touched = int((~result.element_whole).sum())
    error = abs(result.elements.areas.sum() / regions.areas.sum() - 1)
    return (
        f"| {name} | {cells} | {touched} | {result.n_covers} | {seconds:.3f} "
        f"| {seconds / cells * 1e6:.1f} | {seconds / touched * 1e6:.0f} | {error:.0e} |"
    )


def main(repeats: int = 5, largest: int = 100_000) -> list[str]:
    """Return the lines of the table."""
    lines = [
        f"{platform.processor() or platform.machine()}, Python {platform.python_version()}, "
        f"numpy {np.__version__}, shapely {shapely.__version__}, median of {repeats}",
        "| case | cells | cut elements | covers | s | us a cell | us a cut element | area |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for cells in (1_000, 10_000, 100_000):
        size = np.sqrt(1.42 / cells)  # a turned net reaches beyond the box

        def triangles(size: float = size) -> Cover:
            return Triangles.regular(BOUNDS, 1.52 * size, angle=ANGLE, shift=SHIFT)

        if cells <= largest:
            lines.append(row("triangles, disc, 3 cracks", triangles, disc(), CRACKS, repeats))
    size = np.sqrt(1.42 / min(largest, 10_000))
    kinds: dict[str, Callable[[], Cover]] = {
        "quads": lambda: Quads.regular(BOUNDS, size, angle=ANGLE, shift=SHIFT),
        "splines of degree 2": lambda: BSplines.regular(
            BOUNDS, size, degree=2, angle=ANGLE, shift=SHIFT
        ),
        "splines of degree 3": lambda: BSplines.regular(
            BOUNDS, size, degree=3, angle=ANGLE, shift=SHIFT
        ),
        "least squares": lambda: MovingLeastSquares.regular(BOUNDS, size, angle=ANGLE, shift=SHIFT),
    }
    lines += [
        row(f"{name}, disc, 3 cracks", make, disc(), CRACKS, repeats)
        for name, make in kinds.items()
    ]
    lines += [
        row(
            f"triangles, {blocks} blocks",
            lambda: Triangles.regular(BOUNDS, 1.52 * size, angle=ANGLE, shift=SHIFT),
            voronoi(blocks),
            [],
            repeats,
        )
        for blocks in (10, 100, 1000)
    ]
    return lines


if __name__ == "__main__":
    print("\n".join(main()))
