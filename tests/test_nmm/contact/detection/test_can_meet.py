"""Pairs that need a closer look: none that cross is left out, and what slides fast is."""

from dataclasses import replace

import numpy as np
import pytest

from integration.polygons import Polygons
from nmm.contact.detection import crossing_kernel
from nmm.contact.detection.crossing import crossings_in, motion_of
from nmm.contact.detection.surface import Surface
from nmm.testing.detection.search import near_pairs, polygon_surface


def rectangle(x: float, y: float, width: float, height: float) -> np.ndarray:
    return np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])


def moved(before: Surface, way: np.ndarray) -> Surface:
    return replace(before, start=before.start + way, end=before.end + way[before.next])


@pytest.mark.parametrize("speed", [1e-3, 0.03, 0.1, 0.5])
@pytest.mark.parametrize("share", [1e-3, 0.1])
def test_none_of_the_pairs_that_cross_is_left_out(speed: float, share: float) -> None:
    rng = np.random.default_rng(3)
    for _ in range(60):
        across, up = rng.uniform(-1.3, 1.3), rng.normal(scale=0.02)
        rings = [rectangle(-1, -1, 2, 1), rectangle(across, up, 0.6, 0.4)]
        before = polygon_surface(Polygons.from_vertices(rings))
        after = moved(before, speed * rng.normal(size=(len(before), 2)))
        motion = motion_of(before, after, near_pairs(before, 4.0), share)
        every = type(motion)(before, after, motion.pairs, np.arange(len(motion.pairs[0])))
        some, all_of_them = crossings_in(motion, share), crossings_in(every, share)
        assert list(zip(some.vertex, some.edge, strict=True)) == list(
            zip(all_of_them.vertex, all_of_them.edge, strict=True)
        )


def test_a_block_that_slides_by_a_third_of_its_length_needs_no_closer_look() -> None:
    rings = [rectangle(-5, -1, 10, 1), rectangle(0, -1e-6, 1, 1)]
    before = polygon_surface(Polygons.from_vertices(rings))
    way = np.where((before.body == 1)[:, None], np.array([0.3, -1e-6]), 0.0)
    after = moved(before, way)
    assert motion_of(before, after, near_pairs(before, 0.31), 1e-3).harmless


def test_the_largest_area_of_a_step_is_that_of_fine_steps() -> None:
    rng = np.random.default_rng(5)
    time = np.linspace(0, 1, 20001)[:, None]
    for edge, offset, edge_after, offset_after in rng.normal(size=(50, 4, 2)):
        a, b = edge + time * (edge_after - edge), offset + time * (offset_after - offset)
        largest = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).max()
        given = (tuple(one) for one in (edge, offset, edge_after, offset_after))
        # A parabola of curvature up to some 20, sampled at 1 / 20 000; rounding is added to it.
        assert crossing_kernel._largest_area(*given) == pytest.approx(largest, abs=1e-6)
