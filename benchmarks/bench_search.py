"""Contact search on Voronoi blocks, and what its compiled forms save."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely

from integration.polygons import Polygons
from nmm.contact.detection.contacts import follow
from nmm.contact.detection.joints import find_joints
from nmm.contact.detection.narrow_phase import find_contacts
from nmm.contact.detection.neighbour_list import NeighbourList
from nmm.contact.detection.surface import Surface
from nmm.testing.detection.crossings import find_crossings
from nmm.testing.detection.narrow_arrays import find_by_arrays
from nmm.testing.detection.search import near_pairs, near_pairs_by_tree, polygon_surface

SKIN, REACH = 0.02, 0.01
"""Distances of pairs and of contacts, in sizes of a cell."""


def voronoi(blocks: int) -> Surface:
    """Irregular cells of mean area 1, in the order of their rows."""
    side = round(blocks**0.5)
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
    noise = np.random.default_rng(1).uniform(-0.35, 0.35, grid.shape)
    cells = shapely.voronoi_polygons(shapely.multipoints(grid + 0.5 + noise), ordered=True)
    box = shapely.box(0.0, 0.0, side, side)
    inside = shapely.intersection(shapely.get_parts(cells), box)
    return polygon_surface(Polygons.from_shapely(inside))


def tasks(surface: Surface) -> dict[str, Callable[[], object]]:
    """The parts of a search; pairs by the grid and by a tree, contacts compiled and by arrays."""
    neighbours = NeighbourList(SKIN)
    vertex, edge = neighbours.update(surface)
    found = find_contacts(surface, vertex, edge, REACH)
    rng = np.random.default_rng(2)
    way = 0.01 * rng.standard_normal((int(surface.body.max()) + 1, 2))[surface.body]
    after = replace(surface, start=surface.start + way, end=surface.end + way)

    def fresh() -> Surface:
        return replace(surface)  # nothing derived is known yet

    return {
        "pairs, grid": lambda: near_pairs(fresh(), SKIN),
        "pairs, tree": lambda: near_pairs_by_tree(fresh(), SKIN),
        "pairs, list that stands": lambda: neighbours.update(fresh()),
        "contacts, compiled": lambda: find_contacts(fresh(), vertex, edge, REACH, last=found),
        "contacts, arrays": lambda: find_by_arrays(fresh(), vertex, edge, REACH, last=found),
        "predecessors": lambda: follow(found, found),
        "joints": lambda: find_joints(fresh()),
        "crossings": lambda: find_crossings(fresh(), after),
    }


@pytest.mark.parametrize("blocks", [1_000, 10_000])
@pytest.mark.parametrize("name", tasks(voronoi(9)))
def test_contact_search(benchmark: Any, blocks: int, name: str) -> None:
    benchmark.group = f"contact search, {blocks} blocks"
    benchmark.extra_info |= {"part": name}
    benchmark.pedantic(tasks(voronoi(blocks))[name], rounds=5, warmup_rounds=1)
