"""Edges of nearly incompressible matter under Nitsche, whatever rounding makes of pressures."""

import numpy as np
import pytest
from scipy.sparse import csr_array

import nmm
from nmm.constraints.nitsche.volume_lift import _of_patches
from nmm.scene.read import parse_scene

WIDE, HIGH = 6.278935036798811, 4.0956742505210215


def pushed_block(shift):
    """Return a block that weight pushes aside, held along its foot."""
    x, y = shift
    return parse_scene(f"""
plane = "strain"

[materials.rock]
density = 2000
young_modulus = 62957748.41406862
poisson_ratio = 0.45

[[blocks]]
name = "block"
material = "rock"
vertices = [[{x + WIDE}, {y}], [{x + WIDE}, {y + HIGH}], [{x}, {y + HIGH}], [{x}, {y}]]

[[supports]]
name = "held"
segment = [[{x}, {y}], [{x + WIDE}, {y}]]
fix = ["x", "y"]

[gravity]
acceleration = [5.81162680302718, 2.8835138427443785]

[formulation.cover]
type = "quads"
size = 3.0536623087895545
degree = 2
functions = "monomials"

[formulation.supports]
method = "nitsche"
""")


def test_the_answer_hangs_on_no_rounding_of_the_place() -> None:
    work = [
        nmm.run(pushed_block(shift)).history["external_work"][-1]
        for shift in ((0.0, 0.0), (1e4, 0.0), (0.3, -0.7), (-7e3, 1.3e4))
    ]
    assert work == pytest.approx([work[1]] * 4, rel=1e-7)


def test_the_stiffness_of_a_held_block_is_not_negative() -> None:
    stepper = nmm.run(pushed_block((0.0, 0.0))).stepper
    model, plan = stepper.model, stepper.plan
    state = stepper.discretisation.setup.start
    values = np.linalg.eigvalsh(plan.matrix(state, model.stiffness).toarray())
    assert values[0] > -1e-12 * values[-1]


def test_all_pressures_of_a_patch_are_lifted_with_any_of_them() -> None:
    """Two patches of two and three pressures, and one of a single pressure."""
    root = csr_array(
        np.array(
            [
                [1.0, 2.0, 0.0, 0.0, 0.0, 0.0],
                [0.0, 3.0, 0.0, 0.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0, 1.0, 0.0],
                [0.0, 0.0, 0.0, 2.0, 1.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, 3.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            ]
        )
    )
    assert _of_patches(root, np.array([1])).tolist() == [0, 1]
    assert _of_patches(root, np.array([5])).tolist() == [5]
    assert _of_patches(root, np.array([1, 2])).tolist() == [0, 1, 2, 3, 4]
