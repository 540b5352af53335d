"""Interface laws: the suite of all."""

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
