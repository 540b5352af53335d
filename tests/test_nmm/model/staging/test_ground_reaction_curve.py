"""The wall of a tunnel in ground that flows comes in along the ground reaction curve."""

from itertools import pairwise

import numpy as np
import pytest

import nmm
from nmm.verification import text
from nmm.verification.problems.matter.tunnel import RIM, SIDES, quarter

PRESSURE, SHEAR, POISSON, COHESION = 30.0, 2800.0, 0.45, 3.45


def closed_form(inside):
    """Way of the wall under a pressure inside, without dilation, friction of 30 deg (Salencon).

    With this Poisson ratio the stress along the tunnel stays between the others.
    """
    passive, flow = 3.0, 1.0
    strength = 2 * COHESION * np.sqrt(passive) / (passive - 1)
    if inside >= (2 * PRESSURE - strength * (passive - 1)) / (passive + 1):
        return (PRESSURE - inside) / (2 * SHEAR)
    ratio = 2 / (passive + 1) * (PRESSURE + strength) / (inside + strength)
    radius, slopes = ratio ** (1 / (passive - 1)), passive + flow
    outer = (1 - POISSON) * (passive**2 - 1) / slopes * radius ** (passive + flow)
    wall = (1 - POISSON) * (passive * flow + 1) / slopes - POISSON
    chi = (2 * POISSON - 1) * (PRESSURE + strength) + (outer + wall) * (inside + strength)
    return chi / (2 * SHEAR)


def scene():
    """A quarter in MPa, a = 1 m; the core leaves, and what it exerted is released in shares."""
    inner, modulus = quarter(1.0, SIDES), 2 * SHEAR * (1 + POISSON)
    elastic = f"young_modulus = {modulus!r}\npoisson_ratio = {POISSON}\n"
    edges = []
    for number, (start, end) in enumerate(pairwise(inner)):
        out = (start + end) / np.linalg.norm(start + end)
        rim = [tuple(RIM * start), tuple(RIM * end)]
        edges += [
            text.pulled_edge(f"rim {number}", rim, -PRESSURE * out),
            f'[[foundations]]\nname = "beyond {number}"\n'
            f"segment = {[list(map(float, one)) for one in rim]}\n"
            f"normal_stiffness = {2 * SHEAR / RIM!r}\n",
        ]
    stress = f"stress = [{-PRESSURE}, {-PRESSURE}, 0]\n"
    return text.scene(
        'title = "Ground reaction"\nplane = "strain"\n',
        [
            f'[materials.rock]\nlaw = "mohr_coulomb"\ncohesion = {COHESION}\n'
            f'friction_angle = "30 deg"\ndilation_angle = 0.0\n{elastic}',
            f"[materials.core]\n{elastic}",
            text.block("ring", "rock", np.concatenate([inner, RIM * inner[::-1]])),
            text.block("core", "core", np.concatenate([[[0.0, 0.0]], inner])),
            '[interfaces.glue]\nbetween = "any"\nfriction_angle = 0.5\nbonded = true\n',
            f'[[initial_stresses]]\nblock = "ring"\nacross = {-PRESSURE}\n{stress}',
            f'[[initial_stresses]]\nblock = "core"\n{stress}',
            text.fixed_edge("x", [(0, 0), (0, RIM)], "x"),
            text.fixed_edge("y", [(0, 0), (RIM, 0)], "y"),
            *edges,
            text.monitor("wall", (1.0, 0.0), "ring"),
            '[[stages]]\nname = "in place"\n',
            '[[stages]]\nname = "half"\nremove = ["core"]\nrelease = 0.5\n',
            '[[stages]]\nname = "on"\nrelease = 0.8\n',
            '[[stages]]\nname = "whole"\nrelease = 1.0\n',
        ],
    )


def test_the_wall_comes_in_by_the_closed_form_at_each_share_that_is_released():
    table = {
        "cover": {"type": "quads", "size": 0.25, "degree": 2},
        "loading": {"increment": 0.25},
    }
    run = nmm.run(nmm.parse_scene(scene()), nmm.Formulation.model_validate(table))
    assert run.summary.status == "converged", run.summary.sentence
    ends = np.flatnonzero(np.isclose(run.history["load_factor"], 1.0))
    inwards = -run.history["monitor:wall:ux"][ends]
    # Springs of the sides give by 2e-8 m; the core that leaves takes none of what they exert.
    assert inwards[0] < 1e-6
    expected = [closed_form((1 - share) * PRESSURE) for share in (0.5, 0.8, 1.0)]
    assert closed_form(0.0) == pytest.approx(10.10033741e-3, rel=1e-8)
    # Cells of a quarter of the radius and 32 sides.
    assert inwards[1:] == pytest.approx(expected, rel=3e-3)
