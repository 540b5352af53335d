"""Friction of steps of statics that are corrected in the moved place: what slid slides on."""

import math
from functools import cache

import numpy as np
import pytest

import nmm
from nmm.contact.detection.surface import Surface
from nmm.contact.points.contact_points import PARTS, ContactPoints
from nmm.contact.points.continued.sliding_on import slid_since
from nmm.scene import parse_scene
from nmm.verification import text

ANGLE, WEIGHT, WAY = 20.0, 1e3 * 9.81, 0.5
FRICTION = WEIGHT * math.tan(math.radians(ANGLE))
COVERS = {
    "block": 'type = "block"',
    "triangles": 'type = "triangles"\nsize = 1.0\ndegree = 1',
    "triangles of degree 2": 'type = "triangles"\nsize = 1.0\ndegree = 2',
    "quads": 'type = "quads"\nsize = 1.0\ndegree = 1',
    "quads of degree 2": 'type = "quads"\nsize = 1.0\ndegree = 2',
}


@cache
def dragged(
    cover: str, enforcement: str, increment: float, way: float, density: float = 1e3
) -> nmm.Run:
    """A block of 1 m2 on a held ground, dragged along by a support of all of it."""
    scene = text.scene(
        'plane = "stress"\n[gravity]\n[contact]\n',
        [
            text.material("rock", modulus=1e10, density=density),
            text.interface("joint", ANGLE),
            text.block("ground", "rock", text.rectangle((-1.3, -1), (2.4, 0))),
            text.block("dragged", "rock", text.rectangle((0, 0), (1, 1))),
            '[[supports]]\nname = "base"\nblock = "ground"\nfix = ["x", "y"]\n'
            '[[supports]]\nname = "rope"\nblock = "dragged"\nfix = ["x"]\n'
            f"displacement = [{way}, 0.0]\n[loading]\nuntil = 1.0\n"
            f"[formulation.cover]\n{COVERS[cover]}\n"
            f'[formulation.contact]\nenforcement = "{enforcement}"\n'
            f"[formulation.loading]\nincrement = {increment}\n",
        ],
    )
    run = nmm.run(parse_scene(scene))
    assert run.summary.status == "converged", run.summary.sentence
    return run


RUNS = [
    ("block", "penalty", 0.5, WAY),
    ("block", "cone", 0.25, WAY),
    ("triangles", "penalty", 0.25, -WAY),
    ("triangles", "cone", 0.5, WAY),
    ("triangles of degree 2", "penalty", 0.25, WAY),
    ("quads", "penalty", 0.1, WAY),
    ("quads", "cone", 0.25, -WAY),
    ("quads of degree 2", "cone", 0.5, WAY),
]
# First solutions on triangles find seven times the friction that lasts. In two increments a body is
# carried by a twelfth of the domain, which is no collapse.
ON_TRIANGLES = [("triangles", "penalty", increment, WAY) for increment in (0.25, 0.5)]
WORKS = [RUNS[0], RUNS[1], RUNS[6], *ON_TRIANGLES]


@pytest.mark.parametrize(("cover", "enforcement", "increment", "way"), RUNS)
def test_a_dragged_block_rubs_by_its_weight_whatever_it_is_made_of(
    cover: str, enforcement: str, increment: float, way: float
) -> None:
    run = dragged(cover, enforcement, increment, way)
    # Rounding of a place of 1 m, 1e-16, times springs of 1e13 N/m of its supports is 1e-3 N.
    expected = math.copysign(FRICTION, way)
    np.testing.assert_allclose(run.history["reaction:rope:x"][1:], expected, rtol=2e-6)


@pytest.mark.parametrize(("cover", "enforcement", "increment", "way"), WORKS)
def test_friction_takes_its_force_times_the_way(
    cover: str, enforcement: str, increment: float, way: float
) -> None:
    run = dragged(cover, enforcement, increment, way)
    # It grows from nothing in the first increment: half of that counts. Points on
    # triangles are divided as the block moves, and know where a step begins their limits to 1e-3.
    work, share = (1 - increment / 2) * FRICTION * WAY, 1e-3 if cover == "triangles" else 1e-5
    assert run.history["friction_loss"][-1] == pytest.approx(work, rel=share)


# The corner of the block is a vertex of the mesh below it, which it leaves behind at once: by 0.1 m
# and more in the first increment, twice as deep as half a metre of the block lets corners in.
OVER_VERTICES = [
    ("quads", 0.25, WAY, 1e3),
    ("quads", 0.5, -WAY, 1.0),
    ("quads of degree 2", 0.5, WAY, 1e3),
    ("triangles of degree 2", 0.2, WAY, 1e3),
]


@pytest.mark.parametrize(("cover", "increment", "way", "density"), OVER_VERTICES)
def test_a_block_dragged_far_in_one_increment_is_not_loose(
    cover: str, increment: float, way: float, density: float
) -> None:
    run = dragged(cover, "penalty", increment, way, density)
    assert "brought to rest" not in run.summary.sentence
    assert len(run.history["time"]) == round(1 / increment)  # none was cut
    work = (1 - increment / 2) * FRICTION * density / 1e3 * WAY
    # 1e-3 J is stored in a block of 1 t/m3, 1e-6 of it, and less in a lighter one.
    for name in ("friction_loss", "external_work"):
        assert run.history[name][-1] == pytest.approx(work, rel=1e-5), name
    assert abs(run.summary.energy_balance) < 1e-6


def test_a_point_without_force_has_slid_as_far_as_its_sides_have_moved() -> None:
    """Edge 0 lies on edge 1 and is moved by 0.3 m to the right and 0.1 m up."""
    start, end = np.array([[0.0, 0.0], [2.0, 0.0]]), np.array([[1.0, 0.0], [-1.0, 0.0]])
    moved = np.array([[0.3, 0.1], [0.0, 0.0]])
    own, numbers = np.array([0, 1]), np.arange(2)
    began = Surface(start, end, numbers, own, own)
    now = Surface(start + moved, end + moved, numbers, own, own)
    given = {name: np.zeros(2) for name in PARTS} | {
        "edge_a": np.zeros(2, dtype=int),
        "parameter_a": np.array([0.0, 0.5]),
        "edge_b": np.ones(2, dtype=int),
        "parameter_b": np.array([0.5, 0.3]),
        "normal": np.array([[0.0, 1.0], [0.0, 1.0]]),
        "normal_force": np.array([0.0, -5.0]),
        "slid": np.array([0.0, 0.07]),
    }
    found = slid_since(ContactPoints(**given, history={}), began, now).slid
    # Slip is along the normal turned clockwise: to the right. The loaded point keeps what it has.
    np.testing.assert_allclose(found, [0.3, 0.07], rtol=1e-14)
