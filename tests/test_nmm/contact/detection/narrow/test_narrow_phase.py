"""Narrow phase: who touches whom, across which line, and that nothing else changes the answer."""

from dataclasses import fields, replace

import numpy as np
import pytest
import shapely

from integration.polygons import Polygons
from nmm.contact.detection.contacts import VERTEX_VERTEX, Contacts, follow
from nmm.contact.detection.joints import find_joints, joint_ends
from nmm.contact.detection.narrow_phase import find_contacts
from nmm.contact.detection.neighbour_list import NeighbourList
from nmm.contact.detection.surface import Surface, pair_key
from nmm.testing.detection.narrow_arrays import find_by_arrays
from nmm.testing.detection.search import polygon_surface


def rectangle(x, y, width, height, angle=0.0):
    """Rectangle turned about its lower left corner."""
    return np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * [width, height] @ axes(angle) + [x, y]


def axes(angle):
    return np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])


def scene(*rings):
    return polygon_surface(Polygons.from_vertices(rings))


def search(surface, reach=0.01, within_bodies=False, find=find_contacts, **options) -> Contacts:
    vertex, edge = NeighbourList(2 * reach, within_bodies).update(surface)
    return find(surface, vertex, edge, reach, **options)


def placed(surface: Surface, angle: float, shift: float) -> Surface:
    turn = axes(angle)
    return replace(surface, start=surface.start @ turn + shift, end=surface.end @ turn + shift)


def voronoi(cells, seed):
    side = round(cells**0.5)
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
    noise = np.random.default_rng(seed).uniform(-0.35, 0.35, grid.shape)
    sites = shapely.multipoints(grid + 0.5 + noise)
    cells = shapely.get_parts(shapely.voronoi_polygons(sites, ordered=True))
    box = shapely.box(0.0, 0.0, side, side)
    return polygon_surface(Polygons.from_shapely(shapely.intersection(cells, box)))


def shaken(surface: Surface, move: float, turn: float, seed: int) -> Surface:
    """Every body moved and turned about its mean vertex by random amounts."""
    rng = np.random.default_rng(seed)
    body, count = surface.body, np.bincount(surface.body)
    middle = np.stack([np.bincount(body, x) / count for x in surface.start.T], axis=1)[body]
    shift = middle + move * rng.standard_normal((len(count), 2))[body]
    angle = turn * rng.standard_normal(len(count))[body]
    c, s = np.cos(angle), np.sin(angle)

    def go(points):
        x, y = (points - middle).T
        return shift + np.stack([c * x - s * y, s * x + c * y], axis=1)

    return replace(surface, start=go(surface.start), end=go(surface.end))


def upward(surface, contacts, body):
    """Normals of a body's contacts as that body feels them."""
    mine = surface.body[contacts.edge] == body
    touching = mine | (surface.body[contacts.vertex] == body)
    return np.where(mine[:, None], -contacts.normal, contacts.normal)[touching]


# --- what touches ---------------------------------------------------------------------------------


def test_a_block_on_a_floor_has_two_contacts_at_its_lower_corners():
    found = search(scene(rectangle(-5, -1, 10, 1), rectangle(1, 0, 1, 1)))
    assert found.vertex.tolist() == [4, 5]
    assert found.edge.tolist() == [2, 2]
    np.testing.assert_array_equal(found.normal, [[0, 1], [0, 1]])
    np.testing.assert_array_equal(found.gap, [0, 0])
    # The floor's top runs from (5, 0) to (-5, 0).
    np.testing.assert_allclose(found.parameter, [0.4, 0.3], rtol=1e-15)
    np.testing.assert_array_equal(found.kind, [0, 0])


@pytest.mark.parametrize("gap", [0.0, 1e-12, -1e-12, 5e-3, -5e-3])
def test_gap_is_the_signed_distance(gap):
    found = search(scene(rectangle(-5, -1, 10, 1), rectangle(1, gap, 1, 1)))
    np.testing.assert_array_equal(found.gap, [gap, gap])


