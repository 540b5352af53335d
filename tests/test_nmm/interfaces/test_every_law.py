"""Interface laws: the suite of all."""

import numpy as np
import pytest

from nmm.interfaces.mohr_coulomb import MohrCoulomb
from nmm.interfaces.softening import BilinearSoftening, ExponentialSoftening, LinearSoftening
from nmm.testing import check_interface_law

BOND = {"friction_angle": 0.6, "cohesion": 4e6, "tensile_strength": 3e6, "bonded": True}
LAWS = [
    MohrCoulomb(friction_angle=0.6),
    MohrCoulomb(friction_angle=0.6, cohesion=1e5),
    MohrCoulomb(**BOND, residual_friction_angle=0.4),
    MohrCoulomb(friction_angle=0.6, dilation_angle=0.1, dilation_slip=1e-5),
    LinearSoftening(**BOND, fracture_energy=100.0, residual_friction_angle=0.4),
    LinearSoftening(**BOND, fracture_energy=100.0, dilation_angle=0.1),
    ExponentialSoftening(**BOND, fracture_energy=100.0),
    BilinearSoftening(**BOND, fracture_energy=100.0, shear_fracture_energy=300.0),
]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_built_in_laws_keep_what_contact_expects(law):
    check_interface_law(law)


def test_bonds_fail_by_pull_over_tension_or_by_shear_over_cohesion_and_friction():
    law = MohrCoulomb(**BOND)
    # 3 MPa of pull; 4 MPa + 2 MPa tan 0.6 of shear under 2 MPa, either way; pull weakens shear.
    pull = np.array([3e6, 1.5e6, -2e6, -2e6, 1e6])
    shear = np.array([0.0, 0.0, 4e6 + 2e6 * np.tan(0.6), -(4e6 + 2e6 * np.tan(0.6)), 2e6])
    expected = [1.0, 0.5, 1.0, 1.0, 2e6 / (4e6 - 1e6 * np.tan(0.6))]
    assert law.overload(pull, shear) == pytest.approx(expected, rel=1e-12)
