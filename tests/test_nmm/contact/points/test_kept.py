"""Contact points that go on are the same objects, and what is made of them is made once."""

from dataclasses import replace

import numpy as np
import shapely

from integration.polygons import Polygons
from nmm.contact.detection.contacts import Contacts
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.continued.predecessors import Predecessors
from nmm.contact.points.continued.reference_gap import counted, counted_on
from nmm.contact.points.continued.tracking import continued, continues, remember, searched_points
from nmm.contact.points.kept import of_pairs
from nmm.testing.detection.search import polygon_surface


class Counting:
    def __init__(self) -> None:
        self.made = 0

    @of_pairs
    def value(self, some: ContactPoints) -> int:
        self.made += 1
        return self.made


def contacts(keys: list[int], gap: float = 0.0) -> Contacts:
    key = np.array(keys)
    m = len(key)
    normal = np.tile([0.0, 1.0], (m, 1))
    numbers = np.arange(m)
    return Contacts(
        *(key // 10, key % 10, np.full(m, 0.5), normal, gap - 0.1 * numbers),
        *(numbers, key, numbers, numbers),
    )


def points(found: Contacts) -> ContactPoints:
    m = len(found)
    history = {"bonded": np.zeros(m, dtype=bool), "plastic_slip": np.zeros(m)}
    surface = polygon_surface(Polygons.from_shapely([shapely.box(0, 0, 1, 1)]))
    return searched_points(found, np.zeros(m, dtype=int), history, surface)


def test_points_that_go_on_are_those_that_are_remembered_and_counted_anew() -> None:
    before, found = contacts([12, 34, 56]), contacts([12, 34, 56], gap=0.05)
    old = replace(points(before), slip=np.arange(3.0), reference=np.array([0.0, -0.02, -0.3]))
    assert continues(before, found)
    quick = counted_on(continued(old, found))
    same = np.arange(3)
    left = old.take(np.zeros(0, dtype=int))
    one, body = (lambda p: np.ones(len(p))), np.zeros(9, int)
    line = Predecessors(old, same, np.zeros(len(same), dtype=bool))
    long = counted(remember(points(found), line), line, one, body, left)
    for name in ("gap", "reference", "slip", "edge_a", "parameter_b", "normal", "state", "key"):
        np.testing.assert_array_equal(getattr(quick, name), getattr(long, name))
    assert quick.key is old.key


def test_other_pairs_do_not_go_on() -> None:
    assert not continues(None, contacts([12]))
    assert not continues(contacts([12]), contacts([13]))
    assert not continues(contacts([12]), contacts([12, 34]))


def test_a_value_of_pairs_is_made_once_while_gaps_move_and_anew_as_a_bond_breaks() -> None:
    kept = Counting()
    first = points(contacts([12, 34]))
    moved = replace(first, gap=first.gap + 1.0)
    assert [kept.value(one) for one in (first, moved, moved)] == [1, 1, 1]
    broken = replace(moved, history={**moved.history, "bonded": np.ones(2, dtype=bool)})
    assert kept.value(broken) == 2
    assert kept.value(points(contacts([12, 34]))) == 3


def test_a_method_of_pairs_is_made_once_by_each_object() -> None:
    first, other, some = Counting(), Counting(), points(contacts([12, 34]))
    assert [first.value(some), first.value(some), other.value(some)] == [1, 1, 1]
    assert first.value(points(contacts([12]))) == 2
