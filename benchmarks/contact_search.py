"""What contact search costs: milliseconds by number of Voronoi blocks.

Median of interleaved repeats after a warm-up, CPU seconds of one process. Columns:

grid, tree      vertex-edge pairs within 2 % of a cell, by the compiled grid and by shapely's tree
list            `NeighbourList.update` that finds that nothing has moved far
narrow, arrays  the contacts among the pairs, compiled and by whole arrays
follow          predecessors of the contacts
joints          joints with all that is needed to find them
crossing        crossings of a step of 1 % of a cell

The ratios say what the compiled forms save in this run. Run: ``python benchmarks/contact_search.py
[blocks ...]``.
"""

from __future__ import annotations

import platform
import sys
import time
from collections.abc import Callable
from statistics import median

import numpy as np
import shapely

from integration.polygons import Polygons
from nmm.contact.detection.crossing import find_crossings
from nmm.contact.detection.joints import find_joints
from nmm.contact.detection.narrow_phase import find_contacts, follow
from nmm.contact.detection.neighbour_list import NeighbourList, near_pairs
from nmm.contact.detection.surface import Surface
from nmm.testing.contact_search import near_pairs_by_tree, polygon_surface

SKIN, REACH = 0.02, 0.01


def voronoi(blocks: int) -> Surface:
    """Irregular cells of mean area 1, in the order of their rows."""
    side = round(blocks**0.5)
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
    noise = np.random.default_rng(1).uniform(-0.35, 0.35, grid.shape)
    sites = shapely.multipoints(grid + 0.5 + noise)
    cells = shapely.get_parts(shapely.voronoi_polygons(sites, ordered=True))
    box = shapely.box(0.0, 0.0, side, side)
    return polygon_surface(Polygons.from_shapely(shapely.intersection(cells, box)))


def tasks(surface: Surface) -> dict[str, Callable[[], object]]:
    """The work of each column."""
    neighbours = NeighbourList(SKIN)
    vertex, edge = neighbours.update(surface)
    found = find_contacts(surface, vertex, edge, REACH)
    rng = np.random.default_rng(2)
    way = 0.01 * rng.standard_normal((int(surface.body.max()) + 1, 2))[surface.body]
    after = surface.moved(surface.start + way, surface.end + way)

    def fresh() -> Surface:
        return surface.moved(surface.start, surface.end)  # nothing derived is known yet

    return {
        "grid": lambda: near_pairs(fresh(), SKIN),
        "tree": lambda: near_pairs_by_tree(fresh(), SKIN),
        "list": lambda: neighbours.update(fresh()),
        "narrow": lambda: find_contacts(fresh(), vertex, edge, REACH, last=found),
        "arrays": lambda: find_contacts(fresh(), vertex, edge, REACH, last=found, compiled=False),
        "follow": lambda: follow(found, found),
        "joints": lambda: find_joints(fresh()),
        "crossing": lambda: find_crossings(fresh(), after),
    }


def measured(work: dict[str, Callable[[], object]], repeats: int) -> dict[str, float]:
    """Median CPU milliseconds of each task."""
    seconds: dict[str, list[float]] = {name: [] for name in work}
    for turn in range(repeats + 1):
        for name, task in work.items():
            begin = time.process_time()
            task()
            if turn:
                seconds[name].append(time.process_time() - begin)
    return {name: 1e3 * median(values) for name, values in seconds.items()}


def main(blocks: tuple[int, ...] = (1_000, 10_000, 100_000)) -> list[dict[str, float]]:
    """Print the table and return its rows."""
    print(f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}, ms")
    rows: list[dict[str, float]] = []
    for number in blocks:
        surface = voronoi(number)
        work = tasks(surface)
        if not rows:
            print(f"{'blocks':>7} {'contacts':>8}", *(f"{name:>9}" for name in work), end="")
            print("  tree/grid  arrays/narrow")
        row = measured(work, repeats=7 if number < 50_000 else 3)
        vertex, edge = near_pairs(surface, SKIN)
        contacts = len(find_contacts(surface, vertex, edge, REACH))
        print(f"{number:7} {contacts:8}", *(f"{value:9.2f}" for value in row.values()), end="")
        print(
            f"{row['tree'] / row['grid']:11.1f} {row['arrays'] / row['narrow']:14.1f}", flush=True
        )
        rows.append({"blocks": number, "contacts": contacts, **row})
    return rows


if __name__ == "__main__":
    main(tuple(map(int, sys.argv[1:])) or (1_000, 10_000, 100_000))
