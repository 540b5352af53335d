"""Interface laws: the suite of all."""

import pytest

from nmm.interfaces.base import INTERFACE_LAWS
from nmm.testing import check_interface_law

BOND = {"cohesion": 2e6, "tensile_strength": 1e6, "bonded": True, "fracture_energy": 100.0}


@pytest.mark.parametrize("name", INTERFACE_LAWS.names())
@pytest.mark.parametrize("residual", [None, 0.2])
def test_a_law_of_bonds_keeps_what_every_law_promises(name, residual):
    check_interface_law(
        INTERFACE_LAWS.make(name, friction_angle=0.6, residual_friction_angle=residual, **BOND)
    )


def test_a_law_of_joints_without_bonds_keeps_what_every_law_promises():
    check_interface_law(INTERFACE_LAWS.make("mohr_coulomb", friction_angle=0.6, cohesion=1e5))
