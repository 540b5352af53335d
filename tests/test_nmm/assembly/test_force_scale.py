"""Forces on unknowns of all kinds compare by the stiffness that each has, or would have."""

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.posed import pose
from nmm.verification import text

MODULUS = 3e9


def scale(functions, degree, corner=(0.0, 0.0)):
    """Of a square of 1 m, without Poisson's ratio, in unknowns of its cover."""
    tables = [
        text.material("rock", modulus=MODULUS, poisson=0.0),
        text.block("square", "rock", text.rectangle(corner, np.add(corner, 1.0))),
    ]
    cover = f'[cover]\ntype = "block"\nfunctions = "{functions}"\ndegree = {degree}\n'
    posed = pose(parse_scene(text.scene('plane = "stress"\n', tables)), parse_formulation(cover))
    return posed.discretisation.model.force_scale


@pytest.mark.parametrize("corner", [(0.0, 0.0), (1e4 / 3, -1e5 / 7)])
def test_a_square_is_as_fast_against_motion_as_it_is_against_strain(corner):
    """K / M is 12 E / a^2 for all three strains: E a^2 over a^4 / 12, E a^2 / 2 over a^4 / 24."""
    stiffness = np.array([12.0, 12.0, 2.0, 1.0, 1.0, 0.5]) * MODULUS
    # The rounding of coordinates, and of the mean of three logarithms.
    assert scale("rigid_strain", 1, corner) == pytest.approx(1 / np.sqrt(stiffness), rel=1e-7)


def test_unknowns_of_higher_degree_have_a_scale_each():
    """None is left out, and none is that of rounding: they are within the powers of the size."""
    found = scale("monomials", 3)
    assert np.isfinite(found).all()
    assert 0 < found.max() < 1e3 * found.min()


def test_a_rigid_square_counts_as_one_that_can_be_strained():
    """12 E / a^2 times M, of its translations and its rotation."""
    assert scale("rigid", 1) == pytest.approx(
        1 / np.sqrt([12 * MODULUS, 12 * MODULUS, 2 * MODULUS])
    )
