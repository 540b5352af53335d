"""A cut by cracks that have grown is, to the last bit, what cutting everything anew gives."""

from dataclasses import fields, is_dataclass

import numpy as np
import pytest

from covers.cutting.again.recut import cut_again
from covers.cutting.again.window import window_of
from covers.cutting.cracks import crack_segments
from covers.cutting.cut import cut, cutting
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons

SQUARE = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
BOUNDS = [[0.0, 0.0], [1.0, 1.0]]


def assert_same(one, two, name="cut"):
    """Compare records field by field, bit by bit."""
    if is_dataclass(one):
        for item in fields(one):
            assert_same(getattr(one, item.name), getattr(two, item.name), f"{name}.{item.name}")
    elif isinstance(one, np.ndarray):
        assert one.dtype == two.dtype, name
        np.testing.assert_array_equal(one, two, err_msg=name)
    else:
        assert one == two, name


def grown(line, angle, pieces, length=0.06):
    """Polylines that go on from one, piece by piece, in a curve."""
    yield line
    for number in range(pieces):
        turn = angle + 0.35 * np.sin(1.7 * number)
        line = np.vstack([line, line[-1] + length * np.array([np.cos(turn), np.sin(turn)])])
        yield line


@pytest.mark.parametrize(
    ("kind", "angle", "seed"),
    [(Triangles, 0.0, 0), (Triangles, 0.3, 1), (Quads, 0.0, 2), (Quads, 0.71, 3)],
)
def test_it_is_the_same_bit_by_bit(kind, angle, seed):
    draw = np.random.default_rng(seed)
    net = kind.regular(BOUNDS, 0.07, angle=angle, shift=draw.random(2))
    region = Polygons.from_vertices([np.array(SQUARE)])
    other = np.array([[0.62, 0.3], [0.75, 0.35]])
    notch = np.array([[-0.1, 0.5], [0.2, 0.5]])
    now, local = None, 0
    for line in grown(notch, draw.uniform(-0.4, 0.4), 9):
        cracks = [line, other]
        if now is None:
            now = cutting(net, region, cracks)
            continue
        local += window_of(now, crack_segments(cracks)) is not None
        now = cut_again(now, cracks)
        assert_same(now.cells, cut(net, region, cracks))
    assert local > 3


def test_a_crack_that_meets_another_and_one_that_begins():
    net = Triangles.regular(BOUNDS, 0.06, angle=0.2)
    region = Polygons.from_vertices([np.array(SQUARE)])
    one, other = [[0.2, 0.5], [0.5, 0.5]], [[0.55, 0.3], [0.55, 0.7]]
    now = cutting(net, region, [one, other])
    for cracks in (
        [[*one, [0.55, 0.5]], other],
        [[*one, [0.55, 0.5]], other, [[0.3, 0.7], [0.37, 0.73]]],
        [[[0.17, 0.47], *one, [0.55, 0.5]], other, [[0.3, 0.7], [0.37, 0.73]]],
    ):
        assert window_of(now, crack_segments(cracks)) is not None
        now = cut_again(now, cracks)
        assert_same(now.cells, cut(net, region, cracks))


@pytest.mark.parametrize(
    "cracks",
    [
        [[[0.2, 0.5], [0.5, 0.52]]],  # not the crack of before
        [[[0.2, 0.5], [0.5, 0.5], [0.98, 0.5]]],  # to the boundary
        [],
    ],
)
def test_what_did_not_only_grow_inside_is_cut_anew(cracks):
    net = Triangles.regular(BOUNDS, 0.06, angle=0.2)
    region = Polygons.from_vertices([np.array(SQUARE)])
    now = cutting(net, region, [[[0.2, 0.5], [0.5, 0.5]]])
    assert window_of(now, crack_segments(cracks)) is None
    assert_same(cut_again(now, cracks).cells, cut(net, region, cracks))


def test_pieces_outside_all_material_change_nothing():
    net = Triangles.regular(BOUNDS, 0.06, angle=0.2)
    region = Polygons.from_vertices([np.array(SQUARE)])
    now = cutting(net, region, [[[-0.2, 0.5], [0.5, 0.5]]])
    longer = [[[-0.5, 0.5], [-0.2, 0.5], [0.5, 0.5]]]
    assert_same(cut_again(now, longer).cells, cut(net, region, longer))
