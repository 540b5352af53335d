"""Rules for integrands singular at a tip, against closed forms."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.special import beta, betaincc, hyp2f1

from integration.moments import moments
from integration.monomials import evaluate
from integration.polygons import Polygons
from integration.singular import apex_rule, tip_rule

SQUARE = Polygons.from_vertices([[(-1, -1), (1, -1), (1, 1), (-1, 1)]])
# With a vertex where a crack from the middle leaves it, across which integrands jump.
CRACKED = Polygons.from_vertices([[(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, 0)]])


def polar(points, tip=(0, 0)):
    x, y = (points - np.asarray(tip, dtype=float)).T
    return np.hypot(x, y), np.arctan2(y, x)


def total(rule, values):
    return float(rule.weights @ values)


def edge_integral(slope, power):
    """Integral of (1 + t^2)^(power / 2) from 0 to the slope."""
    if power == -1:
        return np.arcsinh(slope)
    if power == -1.5 and slope > 1:  # 2F1 loses figures there
        return 0.5 * beta(0.25, 0.5) * betaincc(0.25, 0.5, 1 / (1 + slope**2))
    return slope * hyp2f1(-power / 2, 0.5, 1.5, -(slope**2))


def corner(a, b, power):
    """Integral of r^power over [0, a] x [0, b]: two right triangles with legs (a, b), (b, a)."""
    legs = ((a, b), (b, a))
    return sum(
        p ** (power + 2) / (power + 2) * edge_integral(q / p, power) for p, q in legs if p and q
    )


def rectangle(x0, x1, y0, y1, power):
    """Integral of r^power over a rectangle anywhere, by the corner formula with signs."""

    def signed(x, y):
        return np.sign(x) * np.sign(y) * corner(abs(x), abs(y), power)

    return signed(x1, y1) - signed(x0, y1) - signed(x1, y0) + signed(x0, y0)


def test_inverse_radius_over_a_square_about_the_tip():
    rule = tip_rule(SQUARE, (0, 0), 0)
    found = total(rule, 1 / polar(rule.points)[0])
    assert found == pytest.approx(8 * np.arcsinh(1), rel=1e-13)


@pytest.mark.parametrize("power", [-1.5, -1, -0.5, 0, 0.5, 1.5])
@pytest.mark.parametrize(
    "tip",
    [
        (0, 0),  # inside
        (0.3, -0.7),
        (1, 0.2),  # on an edge
        (-1, -1),  # at a corner
        (3, 0.2),  # outside
        (2, 1),  # outside, on the line of an edge
        (1 + 1e-9, 0),  # outside, close to an edge
        (1 - 1e-9, 0.5),  # inside, close to an edge
        (1 - 1e-6, 1 - 1e-9),  # inside, close to a corner
    ],
)
def test_powers_of_the_radius_wherever_the_tip_is(tip, power):
    x, y = tip
    expected = rectangle(-1 - x, 1 - x, -1 - y, 1 - y, power)
    rule = tip_rule(SQUARE, tip, 2)
    found = total(rule, polar(rule.offsets)[0] ** power)
    # outside, the closed form and the fan both lose a figure to cancellation
    assert found == pytest.approx(expected, rel=5e-13)


def smooth(function, breaks):
    """Integral over an angle of a function that is smooth between the breaks."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    return sum(
        (b - a) / 2 * weights @ function((a + b) / 2 + (b - a) / 2 * nodes)
        for a, b in pairwise(breaks)
    )


def rim(angle):
    return 1 / np.maximum(np.abs(np.cos(angle)), np.abs(np.sin(angle)))


@pytest.mark.parametrize(
    ("power", "function"),
    [
        (-0.5, lambda t: np.cos(t / 2)),
        (-0.5, lambda t: np.sin(t / 2) * np.sin(t)),
        (-0.5, lambda t: np.cos(t / 2) * (1 - np.sin(t / 2) * np.sin(1.5 * t))),
        (-1, lambda t: np.sin(t / 2) ** 2),
        (-1, lambda t: (np.cos(t / 2) * (1 + np.sin(t / 2) * np.sin(1.5 * t))) ** 2),
        (0.5, lambda t: np.cos(t / 2) * np.sin(t) ** 2),
    ],
)
def test_crack_tip_fields_over_a_square(power, function):
    breaks = np.linspace(-np.pi, np.pi, 9)
    expected = smooth(lambda t: function(t) * rim(t) ** (power + 2) / (power + 2), breaks)
    rule = tip_rule(CRACKED, (0, 0), 1)
    r, t = polar(rule.points)
    assert total(rule, r**power * function(t)) == pytest.approx(expected, rel=2e-13)


def test_even_part_of_a_squared_field_has_a_closed_form():
    # sin^2(t/2)/r = (1 - cos t)/(2 r), and cos t/r is odd over the square
    rule = tip_rule(CRACKED, (0, 0), 0)
    r, t = polar(rule.points)
    assert total(rule, np.sin(t / 2) ** 2 / r) == pytest.approx(4 * np.arcsinh(1), rel=1e-13)


