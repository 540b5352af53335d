"""Cracks in degenerate positions on Shi's net: covers counted by hand, areas conserved."""

import time
from collections.abc import Sequence

import numpy as np
import pytest
import shapely

from covers.cutting.cut import cut
from covers.cutting.cut_cells import CutCells
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats
from integration.polygons import Polygons

# Triangles of edge 1 in rows of sqrt(3) / 2; NODE has a whole hexagon about it.
HIGH = np.sqrt(3.0) / 2
NET = Triangles.regular([[0.0, 0.0], [6.0, 6 * HIGH]], 1.0)
NODE = np.array([3.0, 2 * HIGH])
BLOCK = Polygons.from_vertices(
    [np.array([[0.5, 0.2], [5.5, 0.2], [5.5, 6 * HIGH - 0.2], [0.5, 6 * HIGH - 0.2]])]
)
AREA = 5.0 * (6 * HIGH - 0.4)
AWAY = [1e-14, -1e-13, 1e-12, -1e-11, 1e-10, 1e-9]


def arm(degrees: float, length: float = 9.0) -> Floats:
    """A crack from NODE outwards."""
    t = np.radians(degrees)
    return np.stack([NODE, NODE + length * np.array([np.cos(t), np.sin(t)])])


def along(degrees: float, back: float = 9.0, ahead: float = 9.0) -> Floats:
    """A crack through NODE."""
    t = np.radians(degrees)
    way = np.array([np.cos(t), np.sin(t)])
    return np.stack([NODE - back * way, NODE + ahead * way])


def moved(cracks: Sequence[Floats], away: float) -> list[Floats]:
    """Every crack moved by itself, each point in a direction of its own."""
    turns = np.random.default_rng(7).uniform(0, 2 * np.pi, size=(len(cracks), 2))
    return [
        crack + away * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        for crack, turn in zip(cracks, turns, strict=True)
    ]


def covers_at(result: CutCells, point: Floats) -> int:
    patch = int(np.argmin(np.hypot(*(NET.patch_centre - point).T)))
    assert np.hypot(*(NET.patch_centre[patch] - point)) < 1e-12
    return int((result.cover_patch == patch).sum())


WHOLE = cut(NET, BLOCK).n_covers

# Cracks; covers of the star of NODE; bodies; tips; covers more than without cracks (None: not
# counted by hand).
CASES = {
    # Along a row of nodes from side to side: the stars of the nodes 1 to 5 of the row have a
    # half above and one below, and those of 0 and 6, which the block enters, too.
    "along edges": ([along(0.0)], 2, 2, 0, 7),
    "through a node, across the cells": ([along(90.0)], 2, 2, 0, None),
    "through a node, slanted": ([along(23.0)], 2, 2, 0, None),
    # The tip does not part the star it ends in; nodes behind it at 2, 1 and 0 are parted.
    "tip on a node, along edges": ([along(0.0, ahead=0.0)], 1, 1, 1, 3),
    # A half edge further: NODE is behind the tip, and the tip lies on an edge of the next node.
    "tip on an edge it runs along": ([along(0.0, ahead=0.5)], 1, 1, 1, 3),
    # Up from NODE the line meets the middle of the opposite edge: the crack starts and ends in the
    # star of NODE, which is left whole.
    "tip on an edge it meets": ([arm(90.0, HIGH)], 1, 1, 2, 0),
    "two cracks that meet in a node": ([arm(0.0), arm(100.0)], 2, 2, 0, None),
    "two cracks in a line that meet in a node": ([arm(0.0), arm(180.0)], 2, 2, 0, 7),
    "three arms along edges": ([arm(0.0), arm(120.0), arm(240.0)], 3, 3, 0, None),
    "three arms at any angle": ([arm(10.0), arm(130.0), arm(251.0)], 3, 3, 0, None),
    "six arms along all edges": ([arm(60.0 * k) for k in range(6)], 6, 6, 0, None),
    "crossing in a node": ([along(0.0), along(60.0)], 4, 4, 0, None),
}


@pytest.mark.parametrize("name", CASES)
def test_covers_about_a_node_are_those_counted_by_hand_and_areas_are_kept(name: str) -> None:
    cracks, of_node, bodies, tips, more = CASES[name]
    result = cut(NET, BLOCK, cracks)
    assert covers_at(result, NODE) == of_node
    assert (result.n_bodies, len(result.tips)) == (bodies, tips)
    if more is not None:
        assert result.n_covers == WHOLE + more
    assert abs(result.elements.areas.sum() - AREA) < 1e-12 * AREA


@pytest.mark.parametrize("away", AWAY)
@pytest.mark.parametrize("name", CASES)
def test_cracks_moved_by_less_than_the_tolerance_part_the_same_covers(
    name: str, away: float
) -> None:
    cracks, of_node, bodies, tips, _ = CASES[name]
    exact, near = cut(NET, BLOCK, cracks), cut(NET, BLOCK, moved(cracks, away))
    assert covers_at(near, NODE) == of_node
    assert (near.n_bodies, len(near.tips), near.n_covers) == (bodies, tips, exact.n_covers)
    assert abs(near.elements.areas.sum() - AREA) < 1e-12 * AREA
    assert shapely.is_valid(near.elements.to_shapely()).all()


def test_a_hundred_thousand_cells_are_cut_in_seconds() -> None:
    disc = Polygons.from_shapely([shapely.Point(0.5, 0.5).buffer(0.49, quad_segs=50)])
    net = Triangles.regular([[0.0, 0.0], [1.0, 1.0]], 0.0057, angle=0.2, shift=(0.3, 0.4))
    assert len(net.cell_vertices) > 90_000
    cracks = [[[-0.1, 0.5], [0.5, 0.52]], [[0.3, 0.3], [0.7, 0.72]]]
    begin = time.process_time()
    result = cut(net, disc, cracks)
    # Measured 0.4 s of one core (benchmarks/bench_cutting.py); the bound says seconds, not minutes.
    assert time.process_time() - begin < 6.0
    assert abs(result.elements.areas.sum() - disc.areas.sum()) < 1e-12
