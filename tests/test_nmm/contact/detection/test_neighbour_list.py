"""Broad phase: no near pair is missing, and the list is kept as long as it is complete."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import shapely

from integration.polygons import Polygons
from nmm.contact.detection.neighbour_list import NeighbourList
from nmm.contact.detection.surface import Surface
from nmm.testing.detection.search import near_pairs, near_pairs_by_tree, polygon_surface


def voronoi(cells: int, seed: int) -> Surface:
    side = round(cells**0.5)
    rng = np.random.default_rng(seed)
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
    sites = shapely.multipoints(grid + 0.5 + rng.uniform(-0.4, 0.4, grid.shape))
    box = shapely.box(0.0, 0.0, side, side)
    return polygon_surface(
        Polygons.from_shapely(
            shapely.intersection(shapely.get_parts(shapely.voronoi_polygons(sites)), box)
        )
    )


def brute_force(surface: Surface, distance: float) -> dict[tuple[int, int], float]:
    """All pairs with their distances, a vertex after the other."""
    found = {}
    edge = surface.end - surface.start
    square = np.maximum((edge**2).sum(axis=1), 1e-300)
    for v, point in enumerate(surface.start):
        offset = point - surface.start
        s = np.clip((offset * edge).sum(axis=1) / square, 0.0, 1.0)[:, None]
        away = np.hypot(*(offset - s * edge).T)
        near = (away <= distance) & (surface.body != surface.body[v])
        found |= {(v, int(e)): away[e] for e in np.flatnonzero(near)}
    return found


def as_set(pairs: tuple[np.ndarray, np.ndarray]) -> set[tuple[int, int]]:
    return set(zip(pairs[0].tolist(), pairs[1].tolist(), strict=True))


def mixture(seed: int) -> Surface:
    """Squares of side 1e-4 to 1, strips of aspect 1e4, turned and thrown over each other."""
    rng = np.random.default_rng(seed)
    rings = []
    for _ in range(60):
        size = 10.0 ** rng.uniform(-4, 0)
        width = size * (1e-4 if rng.random() < 0.2 else 1.0)
        turn = rng.uniform(0, 2 * np.pi)
        axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * [size, width]
        rings.append(square @ axes + rng.uniform(0, 1.5, 2) ** 2)
    return polygon_surface(Polygons.from_vertices(rings))


REACHES = (1e-6, 0.03, 0.7)


@pytest.fixture(scope="module")
def cells():
    """1000 Voronoi cells, and all their pairs within the longest reach with their distances."""
    surface = voronoi(1000, seed=1)
    return surface, brute_force(surface, max(REACHES))


@pytest.mark.parametrize("distance", REACHES)
def test_grid_finds_the_pairs_of_1000_voronoi_cells_that_brute_force_finds(distance, cells):
    surface, pairs = cells
    vertex, edge = near_pairs(surface, distance)
    assert as_set((vertex, edge)) == {pair for pair, away in pairs.items() if away <= distance}
    key = vertex * len(surface) + edge
    assert (np.diff(key) > 0).all()  # sorted, none twice


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("distance", [1e-5, 1e-2, 1.0])
def test_grid_finds_all_pairs_of_blocks_with_size_ratio_1e4(seed, distance):
    surface = mixture(seed)
    assert as_set(near_pairs(surface, distance)) == brute_force(surface, distance).keys()


def test_grid_and_tree_agree_and_the_scene_may_lie_anywhere():
    still = voronoi(400, seed=2)
    # 0.0301 is no distance of these cells, so that rounding by the shift moves no pair over it.
    expected = as_set(near_pairs_by_tree(still, 0.0301))
    for shift in (0.0, -1e6, 1e6):
        there = replace(still, start=still.start + shift, end=still.end + shift)
        assert as_set(near_pairs(there, 0.0301)) == expected


def test_distances_of_its_own_for_each_edge_count_by_the_smaller():
    surface = voronoi(100, seed=3)
    own = np.random.default_rng(0).uniform(0.01, 0.3, len(surface))
    found = as_set(near_pairs(surface, own))
    expected = set()
    for v, e in brute_force(surface, 0.3):
        if (v, e) in brute_force_pair(surface, v, e, min(own[v], own[e])):
            expected.add((v, e))
    assert found == expected


def brute_force_pair(surface: Surface, v: int, e: int, distance: float) -> set[tuple[int, int]]:
    line = shapely.linestrings([surface.start[e], surface.end[e]])
    near = shapely.distance(shapely.points(surface.start[v]), line) <= distance
    return {(v, e)} if near else set()


def test_faces_of_a_crack_are_paired_on_request_but_not_the_edges_at_the_vertex():
    slit = np.array([[0, 0], [2, 0], [2, 0.99], [1, 1], [2, 1.01], [2, 2], [0, 2]], dtype=float)
    surface = polygon_surface(Polygons.from_vertices([slit]))
    assert as_set(near_pairs(surface, 0.05)) == set()
    pairs = as_set(near_pairs(surface, 0.05, within_bodies=True))
    # Vertices 2 and 4 are the mouths: each meets the opposite face and the edge beyond its mouth.
    assert pairs == {(2, 3), (2, 4), (4, 2), (4, 1)}
    assert as_set(near_pairs_by_tree(surface, 0.05, within_bodies=True)) == pairs


def test_neighbour_list_is_kept_until_points_may_have_met_and_misses_no_pair_before():
    surface, rng = voronoi(36, seed=4), np.random.default_rng(5)
    neighbours = NeighbourList(skin=0.1)
    start, lists = surface.start.copy(), []
    for _ in range(60):
        start = start + rng.normal(scale=2e-3, size=start.shape)
        surface = replace(surface, start=start, end=start[surface.next])
        pairs = neighbours.update(surface)
        found = as_set(pairs)
        assert brute_force(surface, 0.5 * neighbours.skin).keys() <= found
        lists.append(pairs)
    searches = 1 + sum(one is not other for one, other in pairwise(lists))
    assert 1 < searches < 30


def test_neighbour_list_is_not_rebuilt_by_a_shift_of_everything_but_by_another_topology():
    surface = voronoi(100, seed=4)
    neighbours = NeighbourList(skin=0.01)
    pairs = neighbours.update(surface)
    shifted = replace(surface, start=surface.start + 5.0, end=surface.end + 5.0)
    assert neighbours.update(shifted) is pairs
    assert neighbours.update(voronoi(100, seed=5)) is not pairs


def test_vertices_inside_another_body_by_less_than_a_tenth_of_its_thickness_are_candidates():
    # Twice the area over the perimeter of a unit square: 0.5.
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    surface = polygon_surface(Polygons.from_vertices([square, square + np.array([0.3, 0.951])]))
    np.testing.assert_allclose(surface.thickness, 0.5, rtol=1e-15)
    assert (4, 2) in as_set(NeighbourList(skin=1e-9).update(surface))


def test_no_edges_make_no_pairs():
    none, index = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    surface = Surface(none, none, index, index, index)
    assert len(NeighbourList(skin=1.0).update(surface)[0]) == 0
