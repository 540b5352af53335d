"""Faces that lie on each other: what of them each contact point stands for."""

import numpy as np
import pytest

from integration.polygons import Polygons
from nmm.contact.detection.contacts import FACE, follow
from nmm.contact.detection.narrow_phase import find_contacts
from nmm.contact.detection.neighbour_list import NeighbourList
from nmm.contact.mortar.segments import faced
from nmm.testing.detection.search import polygon_surface

RNG = np.random.default_rng(3)


def scene(*rings):
    return polygon_surface(Polygons.from_vertices([np.array(ring, dtype=float) for ring in rings]))


def contacts(surface, points=2, joints=None):
    found = find_contacts(surface, *NeighbourList(0.02).update(surface), 0.01)
    return faced(surface, found, points, joints)


def places(surface, found):
    return surface.at(found.vertex, found.parameter_a)


def rough(low, high, y, number, up):
    """A block of height 1 on or under y, its face cut into edges at random places."""
    x = np.sort(RNG.uniform(low, high, number))
    face = [(value, y) for value in [low, *x, high]]
    return (
        [*face, (high, y + 1), (low, y + 1)] if up else [*face[::-1], (low, y - 1), (high, y - 1)]
    )


@pytest.mark.parametrize("points", [2, 3, 4])
def test_lengths_integrate_polynomials_over_faces_with_any_edges(points):
    surface = scene(rough(-2, 0.6, 0, 7, False), rough(-0.5, 1.5, 0, 5, True))
    found = contacts(surface, points)
    x = places(surface, found)[:, 0]
    # Lobatto's rules are exact to degree 2 n - 3; the faces share [-0.5, 0.6].
    for degree in range(2 * points - 2):
        exact = (0.6 ** (degree + 1) - (-0.5) ** (degree + 1)) / (degree + 1)
        assert found.length @ x**degree == pytest.approx(exact, abs=1e-14)
    assert np.abs(found.gap).max() < 1e-15
    assert len(np.unique(np.round(x, 12))) == len(x)


def test_edges_shorter_than_what_the_search_tells_apart_keep_their_share():
    near = [(0, 0), (1, 0), (1, 1), (0.5, 1), (0, 1)]
    surface = scene(near, [(0, 1), (0.5 + 1e-5, 1), (1, 1), (1, 2), (0, 2)])
    found = contacts(surface)
    x = places(surface, found)[:, 0]
    assert np.sort(x) == pytest.approx([0, 0.5, 0.5 + 1e-5, 1], abs=1e-15)
    assert found.length @ x == pytest.approx(0.5, abs=1e-14)


def test_a_corner_in_a_corner_has_a_contact_with_each_face():
    room = [(0, 0), (0, -1), (3, -1), (3, 2), (2, 2), (2, 0)]
    found = contacts(scene(room, [(1, 0), (2, 0), (2, 1), (1, 1)]))
    corner = np.isclose(found.length, 0.5)
    assert corner.sum() == 4
    assert np.abs(found.normal[corner]).sum(axis=0) == pytest.approx([2, 2])


def test_a_block_that_leans_by_more_than_three_degrees_stands_on_its_corner():
    for tilt, length in ((0.04, 1.0), (0.06, 0.0)):
        c, s = np.cos(tilt), np.sin(tilt)
        block = np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) @ np.array([[c, s], [-s, c]])
        found = contacts(scene([(-1, -1), (2, -1), (2, 0), (-1, 0)], block))
        assert found.length.sum() == pytest.approx(length * c, rel=1e-2)
        assert (np.abs(found.gap) < 1e-12).sum() == 1


def test_joints_are_left_out():
    surface = scene([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 1), (1, 2), (0, 2)])
    found = contacts(surface)
    pair = np.unique(
        np.minimum(found.vertex, found.edge) * 8 + np.maximum(found.vertex, found.edge)
    )
    assert found.length.sum() == pytest.approx(1.0)
    assert contacts(surface, joints=pair).length.sum() == 0


def test_points_inside_faces_are_followed_from_step_to_step():
    low = [(-1, -1), (2, -1), (2, 0), (0.4, 0), (-1, 0)]
    first, second = (
        contacts(scene(low, [(x, 0), (x + 1, 0), (x + 1, 1), (x, 1)]), 3) for x in (0.0, 0.01)
    )
    found = follow(first, second)
    assert (found >= 0).all()
    assert (first.kind[found] == second.kind).all()
    assert (second.kind == FACE).sum() == 2


def test_whole_faces_count_beyond_the_reach_of_the_search():
    # The face leaves the search's reach of 0.01 after a third, and never turns by three degrees.
    tilt = 0.03
    edges = [(x, tilt * x) for x in np.linspace(0, 1, 9)]
    surface = scene([(-1, -1), (2, -1), (2, 0), (-1, 0)], [*edges, (1, 1), (0, 1)])
    found = find_contacts(surface, *NeighbourList(0.02).update(surface), 0.01)
    near, whole = (faced(surface, found, 2, whole=beyond) for beyond in (False, True))
    assert near.length.sum() < 0.6
    assert whole.length.sum() == pytest.approx(np.hypot(1, tilt), rel=2e-3)
    assert whole.gap.max() == pytest.approx(tilt, rel=1e-3)
