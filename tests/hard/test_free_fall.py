"""Blocks that touch and fall side by side: contact has forces of rounding alone to find."""

import numpy as np
import pytest

import nmm
from nmm.verification import text

PILE = text.scene(
    'plane = "strain"\nduration = "4 ms"\n[inertia]\n[gravity]\n[contact]\n',
    [
        text.material("rock", 1e9, 0.2, 2500.0),
        text.interface("any", 25.0),
        '[[tessellations]]\nname = "pile"\nmaterial = "rock"\nblocks = 12\nseed = 3\n'
        "region = [[0, 0], [2, 0], [2, 2], [0, 2]]",
    ],
)


@pytest.mark.parametrize("enforcement", ["penalty", "augmented", "lagrange", "cone"])
def test_touching_blocks_in_free_fall_are_solved_and_fall_freely(enforcement):
    method = f'\n[formulation.contact]\nenforcement = "{enforcement}"\n'
    found = nmm.run(nmm.parse_scene(PILE + method, "pile.toml"))
    assert found.summary.status == "converged", found.summary.sentence
    # Constant acceleration is exact in every step; rounding of places is 1e-16 m.
    fallen = found.frames[-1].displacement - [0.0, -9.81 * 0.004**2 / 2]
    assert np.abs(fallen).max() < 1e-14
