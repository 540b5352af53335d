"""Rows half way: one compiled pass is what sparse sums and products say."""

import numpy as np
import pytest

import nmm
from nmm.assembly.motion import middle
from nmm.contact.points.midpoint import body_projection, midpoint_rows
from nmm.frozen import with_parts

TEXT = """
plane = "strain"
duration = "0.02 s"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = "2600 kg/m^3"
[interfaces.joint]
friction_angle = "20 deg"
[[blocks]]
name = "slope"
material = "rock"
vertices = [[0, 0], [5.196, 0], [5.196, 3]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[3.031, 1.75], [3.897, 2.25], [3.397, 3.116], [2.531, 2.616]]
[[supports]]
name = "ground"
block = "slope"
fix = ["x", "y"]
[gravity]
[inertia]
[contact]
[formulation]
integrator = { step = "5 ms" }
"""


@pytest.mark.parametrize("seed", [1, 2])
def test_one_pass_is_what_sparse_sums_and_products_say(seed):
    run = nmm.run(nmm.parse_scene(TEXT))
    contact, model, state = run.stepper.plan.contact, run.stepper.model, run.state
    sides, points = contact.partners.sides, contact.record.known
    draws = np.random.default_rng(seed)
    frames = with_parts(state.frames, angle=state.frames.angle + 0.1 * draws.normal(size=2))
    bent = state.deformation + 1e-3 * draws.normal(size=len(state.deformation))
    half = middle(state, with_parts(state, frames=frames, deformation=bent))
    given = points, sides, model, state, half
    plain, quick = midpoint_rows(*given), midpoint_rows(*given, body_projection(sides, model))
    assert len(points) > 1
    for name in ("normal", "tangent"):
        one, other = getattr(plain, name).toarray(), getattr(quick, name).toarray()
        # both add the same dozen numbers of about one, in another order
        np.testing.assert_allclose(other, one, rtol=0, atol=1e-13 * np.abs(one).max())
