"""Blocks that touch and fall side by side: contact has forces of rounding alone to find."""

import numpy as np
import pytest

import nmm
from nmm.verification import text

FALLING = 'plane = "strain"\nduration = "4 ms"\n[inertia]\n[gravity]\n[contact]\n'
PILE = text.scene(
    FALLING,
    [
        text.material("rock", 1e9, 0.2, 2500.0),
        text.interface("any", 25.0),
        '[[tessellations]]\nname = "pile"\nmaterial = "rock"\nblocks = 12\nseed = 3\n'
        "region = [[0, 0], [2, 0], [2, 2], [0, 2]]",
    ],
)
# Faces that fall along each other: across them nothing moves but by the rounding of the fall.
WALL = text.scene(
    FALLING,
    [
        text.material("rock", 5e9, 0.2, 1800.0),
        text.interface("any", 35.0),
        *[
            text.box(f"{course}-{k}", (0.25 * (course % 2) + 0.5 * k, 0.25 * course), (0.5, 0.25))
            for course in range(4)
            for k in range(2)
        ],
    ],
)


@pytest.mark.parametrize("enforcement", ["penalty", "augmented", "lagrange", "cone"])
@pytest.mark.parametrize("blocks", [PILE, WALL], ids=["pile", "wall"])
def test_touching_blocks_in_free_fall_are_solved_and_fall_freely(blocks, enforcement):
    method = f'\n[formulation.contact]\nenforcement = "{enforcement}"\n'
    found = nmm.run(nmm.parse_scene(blocks + method, "blocks.toml"))
    assert found.summary.status == "converged", found.summary.sentence
    # Constant acceleration is exact in every step; rounding of places is 1e-16 m.
    fallen = found.frames[-1].displacement - [0.0, -9.81 * 0.004**2 / 2]
    assert np.abs(fallen).max() < 1e-14
