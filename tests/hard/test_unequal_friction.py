"""Bodies between two faces that rub differently: which slips, and at which load, by hand."""

import numpy as np
import pytest

from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text

METHODS = ["penalty", "augmented", "lagrange", "cone", "barrier"]
LENGTH, WIDTH, LEAN = 4.0, 0.1, np.radians(60)
FLOOR, WALL = 25.0, 10.0


def head(enforcement, more=""):
    return (
        f'plane = "stress"\n[contact]\n{more}[formulation.contact]\nenforcement = "{enforcement}"\n'
    )


def faces(kinds, pairs):
    """Materials, and interfaces of the last of them with the others by their angles."""
    *others, body = kinds
    between = [
        text.interface(f"on {one}", angle, (one, body))
        for one, angle in zip(others, pairs, strict=True)
    ]
    return [
        *map(text.material, kinds),
        *[one.replace("[interfaces.on ", "[interfaces.on_") for one in between],
    ]


@pytest.mark.parametrize("enforcement", METHODS)
@pytest.mark.parametrize("place", [pytest.param((0.0, 0.0), marks=pytest.mark.slow), (1e5, -3e5)])
def test_a_ladder_is_drawn_from_its_wall_at_the_load_at_which_both_its_ends_slide(
    enforcement, place
):
    """A bar on the edge of its foot and against a wall: moments about its foot give the wall's."""
    along, up = np.array([-np.cos(LEAN), np.sin(LEAN)]), np.array([np.sin(LEAN), np.cos(LEAN)])
    foot = np.array([LENGTH * np.cos(LEAN), 0.0])
    bar = foot + np.array([0 * up, WIDTH * up, WIDTH * up + LENGTH * along, LENGTH * along])
    tables = [
        *faces(("floor", "wall", "bar"), (FLOOR, WALL)),
        text.block("floor", "floor", text.rectangle((0.5, -1), (5, 0)) + place),
        text.block("wall", "wall", text.rectangle((-1, 0), (0, 5)) + place),
        *map(text.fixed_block, ("floor", "wall")),
        text.block("bar", "bar", bar + place),
        f'[[loads]]\nname = "pull"\nkind = "point"\npoint = {(foot + place).tolist()}\n'
        'block = "bar"\nforce = [1000, 0]\n',
    ]
    more = '[gravity]\n[loading]\nuntil = "failure"\nscaled = ["pull"]\n'
    found = run(parse_scene(text.scene(head(enforcement, more), tables)))
    weight, (floor, wall) = 2600 * text.G * LENGTH * WIDTH, np.tan(np.radians([FLOOR, WALL]))
    arm = np.cos(LEAN) / 2 - WIDTH * np.sin(LEAN) / (2 * LENGTH)
    push = weight * arm / (np.cos(LEAN) * wall + np.sin(LEAN))
    assert found.summary.status == "failure_load"
    # The load is bracketed to 1 %.
    right = floor * (weight - wall * push) - push
    assert found.summary.failure_load == pytest.approx(right, rel=5e-3)
    assert found.summary.failure_load < right


@pytest.mark.parametrize("enforcement", METHODS)
def test_a_plate_that_is_sheared_between_two_slips_on_the_smoother_one(enforcement):
    tables = [
        *faces(("rough", "smooth", "plate"), (30.0, 15.0)),
        text.box("low", (0, -1), (2, 1), "rough"),
        text.box("middle", (0, 0), (2, 0.4), "plate"),
        text.box("top", (0, 0.4), (2, 1), "smooth"),
        '[[supports]]\nname = "low"\nblock = "low"\nfix = ["x", "y"]\ndisplacement = [1e-4, 0]\n',
        '[[supports]]\nname = "top"\nblock = "top"\nfix = ["x"]\n',
        '[[loads]]\nname = "press"\nkind = "edge"\nsegment = [[0, 1.4], [2, 1.4]]\n'
        "traction = [0, -5e4]\n",
        "[formulation.loading]\nincrement = 0.05\n",
    ]
    found = run(parse_scene(text.scene(head(enforcement), tables)))
    drawn = abs(found.history["reaction:top:x"][-1])
    # Springs give by 1e-5 of the way on which they slide.
    assert drawn == pytest.approx(1e5 * np.tan(np.radians(15)), rel=1e-4)
