"""What anchors can carry."""

from dataclasses import replace

import numpy as np
import pytest

import nmm
from nmm.effects.base import Instant
from nmm.formulation import Formulation
from nmm.stepping.prepare import prepare
from nmm.stepping.step.anchors import ANCHOR
from nmm.stepping.step.unopposed import too_weak

STACK = """
plane = "stress"
thickness = 0.5
[materials.rock]
young_modulus = 2e9
poisson_ratio = 0.2
[interfaces.rock]
friction_angle = "30 deg"
[[blocks]]
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[blocks]]
material = "rock"
vertices = [[0, 1], [2, 1], [2, 3], [0, 3]]
[[supports]]
name = "foot"
segment = [[0, 0], [2, 0]]
fix = ["x", "y"]
[[loads]]
name = "top"
kind = "edge"
segment = [[0, 3], [2, 3]]
traction = [0, -1e4]
[contact]
"""


@pytest.mark.parametrize(("share", "weak"), [(0.99, False), (1.01, True)])
def test_anchors_carry_a_push_up_to_their_stiffness_times_the_size_of_the_domain(share, weak):
    made = prepare(nmm.parse_scene(STACK), Formulation())
    stepper = made.stepper
    assert stepper.attempt(made.start, Instant(1.0, 1.0), None).converged
    # by hand: 1e-8 of 2e9 Pa in a plate of 0.5 m, over the diagonal of 2 by 3 m
    carried = ANCHOR * 2e9 * 0.5 * np.hypot(2.0, 3.0)
    model, solver = stepper.model, stepper.plan.contact.solver
    problem, answer = solver.last
    upper = np.flatnonzero(model.manifold.unknown_body == 1)
    way = np.zeros(len(problem.force))
    way[upper[0]] = 1.0
    assert (model.manifold.rigid_modes.T @ way).reshape(-1, 3)[1].tolist() == [1.0, 0.0, 0.0]
    solver.last = replace(problem, force=problem.force + share * carried * way), answer
    assert too_weak(stepper) == weak