def test_a_jump_across_a_ray_needs_a_vertex_at_its_end():
    ring = [(-1, -1), (1, -1), (1, 2), (-1, 2)]

    def reach(t):
        c, s = np.cos(t), np.sin(t)
        return 1 / np.maximum(np.abs(c), np.where(s > 0, s / 2, -s))

    breaks = [-np.pi, -0.75 * np.pi, -0.25 * np.pi, 0, np.arctan2(2, 1), np.arctan2(2, -1), np.pi]
    expected = smooth(lambda t: np.sin(t / 2) * reach(t) ** 1.5 / 1.5, breaks)

    def integral(ring):
        rule = tip_rule(Polygons.from_vertices([ring]), (0, 0), 1)
        r, t = polar(rule.points)
        return total(rule, np.sin(t / 2) / np.sqrt(r))

    assert integral([*ring, (-1, 0)]) == pytest.approx(expected, rel=1e-13)
    assert abs(integral(ring) - expected) > 1e-4


def test_two_sides_of_a_crack_add_up_to_the_square():
    upper = Polygons.from_vertices([[(-1, 0), (0, 0), (1, 0), (1, 1), (-1, 1)]])
    lower = Polygons.from_vertices([[(-1, -1), (1, -1), (1, 0), (0, 0), (-1, 0)]])

    def field(rule):
        r, t = polar(rule.points)
        return total(rule, (np.sin(t / 2) + 0.5 * np.cos(t / 2)) / np.sqrt(r))

    parts = sum(field(tip_rule(side, (0, 0), 1)) for side in (upper, lower))
    whole = field(tip_rule(CRACKED, (0, 0), 1))
    assert parts == pytest.approx(whole, rel=1e-13)


@pytest.mark.parametrize("order", [0, 1, 2, 4, 8])
def test_polynomials_agree_with_exact_moments(assorted, order):
    for tip in ((1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (-1.0, 4.0)):
        rule = tip_rule(assorted, tip, order)
        scale = 4.0
        values = evaluate((rule.points - tip) / scale, order)
        found = rule.integrate(values, len(assorted))
        expected = moments(assorted, order, origin=tip, scale=scale)
        # areas up to 8, fans from outside about three times that
        np.testing.assert_allclose(found, expected, rtol=0, atol=5e-13)


def test_sense_of_rings_and_holes_do_not_matter(holed):
    tip = (2.0, 1.0)
    rings = [holed.points[:5][::-1], holed.points[5:][::-1]]
    for polygons in (holed, Polygons.from_rings([rings])):
        rule = tip_rule(polygons, tip, 1)
        found = total(rule, 1 / polar(rule.points, tip)[0])
        whole = tip_rule(Polygons.from_vertices([holed.points[:5]]), tip, 1)
        expected = total(whole, 1 / polar(whole.points, tip)[0]) - rectangle(
            -0.5, 0.5, -0.75, -0.25, -1
        )
        assert found == pytest.approx(expected, rel=1e-13)


def test_every_polygon_has_its_own_tip():
    polygons = Polygons.concatenate([SQUARE, SQUARE])
    tips = np.array([(0.0, 0.0), (1.0, 1.0)])
    rule = tip_rule(polygons, tips, 0)
    assert (np.diff(rule.owner) >= 0).all()
    radius = np.hypot(*(rule.points - tips[rule.owner]).T)
    found = rule.integrate(1 / radius, 2)
    np.testing.assert_allclose(found, [8 * np.arcsinh(1), 4 * np.arcsinh(1)], rtol=1e-13)


def test_points_are_inside_where_the_tip_sees_the_polygon():
    rule = tip_rule(SQUARE, (0.9, -0.9), 3)
    assert (np.abs(rule.points) < 1).all()
    assert (rule.weights > 0).all()


def test_clockwise_triangles_count_negative_and_flat_ones_not():
    apex = np.zeros((3, 2))
    start = np.array([(1.0, 0.0), (0.0, 1.0), (1.0, 1.0)])
    end = np.array([(0.0, 1.0), (1.0, 0.0), (2.0, 2.0)])
    rule = apex_rule(apex, start, end, 2)
    found = rule.integrate(1 / polar(rule.points)[0], 3)
    # distance of the edge 1/sqrt 2, seen from -45 to 45 degrees
    expected = np.sqrt(2) * np.arcsinh(1)
    np.testing.assert_allclose(found, [expected, -expected, 0.0], rtol=1e-13)


@pytest.mark.parametrize("height", [1e-1, 1e-3, 1e-6, 1e-9, 1e-12])
def test_needles_are_as_accurate_as_other_triangles(height):
    rule = apex_rule(np.zeros((1, 2)), np.array([[-1.0, -height]]), np.array([[2.0, -height]]), 0)
    # h (asinh(2/h) + asinh(1/h)) for the inverse radius
    expected = height * (np.arcsinh(2 / height) + np.arcsinh(1 / height))
    assert total(rule, 1 / polar(rule.points)[0]) == pytest.approx(expected, rel=1e-13)
    assert rule.weights.sum() == pytest.approx(1.5 * height, rel=1e-12)


def test_offsets_keep_their_figures_far_from_the_origin():
    # a whole shift moves the square without rounding; points near the tip are rounded to 1e-10
    far = SQUARE.with_points(SQUARE.points + 2.0**20)
    rule = tip_rule(far, (2.0**20, 2.0**20), 0)
    found = total(rule, 1 / polar(rule.offsets)[0])
    assert found == pytest.approx(8 * np.arcsinh(1), rel=1e-13)
    np.testing.assert_allclose(rule.points - 2.0**20, rule.offsets, rtol=0, atol=2e-10)


def test_nothing_to_integrate_gives_no_points():
    none = SQUARE.take([])
    assert len(tip_rule(none, np.zeros((0, 2)), 2).weights) == 0
    flat = Polygons.from_vertices([[(0, 0), (1, 1), (2, 2)]])
    assert len(tip_rule(flat, (5, 5), 2).weights) == 0
