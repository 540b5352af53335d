"""Voronoi tessellation: count, area, shared vertices, kept points, determinism."""

import numpy as np
import pytest
import shapely

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.errors import GeometryError
from nmm.geometry import tessellate
from nmm.geometry.tessellation.short_edges import edge_lengths

BEAM = Polygons.from_vertices([np.array([[0, 0], [0.4, 0], [0.4, 0.1], [0, 0.1]])])
KEEP = [[0.05, 0], [0.35, 0], [0.145, 0.1], [0.155, 0.1], [0.245, 0.1], [0.255, 0.1]]
# Non-convex, with a hole: the polygon of benchmark D1, area 15/2.
OUTLINE = [[0, 0], [4, 0], [4, 3], [2, 1], [0, 3]]
HOLE = [[1.5, 0.25], [2.5, 0.25], [2.5, 0.75], [1.5, 0.75]]
NOTCHED = Polygons.from_rings([[OUTLINE, HOLE]])


def _directed_edges(cells: Polygons) -> Floats:
    return np.concatenate([cells.points, cells.points[cells.next_point]], axis=1)


def _outer_edges(cells: Polygons) -> Floats:
    """Edges without the same edge in the other sense, compared bit by bit."""
    edges = _directed_edges(cells)
    known = {edge.tobytes() for edge in edges}
    alone = [edge for edge in edges if np.roll(edge, 2).tobytes() not in known]
    return np.array(alone)


@pytest.mark.parametrize("blocks", [1, 2, 3, 130, 455])
@pytest.mark.parametrize("seed", [0, 1])
def test_a_beam_has_the_asked_number_of_blocks_and_its_own_area(blocks: int, seed: int) -> None:
    cells = tessellate(BEAM, blocks, seed=seed, keep=KEEP)
    assert len(cells) == blocks
    assert cells.areas.min() > 0
    # Sums of some hundred areas: rounding only.
    assert cells.areas.sum() == pytest.approx(0.04, rel=1e-12)
    assert shapely.is_valid(cells.to_shapely()).all()


@pytest.mark.parametrize("blocks", [130, 455])
def test_neighbours_share_their_vertices_bit_by_bit(blocks: int) -> None:
    outer = _outer_edges(tessellate(BEAM, blocks, seed=2, keep=KEEP))
    lengths = np.hypot(outer[:, 2] - outer[:, 0], outer[:, 3] - outer[:, 1])
    # All edges that no neighbour has lie on the outline, whose length is 1 m.
    assert lengths.sum() == pytest.approx(1.0, rel=1e-12)
    on_side = np.minimum(outer % 0.1, 0.1 - outer % 0.1) < 1e-15
    assert (on_side.reshape(-1, 2, 2).any(axis=2)).all()


def test_corners_and_kept_points_are_vertices_exactly() -> None:
    points = {tuple(point) for point in tessellate(BEAM, 455, seed=3, keep=KEEP).points.tolist()}
    wanted = [*BEAM.points.tolist(), *KEEP]
    assert [point for point in wanted if tuple(point) not in points] == []


def test_the_same_seed_gives_the_same_bytes_and_another_seed_does_not() -> None:
    first, second = (tessellate(BEAM, 130, seed=5).points.tobytes() for _ in range(2))
    assert first == second
    assert tessellate(BEAM, 130, seed=6).points.tobytes() != first


@pytest.mark.parametrize("smoothing", [0, 2])
def test_short_edges_are_collapsed(smoothing: int) -> None:
    raw = edge_lengths(tessellate(BEAM, 455, seed=1, smoothing=smoothing, shortest_edge=0.0))
    # Without collapse a diagram of independent points has edges far below a thousandth.
    assert raw.min() < 1e-2 * raw.mean()
    cells = tessellate(BEAM, 455, seed=1, smoothing=smoothing)
    short = edge_lengths(cells) < 0.2 * raw.mean()
    # A collapse is refused where it would lose a cell: a few wedges of unsmoothed diagrams.
    assert short.sum() <= (0 if smoothing else 3)
    assert len(cells) == 455
    assert cells.areas.sum() == pytest.approx(0.04, rel=1e-12)


@pytest.mark.parametrize("blocks", [1, 2, 5, 50, 300])
def test_a_notched_region_with_a_hole_is_filled(blocks: int) -> None:
    cells = tessellate(NOTCHED, blocks, seed=1)
    assert len(cells) == blocks
    assert cells.areas.sum() == pytest.approx(7.5, rel=1e-12)
    region = NOTCHED.to_shapely()[0]
    union = shapely.union_all(cells.to_shapely())
    assert shapely.area(shapely.symmetric_difference(region, union)) < 1e-12


def test_a_region_far_away_is_filled_alike() -> None:
    shift = np.array([1e6, -1e6])
    near = tessellate(BEAM, 130, seed=4)
    far = tessellate(BEAM.with_points(BEAM.points + shift), 130, seed=4)
    assert len(far) == 130
    # Coordinates near 1e6 are known to 1.2e-10.
    assert np.abs(np.sort(near.areas) - np.sort(far.areas)).max() < 1e-9 * 0.1
    assert {tuple(p) for p in (BEAM.points + shift).tolist()} <= {tuple(p) for p in far.points}


def test_scale_does_not_matter() -> None:
    near = tessellate(BEAM, 130, seed=4)
    large = tessellate(BEAM.with_points(BEAM.points * 2.0**20), 130, seed=4)
    assert large.areas.sum() == pytest.approx(0.04 * 2.0**40, rel=1e-12)
    assert len(large.points) == len(near.points)


def test_a_kept_point_off_the_boundary_is_refused() -> None:
    with pytest.raises(GeometryError, match=r"beam: point \[0.2, 0.05\] is 0.05 m away"):
        tessellate(BEAM, 10, keep=[[0.2, 0.05]], place="beam")
