"""Common parts of elements whose sides lie on each other up to rounding."""

import numpy as np
import pytest
import shapely

from covers.change.common_parts import common_parts

# Two triangles of a net, side by side, and the parts of both beside a cut through them.
FOOT, TOP = (-0.10000000000000009, -0.25), (0.050000000000000044, 0.009807621135331568)
RIGHT, LEFT = (0.19999999999999996, -0.25), (-0.25, 0.009807621135331568)
ON_SIDE, ON_TOP = (0.0014950792185662587, -0.07420536607521516), (-1.976025632450945e-4, TOP[1])
ON_FOOT = (0.005036964634912, -0.25)
OLD = [[FOOT, RIGHT, TOP], [FOOT, TOP, LEFT]]
NEW = [[FOOT, ON_SIDE, ON_TOP, LEFT], [ON_SIDE, TOP, ON_TOP], [FOOT, ON_FOOT, ON_SIDE]]
NEW.append([ON_FOOT, RIGHT, TOP, ON_SIDE])


def test_parts_of_elements_that_share_a_side_add_up_to_each_element():
    """GEOS 3.14 returns the whole of the first new element for its part in the first old one."""
    old, new = (np.array([shapely.Polygon(ring) for ring in rings]) for rings in (OLD, NEW))
    parent, child = np.repeat(np.arange(2), 4), np.tile(np.arange(4), 2)
    area = shapely.area(common_parts(old, new, parent, child))
    # A grid of rounding moves vertices by 1e-15 beside sides of 0.1.
    within = {"rel": 1e-12, "abs": 1e-15}
    assert np.bincount(parent, area) == pytest.approx(shapely.area(old), **within)
    assert np.bincount(child, area) == pytest.approx(shapely.area(new), **within)
    assert area.reshape(2, 4)[[0, 0, 1, 1], [0, 1, 2, 3]] == pytest.approx(np.zeros(4), abs=1e-15)
