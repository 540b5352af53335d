"""Corners of boundaries and kinks, and the functions of their singular stresses."""

import numpy as np
import pytest

from covers.local_functions.corner_functions import corner_functions
from nmm.formulation import CoverTable
from nmm.fracture.corners import kinks
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.verification.continuum import polygon

POISSON = 0.3
NET = CoverTable.model_validate({"type": "triangles", "size": 0.2, "degree": 1, "angle": 0.2})


def stress(functions, angle):
    """Stress (m, n, 2, 2) of functions at a radius of one in plane strain, shear modulus 1."""
    angle = np.asarray(angle, dtype=float)
    gradient = functions.evaluate(np.ones(len(angle)), angle)[1]
    strain = (gradient + np.swapaxes(gradient, 2, 3)) / 2
    spread = np.einsum("mnii->mn", strain)[..., None, None] * np.eye(2)
    return 2 * (strain + POISSON / (1 - 2 * POISSON) * spread)


@pytest.mark.parametrize("degrees", [210.0, 230.0, 253.4, 270.0])
def test_both_modes_of_a_corner_leave_its_faces_free(degrees):
    half = np.radians(degrees) / 2
    functions = corner_functions(2 * half, 3 - 4 * POISSON, 1.0, both=True)
    assert functions.number == 2
    normal = np.array([[-np.sin(a), np.cos(a)] for a in (-half, half)])
    pulled = np.einsum("mnij,mj->mni", stress(functions, [-half, half]), normal)
    assert np.abs(pulled).max() < 1e-9


def test_near_a_rotation_the_second_mode_is_told_from_it():
    # At 257.45 degrees its exponent is one; polynomials hold a rotation already.
    functions = corner_functions(np.radians(257.4), 1.8, 1.0, both=True)
    assert functions.exponent[1] == pytest.approx(1.02)


def test_a_kink_has_a_corner_on_its_outer_side():
    ring = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    turn = np.radians([10.0, 80.0])
    ways = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    start, kink = np.array([-1.2, -0.2]), np.array([0.05, 0.02])
    line = np.array([start, kink - 0.3 * ways[0], kink, kink + 0.4 * ways[1]])
    model = solid(polygon(ring), NET, [Elastic(1.0, POISSON)], "strain", cracks=[line])
    (corner,) = kinks(model.cut.boundary, line)  # the first vertex hardly turns
    assert corner.point == pytest.approx(kink)
    assert np.degrees(corner.angle) == pytest.approx(250.0)
    # Half way between straight back along the first piece and straight ahead along the second.
    outward = np.radians(80.0 - 125.0)
    assert corner.direction == pytest.approx([np.cos(outward), np.sin(outward)])
