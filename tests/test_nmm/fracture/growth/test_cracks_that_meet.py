"""Cracks that run into each other head on: each ends, and what they cut off is free."""

import numpy as np
import pytest

import nmm
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.testing.cracked_plates import PULLED_APART, turned_net

# A strip of 2 by 2 with a notch from either side on one line, pulled upwards.
NOTCHES = """
title = "two notches"
plane = "strain"
[materials.plate]
young_modulus = 1e9
poisson_ratio = 0.3
[[blocks]]
name = "plate"
material = "plate"
vertices = [[0, -1], [2, -1], [2, 1], [0, 1]]
[[cracks]]
name = "left"
points = [[0, 0], [0.6, 0]]
[[cracks]]
name = "right"
points = [[2, ASIDE], [1.4, ASIDE]]
[[supports]]
name = "pin"
point = [2, -1]
fix = ["x", "y"]
[[supports]]
name = "roller"
point = [0, -1]
fix = ["y"]
[fracture]
criterion = "straight_ahead"
toughness = 1e6
increment = 0.15
control = "toughness"
"""
NOTCHES += PULLED_APART


@pytest.mark.parametrize("aside", ["0.0", "1e-9", "1e-4"])
def test_cracks_that_meet_head_on_part_the_plate(aside: str) -> None:
    """Each grows by 0.15 twice; the first of the last segments ends 0.05 before the other tip."""
    run = nmm.run(parse_scene(NOTCHES.replace("ASIDE", aside)), parse_formulation(turned_net(0.1)))
    assert "a piece came free" in run.summary.sentence
    assert len(run.summary.changes) == 3
    assert run.manifold.n_bodies == 2
    area = np.bincount(run.manifold.element_body, run.manifold.elements.areas)
    # Half of the plate each, but for what lies between both lines.
    assert area == pytest.approx([2.0, 2.0], abs=2 * float(aside) + 1e-9)
    assert len(run.stepper.model.cut.tips) == 0