def test_brick_wall_has_two_contacts_for_each_joint_counted_by_hand():
    # 3 courses of 4: 9 head joints and 14 bed joints of half a brick, two ends each.
    wall = scene(
        *(rectangle(i + 0.5 * (j % 2), 0.5 * j, 1, 0.5) for j in range(3) for i in range(4))
    )
    found = search(wall)
    assert len(found) == 46
    assert (found.normal[:, 0] == 0.0).sum() == 28


def test_aligned_blocks_meet_their_four_neighbours_and_not_those_at_the_corner():
    grid = scene(*(rectangle(i, j, 1, 1) for i in range(3) for j in range(3)))
    found = search(grid)
    assert len(found) == 24  # 12 joints
    i, j = np.divmod(grid.body, 3)
    v, e = found.vertex, found.edge
    assert (np.abs(i[v] - i[e]) + np.abs(j[v] - j[e]) == 1).all()


@pytest.mark.parametrize("seed", [0, 1])
def test_closed_voronoi_cells_have_two_contacts_for_each_joint(seed):
    cells = voronoi(400, seed)
    joints = find_joints(cells)
    thin = cells.thickness
    long = joints.length > 1e-3 * np.minimum(thin[joints.edge_a], thin[joints.edge_b])
    found = search(cells, 1e-6)
    # A joint shorter than what counts as flush has one contact.
    assert len(found) == 2 * long.sum() + (~long).sum()
    vertex, edge, _ = joint_ends(cells, joints)
    assert np.isin(found.key, pair_key(cells, vertex, edge)).all()


def test_reentrant_vertices_meet_nothing_and_a_block_in_a_notch_touches_both_faces():
    notch = np.array([[0, 0], [3, 0], [3, 2], [2, 2], [2, 1], [1, 1], [1, 2], [0, 2]], dtype=float)
    surface = scene(notch, rectangle(1, 1, 0.5, 0.5))
    found = search(surface)
    reentrant = [4, 5]
    assert not np.isin(found.vertex, reentrant).any()
    corner = found.take(found.vertex == 8)  # lies in the corner of the notch
    np.testing.assert_array_equal(np.sort(corner.normal, axis=0), [[0, 0], [1, 1]])
    assert len(found) == 4


KINKS = {  # a slope of 45 degrees and the flat at its foot, which is the origin
    "one body": ([[-4, 4], [-4, -2], [6, -2], [6, 0], [0, 0]],),
    "one on the other": ([[-4, 4], [-4, 0], [0, 0]], [[-4, 0], [-4, -2], [6, -2], [6, 0]]),
    "side by side": ([[-4, 4], [-4, -2], [0, -2], [0, 0]], [[0, 0], [0, -2], [6, -2], [6, 0]]),
}


@pytest.mark.parametrize("find", [find_contacts, find_by_arrays])
@pytest.mark.parametrize("ground", KINKS)
@pytest.mark.parametrize("up", [0.0, 1e-12, 1e-6])
def test_a_toe_in_a_kink_meets_the_flat_that_a_flush_block_covers(ground, up, find):
    wedge = np.array([[-up, up], [-up, 2 + up], [-2 - up, 2 + up]])
    rings = [np.array(ring, dtype=float) for ring in KINKS[ground]]
    surface = scene(*rings, wedge, rectangle(0, 0, 2, 2))
    found = search(surface, find=find)
    toe = found.take(found.vertex == sum(map(len, rings)))
    flat = (surface.body[toe.edge] < len(rings)) & (toe.normal[:, 1] == 1.0)
    assert flat.sum() == 1
    np.testing.assert_allclose(toe.gap[flat], up, rtol=0, atol=1e-15)


def test_vertex_on_vertex_is_one_contact_whatever_the_angles():
    for turn in np.linspace(0.0, np.pi / 2, 19):
        diamond = rectangle(0, 0, 1, 1, np.pi / 4)
        other = rectangle(0, 0, 1, 1, np.pi / 4 - np.pi + 0.3 * turn)
        found = search(scene(diamond, other), 1e-3)
        assert len(found) == 1
        assert found.kind[0] == VERTEX_VERTEX
        assert abs(found.gap[0]) < 1e-15


