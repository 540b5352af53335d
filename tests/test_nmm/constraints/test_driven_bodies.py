"""Bodies that supports drive: what springs of supports carry beside ways far larger than theirs."""

import numpy as np
import pytest

import nmm
from nmm.scene.read import parse_scene

DRAGGED = """
plane = "stress"
[contact]
[gravity]
[loading]
[formulation.loading]
increment = 0.25
[materials.rock]
young_modulus = %s
poisson_ratio = 0.2
density = %s
[interfaces.joint]
friction_angle = "20 deg"
[[blocks]]
name = "ground"
material = "rock"
vertices = [[-1, -1], [3, -1], [3, 0], [-1, 0]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "ground"
block = "ground"
fix = ["x", "y"]
[[supports]]
name = "rope"
block = "block"
fix = ["x"]
displacement = [%s, 0]
"""


def reactions(scene, modulus, density, way):
    """Return the last reactions along x over the friction of the block, of rope and ground."""
    run = nmm.run(parse_scene(scene % (modulus, density, way)))
    assert run.summary.status == "converged"
    friction = np.tan(np.radians(20)) * density * 9.81
    return [run.history[f"reaction:{name}:x"][-1] / friction for name in ("rope", "ground")]


# The rounding of half a metre times the springs of 10 GPa is 1e-3 N, of which friction at 1 g/m3 is
# three. The rest is the tilt of the contacts, alike at all densities.
@pytest.mark.parametrize("density", [1e2, 1.0, 1e-2, 1e-3])
@pytest.mark.parametrize("modulus", [1e7, 1e10])
@pytest.mark.parametrize("way", [0.5, -0.3])
def test_a_light_block_is_dragged_by_its_friction(density, modulus, way):
    rope, ground = reactions(DRAGGED, modulus, density, way)
    assert rope == pytest.approx(np.sign(way), rel=1e-4)
    # Nothing else acts along x: both differ by what the audit of balance allows at most.
    assert rope + ground == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("density", [1e-2, 1e-3])
def test_a_light_block_that_is_driven_at_once_and_brought_to_rest_is_in_balance(density):
    """Without ``[loading]`` the way is no load that grows: a relaxation takes the block there."""
    rope, ground = reactions(DRAGGED.replace("[loading]\n", "", 1), 1e10, density, 0.5)
    assert 0 < rope < 1 + 1e-4
    assert rope + ground == pytest.approx(0.0, abs=1e-6)
