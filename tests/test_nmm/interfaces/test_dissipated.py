"""What softening bonds say they took in a step: areas under curves, whatever the step."""

import numpy as np
import pytest

from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.passage import Passage
from nmm.interfaces.softening import BilinearSoftening, ExponentialSoftening, LinearSoftening

NORMAL, SHEAR = 1e13, 4e12
LINEAR = LinearSoftening(
    friction_angle=0.6,
    cohesion=4e6,
    tensile_strength=3e6,
    bonded=True,
    fracture_energy=100.0,
    shear_fracture_energy=250.0,
    residual_friction_angle=0.4,
)
BILINEAR, EXPONENTIAL = BilinearSoftening(**vars(LINEAR)), ExponentialSoftening(**vars(LINEAR))
LAWS = pytest.mark.parametrize("law", [LINEAR, BILINEAR, EXPONENTIAL], ids=["linear", "bi", "exp"])
FINE = 20_000


def taken(law, *places):
    """Energy (J/m2) that one bond took from place to place (gap, slip), each a step."""
    history, spring, total = law.initial(np.ones(1, dtype=bool)), np.ones(1), 0.0
    springs, before = (NORMAL * spring, SHEAR * spring), (0.0, 0.0)
    start = law.update(history, 0 * spring, 0 * spring, springs)
    for place in places:
        end = law.update(start.history, place[0] * spring, place[1] * spring, springs)
        stretch = [
            at[1] - one.history["plastic_slip"] for at, one in ((before, start), (place, end))
        ]
        total += law.dissipated(
            Passage(
                history=(start.history, end.history),
                gap=(before[0] * spring, place[0] * spring),
                slip=(stretch[0], stretch[1]),
                pull=(start.traction[:, 0], end.traction[:, 0]),
                shear=(start.traction[:, 1], end.traction[:, 1]),
                stiffness=springs,
            )
        )[0]
        start, before = end, place
    return total


def along(law, *corners):
    """Work (J/m2) of one bond along straight ways less what it stores, by trapezia."""
    history, work, before = law.initial(np.ones(1, dtype=bool)), 0.0, np.zeros(2)
    springs, old = (np.array([NORMAL]), np.array([SHEAR])), np.zeros(2)
    for corner in corners:
        for place in np.linspace(before, corner, 301)[1:]:
            found = law.update(history, place[:1], place[1:], springs)
            new, history = found.traction[0], found.history
            work, old, before = work + (old + new) / 2 @ (place - before), new, place
    gap, slip = before[0], before[1] - history["plastic_slip"][0]
    return work - (old[0] * gap + old[1] * slip) / 2


@LAWS
@pytest.mark.parametrize("beyond", [1.01, 30.0])
def test_a_bond_that_is_torn_in_one_step_takes_its_fracture_energy(law, beyond):
    """However far it is opened beyond the width where nothing is left: 10 GF / ft at most."""
    width = 10 * law.fracture_energy / law.tensile_strength
    assert taken(law, (beyond * width, 0.0)) == pytest.approx(100.0, rel=1e-12)


@LAWS
def test_a_bond_that_is_sheared_off_in_one_step_takes_its_shear_fracture_energy(law):
    assert taken(law, (-0.0, 40 * 250.0 / 4e6)) == pytest.approx(250.0, rel=1e-9)


@LAWS
@pytest.mark.parametrize("steps", [1, 2, 7])
def test_a_bond_that_opens_takes_what_its_steps_do_not_change(law, steps):
    """The area under the curve to 0.4 GF / ft less the triangle of its secant, by 2e4 trapezia."""
    most = 0.4 * law.fracture_energy / law.tensile_strength
    curve = (law.curve[0] * law.fracture_energy / law.tensile_strength, law.curve[1])
    there = most + np.interp(most, *curve) * law.tensile_strength / NORMAL
    width = np.linspace(0, most, FINE + 1)
    area = np.trapezoid(np.interp(width, *curve), width) - np.interp(most, *curve) * most / 2
    places = [(there * k / steps, 0.0) for k in range(1, steps + 1)]
    assert taken(law, *places) == pytest.approx(law.tensile_strength * area, rel=1e-7)


def test_a_bond_that_goes_back_and_opens_again_takes_nothing():
    places = [(2e-5, 0.0), (1e-6, 0.0), (-1e-6, 0.0), (2e-5, 0.0)]
    assert taken(LINEAR, *places) == pytest.approx(taken(LINEAR, places[0]), rel=1e-12)


def test_shear_that_a_torn_bond_held_goes_with_it():
    """1 MPa in the shear spring, 1e12 / 2 / 4e12 = 0.125 J/m2, beside the fracture energy."""
    places = [(0.0, 1e6 / SHEAR), (1e-2, 1e6 / SHEAR)]
    assert taken(LINEAR, *places) == pytest.approx(100.125, rel=1e-9)


@LAWS
def test_a_pressed_bond_that_is_sheared_off_rubs_beside_its_cohesion(law):
    """Under 1 MPa friction falls with the bond from tan 0.6 to tan 0.4; it slides 20 widths."""
    width = law.curve[0][-1] * 250.0 / 4e6
    far = 20 * width
    places = [(-1e6 / NORMAL, 0.0), (-1e6 / NORMAL, far)]
    share = 250.0 / 4e6  # the area under the curve in metres of whole strength
    slid = far  # beyond residual friction's stretch of the spring, 1e6 tan 0.4 / 4e12
    slid -= 1e6 * np.tan(0.4) / SHEAR
    rubbed = 1e6 * (np.tan(0.4) * slid + (np.tan(0.6) - np.tan(0.4)) * share)
    assert taken(law, *places) == pytest.approx(250.0 + rubbed, rel=1e-9)


@pytest.mark.parametrize(
    "places",
    [
        [(5e-6, 0.0), (5e-6, 4e-5)],
        [(2e-5, 0.0), (2e-5, 1.5e-4)],
        [(0.0, 4e-5), (6e-6, 4e-5)],
        [(-1e-7, 3e-5), (3e-5, 3e-5)],
    ],
    ids=["opened and slid", "opened and sheared off", "slid and opened", "slid and torn"],
)
def test_bonds_that_open_and_slide_one_after_the_other_take_the_work_of_their_way(places):
    # Trapezia of three hundred steps a way pass kinks.
    fine = along(LINEAR, *places)
    assert taken(LINEAR, *places) == pytest.approx(fine, rel=5e-3)


def test_a_law_of_ones_own_takes_the_work_of_its_mean_tractions():
    """Linear softening by parts of a hundredth, by the rule of laws that say nothing themselves."""

    class Silent(LinearSoftening):
        dissipated = InterfaceLaw.dissipated

    law = Silent(**vars(LINEAR))
    places = [(gap, 0.0) for gap in np.linspace(0, 70e-6, 701)[1:]]
    assert taken(law, *places) == pytest.approx(100.0, rel=1e-3)