@pytest.mark.parametrize("angle", [1e-14, 1e-12, 1e-9, 1e-6, 1e-4])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_nearly_parallel_edges_have_a_contact_at_either_end_with_its_own_gap(angle, sign):
    block = rectangle(0, 0, 1, 1, sign * angle)
    found = search(scene(rectangle(-5, -1, 10, 1), block))
    assert found.vertex.tolist() == [4, 5]
    np.testing.assert_allclose(found.gap, [0.0, sign * np.sin(angle)], rtol=0, atol=1e-18)


def test_corners_that_overlap_part_across_the_side_of_least_penetration():
    for dx, dy in ((1e-3, 2e-3), (2e-3, 1e-3), (1e-5, 1e-2), (-1e-4, 3e-3), (2e-2, 1e-2)):
        surface = scene(rectangle(0, 0, 1, 1), rectangle(1 - dx, 1 - dy, 1, 1))
        found = search(surface)
        normal = upward(surface, found, 1)
        np.testing.assert_array_equal(normal, np.tile([dx < dy, dx > dy], (len(found), 1)))
        np.testing.assert_allclose(found.gap, -min(dx, dy), atol=1e-15)
        assert 1 <= len(found) <= 2


def test_wide_open_corners_have_the_line_that_separates_them_most():
    surface = scene(rectangle(0, 0, 1, 1), rectangle(1.002, 1.005, 1, 1))
    found = search(surface)
    np.testing.assert_array_equal(upward(surface, found, 1), [[0, 1]])
    np.testing.assert_allclose(found.gap, 0.005, rtol=1e-12)


def test_motion_chooses_the_line_that_will_be_met():
    # The block comes from the left, 5 mm to go, and passes 1 mm above the other.
    surface = scene(rectangle(0, 0, 1, 1), rectangle(-1.005, 1.001, 1, 1))
    found = search(surface, 0.1)
    np.testing.assert_array_equal(upward(surface, found, 1), [[-1, 0]])
    motion = np.where((surface.body == 1)[:, None], [0.03, 0.0], 0.0)
    found = search(surface, 0.1, motion=motion)
    np.testing.assert_array_equal(upward(surface, found, 1), [[0, 1]])


@pytest.mark.parametrize("depth", [1e-9, 1e-3, 0.049])
def test_a_vertex_inside_by_less_than_a_tenth_of_the_thickness_is_found(depth):
    # Twice the area over the perimeter of a unit square: 0.5. The reach plays no part.
    surface = scene(rectangle(0, 0, 1, 1), rectangle(0.3, 1 - depth, 1, 1))
    found = search(surface, 1e-6)
    np.testing.assert_allclose(found.gap, [-depth, -depth], rtol=1e-6)
    deeper = scene(rectangle(0, 0, 1, 1), rectangle(0.3, 0.949, 1, 1))
    assert len(search(deeper, 1e-6)) == 0


def test_thin_plates_side_by_side_touch_their_neighbours_only():
    plates = scene(*(rectangle(0.01 * i, 0.1 * (i % 2), 0.01, 1) for i in range(6)))
    found = search(plates, 0.005)
    assert (np.abs(plates.body[found.vertex] - plates.body[found.edge]) == 1).all()
    assert len(found) == 10  # five joints
    np.testing.assert_allclose(found.gap, 0.0, atol=1e-16)
    # With a reach of five plates others are seen, past the ends, but nobody is inside another.
    assert search(plates, 0.05).gap.min() > -1e-16


@pytest.mark.parametrize("scale", [1e-4, 1e4])
def test_blocks_of_size_ratio_1e4_touch_like_others(scale):
    surface = scene(rectangle(-1, -1, 2, 1), rectangle(-0.3 * scale, 0, scale, scale))
    found = search(surface, 1e-3 * min(scale, 1.0))
    assert len(found) == 2
    np.testing.assert_array_equal(upward(surface, found, 1), [[0, 1], [0, 1]])


