"""Increments of a stage in which nothing grows: all that is left of the forces is rounding."""

import numpy as np
import pytest

import nmm
from nmm.formulation import Formulation
from nmm.scene.read import parse_scene

SPAN, LOAD = 20.0, 1e3
BEAM = """
title = "A beam loses its middle support"
plane = "stress"
[materials.steel]
young_modulus = {modulus}
poisson_ratio = 0.0
[[blocks]]
name = "beam"
material = "steel"
vertices = [[0, 0], [40, 0], [40, 1], [0, 1]]
[[supports]]
name = "left"
point = [0, 0]
fix = ["x", "y"]
[[supports]]
name = "middle"
point = [20, 0]
fix = ["y"]
[[supports]]
name = "right"
point = [40, 0]
fix = ["y"]
[[loads]]
name = "q"
kind = "edge"
segment = [[0, 1], [40, 1]]
traction = [0, -1e3]
[[stages]]
name = "three"
[[stages]]
name = "two"
supports = ["left", "right"]
"""


@pytest.mark.parametrize("modulus", [2e8, 2e11, 2e14])
@pytest.mark.parametrize("increment", [0.1, 0.25])
def test_a_beam_that_lost_a_support_stays_at_rest_while_nothing_grows(modulus, increment):
    # The first increment of the second stage carries all; those after it have nothing to do. What
    # is out of balance in them is the rounding of soft motions times large stiffnesses.
    formulation = Formulation.model_validate(
        {
            "cover": {"type": "quads", "size": 0.5, "degree": 2},
            "loading": {"increment": increment},
        }
    )
    done = nmm.run(parse_scene(BEAM.format(modulus=modulus), "beam"), formulation)
    assert done.summary.status == "converged", done.summary.sentence
    second = len(done.history["time"]) // 2
    for side in ("left", "right"):  # statics: half of the load each
        force = done.history[f"reaction:{side}:y"][second:]
        assert force == pytest.approx(np.full(len(force), SPAN * LOAD), rel=1e-6)
