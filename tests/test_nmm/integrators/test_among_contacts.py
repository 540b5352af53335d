"""The rule that an integrator names for scenes with contact."""

import numpy as np
import pytest

from nmm.integrators.generalized_alpha import GeneralizedAlpha
from nmm.integrators.newmark import Newmark
from nmm.integrators.shi import Shi


def stepped(rule, frequency, step, place, speed, count):
    """Places and energies (count + 1,) of an oscillator of unit mass under a rule."""
    stiffness, rows = frequency**2, [(place, speed)]
    for _ in range(count):
        # (m + s k) d = -k u + p, without an acceleration to carry.
        push = rule.momentum(np.array([speed]), np.zeros(1), step)[0] - stiffness * place
        moved = push / (rule.mass_factor(step) + rule.end_weight * stiffness)
        speed = rule.rates(np.array([moved]), np.array([speed]), np.zeros(1), step)[0][0]
        place += moved
        rows.append((place, speed))
    places, speeds = np.array(rows).T
    return places, 0.5 * speeds**2 + 0.5 * stiffness * places**2


@pytest.mark.parametrize("radius", [0.0, 0.3, 0.8, 1.0])
def test_generalized_alpha_keeps_its_radius_at_infinity_among_contacts(radius):
    rule = GeneralizedAlpha(rho_inf=radius).among_contacts
    assert not rule.carries
    places, _ = stepped(rule, 1e6, 1.0, 1.0, 0.0, 1)
    assert places[1] == pytest.approx(-radius, abs=1e-9)


@pytest.mark.parametrize(
    "rule", [Shi(), Newmark(), Newmark(beta=0.3, gamma=0.6), Newmark(beta=0.35, gamma=0.55),
             GeneralizedAlpha(), GeneralizedAlpha(rho_inf=0.0)]
)  # fmt: skip
@pytest.mark.parametrize("frequency", [0.1, 3.0, 1e3])
def test_no_rule_among_contacts_raises_the_energy_of_an_oscillator(rule, frequency):
    _, energy = stepped(rule.among_contacts, frequency, 1.0, 1.0, 0.7, 50)
    # Rounding of the stiffness times the place.
    assert np.diff(energy).max() <= 1e-13 * energy[0] * max(frequency, 1.0)


def test_rules_that_carry_nothing_stay_and_damping_is_kept():
    assert Shi(kinetic_factor=0.9).among_contacts == Shi(kinetic_factor=0.9)
    assert GeneralizedAlpha(kinetic_factor=0.9).among_contacts.kinetic_factor == 0.9