def test_strips_of_aspect_1e4_stacked_touch_at_their_ends():
    strips = scene(*(rectangle(0.1 * (i % 2), 1e-4 * i, 1, 1e-4) for i in range(10)))
    found = search(strips, 1e-6)
    assert len(found) == 18
    np.testing.assert_array_equal(np.abs(found.normal), np.tile([0, 1], (18, 1)))


def test_a_face_of_many_edges_meets_like_one():
    x = np.linspace(-5, 5, 41)
    floor = np.concatenate([[[-5, -1], [5, -1]], np.stack([x[::-1], 0 * x], axis=1)])
    block = np.array([[0, 0], [0.4, 0], [0.8, 0], [0.8, 1], [0, 1]])
    for way in np.linspace(0.0, 1.0, 41):
        surface = scene(floor, block + np.array([way, -1e-4]))
        found = search(surface, 1e-3)
        np.testing.assert_array_equal(upward(surface, found, 1), np.tile([0, 1], (len(found), 1)))
        # Three vertices of the block and the nodes of the floor below it, no place twice.
        position = surface.start[found.vertex][:, 0]
        assert len(np.unique(position.round(6))) == len(found) >= 5


def test_the_far_face_of_a_thin_neck_is_not_taken_for_a_face_overlapped():
    neck = [[0, 0], [1, 0], [1, 0.49], [1.5, 0.49], [2, 0.49], [2, 0], [3, 0]]
    mirrored = [[x, 1 - y] for x, y in reversed(neck)]
    surface = scene(np.array(neck + mirrored, dtype=float))
    assert len(search(surface, within_bodies=True)) == 0


def test_faces_of_a_crack_touch_only_when_asked():
    slit = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [2, 1], [2, 2], [0, 2]], dtype=float)
    surface = scene(slit)
    assert len(search(surface)) == 0
    found = search(surface, within_bodies=True)
    assert len(found) == 1
    np.testing.assert_array_equal(np.abs(found.normal), [[0, 1]])
    assert sorted([found.vertex[0], found.corner[0]]) == [2, 4]


def separation(p, q):
    """Largest separation of two convex polygons over their edge normals, and that normal."""
    best, normal = -np.inf, None
    for a, b, sign in ((p, q, 1.0), (q, p, -1.0)):
        edge = np.roll(a, -1, axis=0) - a
        outward = np.stack([edge[:, 1], -edge[:, 0]], axis=1) / np.hypot(*edge.T)[:, None]
        apart = np.einsum("eqk,ek->eq", b[None] - a[:, None], outward).min(axis=1)
        if apart.max() > best:
            best, normal = apart.max(), sign * outward[apart.argmax()]
    return best, normal


def convex(rng, size):
    """Random convex polygon of three to seven vertices."""
    angle = np.sort(rng.uniform(0, 2 * np.pi, rng.integers(3, 8)))
    ellipse = np.stack([np.cos(angle), rng.uniform(0.2, 1) * np.sin(angle)], axis=1)
    return size * ellipse @ axes(rng.uniform(0, 2 * np.pi))


@pytest.mark.parametrize("seed", range(4))
def test_two_convex_bodies_part_along_the_axis_that_separates_them_most(seed):
    # The separating axis theorem is exact for convex bodies, inside and outside.
    rng, judged = np.random.default_rng(seed), 0
    while judged < 150:
        p, q = convex(rng, 1.0), convex(rng, 10 ** rng.uniform(-1, 0))
        turn = rng.uniform(0, 2 * np.pi)
        way = np.array([np.cos(turn), np.sin(turn)])
        wanted = rng.choice([-1.0, 1.0]) * 10 ** rng.uniform(-6, -2.2)
        low, high = 0.0, 5.0
        for _ in range(36):  # bisection for the separation that is wanted, to 1e-10
            middle = 0.5 * (low + high)
            less = separation(p, q + middle * way)[0] < wanted
            low, high = (middle, high) if less else (low, middle)
        q = q + high * way
        exact, normal = separation(p, q)
        surface = scene(p, q)
        thin = surface.thickness.min()
        distance = shapely.Polygon(p).distance(shapely.Polygon(q))
        skewed = abs(exact - wanted) > 1e-9 or thin < 0.02 or exact < -0.09 * thin
        if skewed or distance > 0.01:
            continue
        judged += 1
        found = search(surface)
        felt = upward(surface, found, 1)
        nearest = found.gap.argmin()
        # Lines within the angular tolerance are one where they meet: 0.05 of a thousandth.
        np.testing.assert_allclose(found.gap[nearest], exact, rtol=0, atol=5e-5 * thin)
        assert felt[nearest] @ normal > 1.0 - 0.05**2
        assert (felt @ felt.T).min() > 0.99  # no contact pulls another way


