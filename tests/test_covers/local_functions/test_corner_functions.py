"""Functions of the singular stress at corners of boundaries."""

import numpy as np
import pytest

from covers.local_functions.corner_functions import corner_functions

POISSON = 0.3


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
