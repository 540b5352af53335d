"""Time integrators: the suite of all, at every damping that they have."""

import pytest

from nmm.integrators.base import INTEGRATORS
from nmm.integrators.central_differences import CentralDifferences
from nmm.integrators.energy_momentum import EnergyMomentum
from nmm.integrators.generalized_alpha import GeneralizedAlpha
from nmm.integrators.newmark import Newmark
from nmm.integrators.shi import Shi
from nmm.testing import check_integrator
from nmm.testing.integrators import Oscillator

MADE = {
    "shi": [(Shi(), 1.0)],
    # gamma > 1/2 damps and costs an order.
    "newmark": [(Newmark(), 2.0), (Newmark(beta=0.3025, gamma=0.6), 1.0)],
    "central_differences": [(CentralDifferences(), 2.0)],
    "energy_momentum": [(EnergyMomentum(), 2.0)],
    "generalized_alpha": [(GeneralizedAlpha(rho_inf=rho), 2.0) for rho in (0.0, 0.5, 0.8, 1.0)],
}


def test_every_integrator_is_held_to_the_suite():
    assert set(MADE) == set(INTEGRATORS.names())


@pytest.mark.parametrize(
    ("rule", "order"), [one for made in MADE.values() for one in made], ids=str
)
def test_an_integrator_keeps_what_every_one_promises(rule, order):
    check_integrator(rule, order)
    assert rule.order == order


def test_newmark_keeps_the_energy_of_a_vibration():
    one = Oscillator(Newmark(), 4.0)
    state = one.run(one.begun(0.3, 0.7), 50.0, 500)
    energy = state[1] ** 2 / 2 + 2.0 * state[0] ** 2
    assert energy == pytest.approx(0.7**2 / 2 + 2.0 * 0.3**2, rel=1e-12)


def test_shi_damps_as_one_over_the_root_of_one_and_half_omega_squared():
    one, omega = Oscillator(Shi(), 1.0), 0.5
    first = one.begun(1.0, 0.0)
    places = [first[0]]
    for _ in range(4):
        first = one.after(first, omega)
        places.append(first[0])
    # u2 = a u1 + b u0 with b = - rho^2 (Shi 1988: rho = 0.94280904 at omega dt = 0.5)
    determinant = places[1] ** 2 - places[0] * places[2]
    b = (places[2] ** 2 - places[1] * places[3]) / -determinant
    assert abs(b) ** 0.5 == pytest.approx(0.94280904, abs=1e-7)