def test_tips_that_cross_without_a_vertex_inside_are_parted():
    blade = np.array([[0.0, 0.0], [1.0, -0.02], [1.0, 0.02]])
    surface = scene(blade, blade @ axes(np.pi / 2) + [5e-3, -1.5e-3])
    found = search(surface)
    exact, normal = separation(surface.start[:3], surface.start[3:])
    assert exact < 0.0
    np.testing.assert_allclose(found.gap, exact, rtol=1e-9)
    np.testing.assert_allclose(upward(surface, found, 1), [normal], atol=1e-12)


# --- no catching ----------------------------------------------------------------------------------


@pytest.mark.parametrize("depth", [1e-3, 1e-5, 1e-12, 0.0, -1e-12, -1e-4])
@pytest.mark.parametrize("reach", [1e-5, 0.05])
def test_a_block_sliding_over_a_floor_of_ten_blocks_meets_nothing_but_the_floor(depth, reach):
    floor = [rectangle(i, -1, 1, 1) for i in range(10)]
    last = None
    for x in np.concatenate([np.linspace(3.5, 5.5, 81), 4 + np.array([1e-12, -1e-9, 1e-5, 4e-4])]):
        surface = scene(*floor, rectangle(x, -depth, 1, 1))
        found = search(surface, reach, last=last)
        normal = upward(surface, found, 10)
        if -depth <= reach:
            assert len(normal) >= 2
        np.testing.assert_array_equal(normal, np.tile([0.0, 1.0], (len(normal), 1)))
        last = found


@pytest.mark.parametrize("seed", range(20))
def test_a_floor_that_has_settled_unevenly_catches_nothing_either(seed):
    rng = np.random.default_rng(seed)
    uneven, depth = 10 ** rng.uniform(-12, -4), 10 ** rng.uniform(-9, -2.5)
    angle, shift = rng.uniform(-3, 3), rng.choice([0.0, 1e3, 1e6])
    floor = [
        rectangle(i, -1, 1, 1, 0.3 * uneven * rng.normal()) + uneven * rng.normal(size=2)
        for i in range(6)
    ]
    width, height = rng.uniform(0.5, 3), rng.uniform(0.3, 2)
    last = None
    # Also with a side within the unevenness of a joint, where the corner is pressed into it.
    for x in np.concatenate([np.linspace(1.0, 2.2, 15), 2 + 10 ** rng.uniform(-12, -3, 10)]):
        block = rectangle(x, -depth, width, height, uneven * rng.normal())
        surface = placed(scene(*floor, block), angle, shift)
        last = search(surface, 1e-3, last=last)
        normal = upward(surface, last, 6) @ axes(angle).T
        assert len(normal) >= 2
        # Floor and block are turned by up to some 1e-4.
        np.testing.assert_allclose(normal, np.tile([0, 1], (len(normal), 1)), rtol=0, atol=1e-3)


@pytest.mark.parametrize("depth", [1e-3, 0.0, -1e-4])
def test_a_course_slides_over_another_without_catching_a_head_joint(depth):
    for way in (-0.3, -1e-3, -1e-6, 0.0, 1e-9, 1e-4, 5e-4, 0.02, 0.5):
        lower = [rectangle(i, 0, 1, 1) for i in range(4)]
        surface = scene(*lower, *(rectangle(i + way, 1 - depth, 1, 1) for i in range(4)))
        found = search(surface)
        upper = surface.body >= 4
        between = upper[found.vertex] != upper[found.edge]
        assert between.sum() >= 8
        np.testing.assert_array_equal(np.abs(found.normal[between, 0]), 0.0)
        np.testing.assert_array_equal(np.abs(found.normal[~between, 1]), 0.0)


