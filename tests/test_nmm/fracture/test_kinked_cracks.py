"""Intensities at tips of cracks that are kinked, curved or near to others."""

import numpy as np
import pytest

from integration.arrays import Bools, Floats
from nmm.assembly.model import Model
from nmm.assembly.places import on_edges
from nmm.formulation import CoverTable
from nmm.fracture.stress_intensity import stress_intensity
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.verification.continuum import Problem, load, middles, pin, polygon

LAW = Elastic(1.0, 0.3)
KAPPA = LAW.kolosov("strain")


def intensities(model: Model, edges: Bools, pins: list[Floats], radius: float) -> Floats:
    """K_I and K_II (n, 2) under unit tension normal to edges, held at two points."""
    place = on_edges(model.manifold, edges & (model.cut.boundary.crack < 0), 10)
    holds = [pin(model, pins[0]), pin(model, pins[1], (False, True))]
    found = Problem(model, holds, [load(model, place, lambda p, n: n)]).solve()
    about = [
        stress_intensity(model, found.state.deformation, tip, radius, kappa=KAPPA)
        for tip in range(len(model.cut.tips))
    ]
    return np.array([(one.opening, one.sliding) for one in about])


def plate(cracks: list[Floats], size: float, angle: float, radius: float) -> Floats:
    """Intensities in a square of 2 x 2 pulled upwards, of unit tension."""
    ring = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    cover = CoverTable.model_validate(
        {"type": "triangles", "size": size, "degree": 1, "angle": angle, "shift": (0.13, 0.27)}
    )
    model = solid(polygon(ring), cover, [LAW], "strain", cracks=cracks)
    ends = np.abs(np.abs(middles(model)[:, 1]) - 1) < 1e-9
    return intensities(model, ends, [ring[0], ring[1]], radius)


def test_a_circular_arc_crack_has_its_closed_form() -> None:
    # Tension from all sides at infinity (Muskhelishvili; Cotterell and Rice 1980). The plate is 14
    # times as wide as the crack, which makes 0.5 % of K_I and 1 % of K_II; an eighth of a degree
    # of the last chord from the tangent makes 0.2 %.
    half, wide = np.pi / 4, 10.0
    t = np.linspace(-half, half, 361) + np.pi / 2
    crack = np.stack([np.cos(t), np.sin(t) - 1], axis=1)
    ring = wide * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    tips = [crack[0].tolist(), crack[-1].tolist()]
    options = {"focus": tips, "radius": 0.2, "growth": 0.3}
    cover = CoverTable.model_validate(
        {"type": "graded", "size": 0.1, "degree": 1, "angle": 0.2, "options": options}
    )
    model = solid(polygon(ring), cover, [LAW], "strain", cracks=[crack])
    found = intensities(model, np.ones(len(model.cut.boundary), bool), [ring[0], ring[1]], 0.3)
    unit = np.sqrt(np.pi * np.sin(half)) / (1 + np.sin(half / 2) ** 2)
    opening, sliding = unit * np.cos(half / 2), unit * np.sin(half / 2)
    assert found[:, 0] == pytest.approx([opening, opening], rel=0.01)
    assert np.abs(found[:, 1]) == pytest.approx([sliding, sliding], rel=0.02)


@pytest.mark.parametrize(
    "away", [0.05, *(pytest.param(far, marks=pytest.mark.slow) for far in (0.025, 0.1))]
)
def test_a_kink_near_the_tip_does_no_harm(away: float) -> None:
    """Half a cell to two cells behind it: as with cells of half the size, turned otherwise."""
    kink = np.array([0.3, 0.0])
    crack = np.array([[-1.1, 0.0], kink, kink + away * np.array([np.cos(0.6), np.sin(0.6)])])
    coarse, fine = (plate([crack], *net, 0.1)[0] for net in ((0.1, 0.2), (0.05, 0.7)))
    size = np.hypot(*fine)
    # Measured 1.3 % at most; functions of a straight crack were 2 to 40 % off.
    assert np.hypot(*(coarse - fine)) < 0.015 * size


@pytest.mark.parametrize("away", [0.05, pytest.param(0.025, marks=pytest.mark.slow)])
def test_a_sharp_kink_carries_the_functions_of_its_corner(away: float) -> None:
    """Kinks of 70 degrees, half a cell and less behind the tip: without, 1.9 and 3.4 % off."""
    kink = np.array([0.0, 0.0])
    crack = np.array([[-1.1, 0.0], kink, kink + away * np.array([np.cos(1.22), np.sin(1.22)])])
    coarse, fine = (plate([crack], *net, 0.1)[0] for net in ((0.1, 0.2), (0.05, 0.7)))
    assert np.hypot(*(coarse - fine)) < 0.01 * np.hypot(*fine)


def test_a_straight_crack_drawn_in_short_pieces_is_one() -> None:
    x = np.linspace(-0.4, 0.4, 33)
    drawn, straight = np.stack([x, 0 * x], axis=1), np.array([[-0.4, 0.0], [0.4, 0.0]])
    one, other = (plate([crack], 0.1, 0.3, 0.15) for crack in (drawn, straight))
    # Elements with vertices on the crack have other points, of rules that are exact to 1e-5 each in
    # a domain of one cell and a half.
    assert one == pytest.approx(other, abs=3e-5 * np.abs(other).max())


def test_tips_in_the_same_covers_have_their_own_functions() -> None:
    # A cell apart on one line: alike by symmetry, and as with cells of half the size.
    left = np.array([[-1.1, 0.0], [-0.05, 0.0]])
    coarse, fine = (plate([left, -left], size, 0.3, 0.095) for size in (0.1, 0.05))
    size = float(np.hypot(*fine[0]))
    # Measured 0.2 and 1.6 %.
    assert np.abs(fine[0] - fine[1]).max() < 0.01 * size
    assert np.abs(coarse - fine).max() < 0.03 * size


@pytest.mark.parametrize("away", [1e-14, 1e-9, 1e-6])
def test_a_tip_may_lie_beside_a_node_of_the_net_as_on_it(away: float) -> None:
    node = np.array([0.24796917, 0.0854402])
    cracks = [np.array([[-1.1, -0.05], node + far * np.array([0.1, 0.0])]) for far in (0.0, away)]
    on, beside = (plate([crack], 0.1, 0.3, 0.2)[0] for crack in cracks)
    # Other covers touch the tip: measured 2e-3.
    assert beside == pytest.approx(on, abs=5e-3 * float(np.hypot(*on)))
