"""Failure loads of small structures, whatever the increment, the order of blocks and the units."""

from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.contact.bonds.release import given_way
from nmm.contact.solution import driver
from nmm.verification import text

EXAMPLES = Path(__file__).parents[4] / "examples"
TOLERANCE = 1e-3


def block(name, points, unit):
    ring = [[x * unit, y * unit] for x, y in points]
    return f'[[blocks]]\nname = "{name}"\nmaterial = "r"\nvertices = {ring}\n'


def load(point, force, unit, on, name="push"):
    place = [one * unit for one in point]
    return (
        f'[[loads]]\nname = "{name}"\nkind = "point"\npoint = {place}\nblock = "{on}"\n'
        f"force = [{force[0] * unit}, {force[1] * unit}]\n"
    )


def head(friction, modulus, more=""):
    return (
        'plane = "stress"\n[contact]\n[loading]\nuntil = "failure"\nscaled = ["push"]\n'
        f"[materials.r]\nyoung_modulus = {modulus!r}\npoisson_ratio = 0.0\n"
        f'[interfaces.any]\nbetween = "any"\nfriction_angle = "{friction} deg"\n{more}'
    )


HELD = '[[supports]]\nname = "held"\nblock = "base"\nfix = ["x", "y"]\n'
BASE = [(-3, -1), (4, -1), (4, 0), (-3, 0)]


def slides(unit):
    """A block of 1 N pushed at its foot: 1 N times tan 30 degrees."""
    blocks = [block("base", BASE, unit), block("b", [(0, 0), (1, 0), (1, 1), (0, 1)], unit)]
    weight = load((0.5, 1), (0, -1), unit, "b", "weight")
    text = head(30, 1e5) + HELD + weight + load((1, 0.01), (-1, 0), unit, "b")
    # The push acts 1 % above the foot and lifts nothing.
    return text, blocks, float(np.tan(np.pi / 6))


def topples(unit):
    """A column of 1 N, 1 m wide, pushed at 4 m: 1 N x 0.5 m / 4 m."""
    blocks = [block("base", BASE, unit), block("b", [(0, 0), (1, 0), (1, 4), (0, 4)], unit)]
    weight = load((0.5, 4), (0, -1), unit, "b", "weight")
    # Springs of 10 E t: the foot of stiffness 1e8 tilts by 1e-8, and the top sways as little.
    return head(45, 1e7) + HELD + weight + load((1, 4), (-1, 0), unit, "b"), blocks, 0.125


def breaks(unit):
    """Two blocks bonded over 1 m2 of 2 Pa, pulled in the middle."""
    blocks = [
        block("base", [(0, 0), (1, 0), (1, 1), (0, 1)], unit),
        block("b", [(1, 0), (2, 0), (2, 1), (1, 1)], unit),
    ]
    more = "tensile_strength = 2.0\ncohesion = 9.0\nbonded = true\n"
    return head(30, 1e7, more) + HELD + load((2, 0.5), (1, 0), unit, "b"), blocks, 2.0


def wedge(unit):
    """Crawford and Bray 1983 (benchmark B29) with a friction of 45 degrees: 0.475689 H0."""
    foot, top = 0.5773502691896257, 0.05773502691896256
    right = [(1.0, 0.9), (top, 0.9), (foot, 0.0), (1.0, 0.0)]
    blocks = [
        block("wedge", [(-foot, 0.0), (foot, 0.0), (top, 0.9), (-top, 0.9)], unit),
        block("right", right, unit),
        block("left", [(-x, y) for x, y in right[::-1]], unit),
    ]
    more = f"normal_stiffness = {2.5e9 / unit!r}\nshear_stiffness = {1e9 / unit!r}\n"
    way = 5.2923774675715694e-05 * unit
    for side, sign in (("right", -1), ("left", 1)):
        blocks.append(
            f'[[supports]]\nname = "hold {side}"\nblock = "{side}"\nfix = ["x", "y"]\n'
            f"displacement = [{sign * way!r}, 0]\nhistory = [[0, 0], [0.1, 1]]\n"
        )
    push = load((0, 0), (0, -1e5), unit, "wedge")
    return head(45, 1e14, more) + push, blocks, 0.475689


STRUCTURES = [slides, topples, breaks, wedge]


@pytest.mark.parametrize(
    ("share", "backwards", "unit"),
    [(1.7, False, 1.0), (1.7, True, 1e-3), (0.21, True, 1e-3), (0.042, False, 1.0)],
)
@pytest.mark.parametrize("structure", STRUCTURES)
def test_a_failure_load_is_the_same_with_any_increment(structure, share, backwards, unit):
    text, blocks, right = structure(unit)
    text += "".join(blocks[::-1] if backwards else blocks)
    steps = {"increment": share * right, "tolerance": TOLERANCE}
    found = nmm.run(nmm.parse_scene(text), nmm.Formulation.model_validate({"loading": steps}))
    summary = found.summary
    assert summary.status == "failure_load", summary.sentence
    assert summary.failure_tolerance <= TOLERANCE * (1 + 1e-9)
    # Springs give, and move arms and angles by some 1e-5.
    assert summary.failure_factor <= right * (1 + 1e-4)
    assert summary.failure_factor >= right * (1 - TOLERANCE - 1e-4)


def test_a_load_that_contacts_carry_at_any_factor_has_no_bound_to_tell():
    pressed = text.scene(
        'plane = "strain"\n[contact]\n[gravity]\n[loading]\nuntil = "failure"\n'
        "maximum_factor = 2\n",
        [
            text.material("rock", modulus=1e9, density=2500.0),
            text.interface("any", 30.0),
            text.box("base", (-1, -1), (3, 1)),
            text.box("top", (0, 0), (1, 1)),
            text.fixed_block("base"),
            '[[loads]]\nname = "press"\nkind = "edge"\nsegment = [[0, 1], [1, 1]]\n'
            "traction = [0, -1e4]\n",
        ],
    )
    done = nmm.run(nmm.parse_scene(pressed, "pressed"))
    assert done.summary.failure_bound is None
    assert "inf" not in str(done.summary)


def test_bonds_that_break_one_after_the_other_break_once(monkeypatch):
    """Each that gives way moves the rest further, so that contacts are sought anew nine times."""
    broken = []

    def noted(laws, contacts, gone, *given):
        broken.append(tuple(contacts.key[gone[1]]))
        return given_way(laws, contacts, gone, *given)

    # Of steps: the path beyond the largest load breaks bonds by itself.
    monkeypatch.setattr(driver, "given_way", noted)
    beam = nmm.read_scene(EXAMPLES / "kitoh_beam" / "kitoh_130.toml")
    given = beam.model_dump(exclude_unset=True)
    given["tessellations"][0]["blocks"] = 30
    done = nmm.run(type(beam).model_validate(given))
    assert done.summary.status == "failure_load", done.summary.sentence
    assert len(broken) > 5
    assert len(broken) == len(set(broken))