def test_a_real_step_in_a_floor_still_stops_a_block():
    floor = [rectangle(0, -1, 1, 1), rectangle(1, -0.9, 1, 1)]
    surface = scene(*floor, rectangle(-0.001, -1e-5, 1, 1))
    found = search(surface)
    stop = found.take((surface.body[found.edge] == 1) | (surface.body[found.vertex] == 1))
    facing = upward(surface, stop.take(surface.body[stop.edge] != 0), 2)
    assert [-1.0, 0.0] in facing.tolist()


def test_a_wall_on_the_same_floor_stops_a_block_at_both_corners():
    surface = scene(rectangle(-5, -1, 10, 1), rectangle(1, 0, 1, 3), rectangle(-0.001, -1e-4, 1, 1))
    found = search(surface)
    wall = np.isin(surface.body[found.vertex], [1, 2]) & np.isin(surface.body[found.edge], [1, 2])
    assert wall.sum() == 2
    np.testing.assert_allclose(found.gap[wall], 0.001, rtol=1e-9)
    np.testing.assert_array_equal(np.abs(found.normal[wall]), [[1, 0], [1, 0]])


# --- history --------------------------------------------------------------------------------------


def test_the_line_of_the_last_step_stays_while_another_is_no_better_by_much():
    def corners(dx):
        return scene(rectangle(0, 0, 1, 1), rectangle(1 - dx, 1 - 1e-4, 1, 1))

    wide, narrow = corners(1.01e-4), corners(0.99e-4)  # on either side of the diagonal
    assert abs(search(wide).normal[0, 1]) == 1.0
    assert abs(search(narrow).normal[0, 0]) == 1.0
    first = last = search(wide)
    for k in range(20):
        last = search(wide if k % 2 else narrow, last=last)
        np.testing.assert_array_equal(last.key, first.key)
    # Hysteresis, not glue: far enough across the diagonal the other side is the way out.
    found = search(corners(1e-2), last=search(narrow))
    assert abs(found.normal[0, 1]) == 1.0


def test_contacts_are_followed_along_an_edge_around_a_corner_and_through_a_change_of_roles():
    x = np.linspace(-5, 5, 11)
    floor = np.concatenate([[[-5, -1], [5, -1]], np.stack([x[::-1], 0 * x], axis=1)])
    slider = np.array([[-0.5, 1], [0, 0], [0.5, 1]])
    old = search(scene(floor, slider + np.array([0.4, 0])), 0.3)
    near = search(scene(floor, slider + np.array([0.45, 0])), 0.3)
    far = search(scene(floor, slider + np.array([1.3, 0])), 0.3)
    np.testing.assert_array_equal(follow(old, near), [0])  # the same edge
    assert near.key[0] == old.key[0]
    assert far.key[0] != old.key[0]
    np.testing.assert_array_equal(follow(near, far), [0])  # the next edge of the same body
    # Two corners: the vertex of one over the edge of the other, then the other way round.
    one = search(scene(rectangle(0, 0, 1, 1), rectangle(1 - 1e-5, 1, 1, 1, 1e-3)), 1e-3)
    two = search(scene(rectangle(0, 0, 1, 1), rectangle(1 + 1e-5, 1, 1, 1, 1e-3)), 1e-3)
    assert len(one) == len(two) == 1
    np.testing.assert_array_equal(follow(one, two), [0])


def test_what_left_has_no_successor_and_nobody_inherits_twice():
    cells = voronoi(100, 1)
    old = search(cells, 1e-3)
    new = search(shaken(cells, 1e-3, 1e-3, 2), 1e-3)
    past = follow(old, new)
    known = past[past >= 0]
    assert len(np.unique(known)) == len(known) > 100
    same = np.isin(new.key, old.key)
    np.testing.assert_array_equal(old.key[past[same]], new.key[same])
    assert (follow(old.take(np.arange(0)), new) == -1).all()
    assert len(follow(old, new.take(np.arange(0)))) == 0


# --- invariance and oracles -----------------------------------------------------------------------


@pytest.mark.parametrize(("angle", "shift"), [(0.0, 1e6), (0.7, 0.0), (np.pi / 2, 0), (2.5, -1e6)])
def test_contacts_do_not_depend_on_where_the_scene_is(angle, shift):
    wall = scene(
        *(rectangle(i + 0.5 * (j % 2), 0.5 * j, 1, 0.5) for j in range(4) for i in range(5))
    )
    for surface in (wall, shaken(wall, 1e-3, 1e-3, 1), voronoi(100, 2)):
        here, there = search(surface), search(placed(surface, angle, shift))
        np.testing.assert_array_equal(here.key, there.key)
        # Coordinates of 1e6 carry 1.2e-10; directions of the shortest edges lose a thousandfold.
        np.testing.assert_allclose(here.gap, there.gap, rtol=0, atol=2e-9)
        np.testing.assert_allclose(here.normal @ axes(angle), there.normal, rtol=0, atol=1e-6)


def test_scaled_scenes_have_scaled_contacts():
    cells = shaken(voronoi(100, 4), 1e-3, 1e-3, 5)
    here = search(cells, 1e-3)
    big = search(replace(cells, start=1e5 * cells.start, end=1e5 * cells.end), 1e2)
    np.testing.assert_array_equal(here.key, big.key)
    np.testing.assert_allclose(1e5 * here.gap, big.gap, rtol=0, atol=1e-9)


def test_candidates_from_brute_force_make_the_same_contacts_in_any_order():
    cells = shaken(voronoi(225, 6), 2e-3, 2e-3, 7)
    n = len(cells)
    vertex, edge = (k.ravel() for k in np.indices((n, n)))
    other = cells.body[vertex] != cells.body[edge]
    order = np.random.default_rng(0).permutation(other.sum())
    everything = find_contacts(cells, vertex[other][order], edge[other][order], 5e-3)
    assert equal(everything, search(cells, 5e-3))


def equal(a: Contacts, b: Contacts) -> bool:
    pairs = [(getattr(a, part.name), getattr(b, part.name)) for part in fields(a)]
    return all(x.shape == y.shape and np.allclose(x, y, rtol=1e-12, atol=1e-14) for x, y in pairs)


@pytest.mark.parametrize("seed", range(12))
def test_compiled_and_plain_form_agree(seed):
    rng = np.random.default_rng(seed)
    cells = shaken(voronoi(100, seed), 10 ** rng.uniform(-9, -0.7), 10 ** rng.uniform(-9, -0.3), 1)
    reach = 10 ** rng.uniform(-6, 0)
    motion = reach * rng.standard_normal(cells.start.shape) if seed % 2 else None
    first = search(cells, reach, motion=motion)
    assert equal(first, search(cells, reach, motion=motion, find=find_by_arrays))
    later = shaken(cells, 0.1 * reach, 0.0, 2)
    assert equal(
        search(later, reach, motion=motion, last=first),
        search(later, reach, motion=motion, last=first, find=find_by_arrays),
    )


def test_1000_voronoi_cells_shaken_are_found_by_both_forms_alike():
    cells = shaken(voronoi(1000, 8), 1e-3, 1e-3, 9)
    found = search(cells, 5e-3)
    assert equal(found, search(cells, 5e-3, find=find_by_arrays))
    assert len(np.unique(found.key)) == len(found) > 5000


@pytest.mark.parametrize("find", [find_contacts, find_by_arrays])
def test_an_edge_without_length_meets_nothing(find):
    doubled = np.array([[0, 0], [1, 0], [1, 1], [0.5, 1], [0.5, 1], [0, 1]], dtype=float)
    found = search(scene(doubled, rectangle(0.3, 1, 0.5, 1)), find=find)
    assert 3 not in found.edge
    np.testing.assert_array_equal(np.abs(found.normal), np.tile([0, 1], (len(found), 1)))


def test_no_edges_have_no_contacts():
    none, index = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    surface = Surface(none, none, index, index, index)
    assert len(search(surface)) == 0
