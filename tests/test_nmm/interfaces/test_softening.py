"""Cohesive laws alone: what strength is left at what opening, and the energy it takes."""

import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from nmm.errors import SceneError
from nmm.interfaces.from_scene import interface_law
from nmm.interfaces.mohr_coulomb import MohrCoulomb
from nmm.interfaces.restitution import damping_of, restitution
from nmm.interfaces.softening import BilinearSoftening, ExponentialSoftening, LinearSoftening
from nmm.scene.matter.interfaces import InterfaceTable
from nmm.trust import allowing

ME = Path(__file__).stem
STRENGTH, ENERGY, SPRING = 3e6, 100.0, 1e13
LINEAR = LinearSoftening(
    friction_angle=0.6,
    cohesion=4e6,
    tensile_strength=STRENGTH,
    bonded=True,
    fracture_energy=ENERGY,
)
BILINEAR = BilinearSoftening(**vars(LINEAR))
EXPONENTIAL = ExponentialSoftening(**vars(LINEAR))


def remembered(law, damage):
    """History of bonds with some damage."""
    damage = np.asarray(damage, dtype=float)
    return law.initial(damage < 1) | {"damage": damage}


def pulled(law, openings):
    """Stress of a bond that opens monotonically from nothing."""
    gap = np.asarray(openings, dtype=float)
    spring = np.full(len(gap), SPRING)
    history = law.initial(np.ones(len(gap), dtype=bool))
    return law.update(history, gap, 0 * gap, (spring, spring)).traction[:, 0]


@pytest.mark.parametrize("law", [LINEAR, BILINEAR, EXPONENTIAL])
def test_the_area_under_the_curve_is_the_fracture_energy_whatever_the_spring(law):
    """Trapezoids on 5e4 intervals of a piecewise linear curve: error about 1e-7."""
    openings = np.linspace(0, 12 * ENERGY / STRENGTH, 50_001)
    assert np.trapezoid(pulled(law, openings), openings) == pytest.approx(ENERGY, rel=1e-6)


def test_linear_softening_ends_at_twice_energy_over_strength():
    """wc = 2 GF / ft = 66.667 um; at half of it half of the strength is left (closed form)."""
    width = 2 * ENERGY / STRENGTH
    assert pulled(LINEAR, [width])[0] == 0.0
    half = width / 2 + 0.5 * STRENGTH / SPRING
    assert pulled(LINEAR, [half])[0] == pytest.approx(STRENGTH / 2, rel=1e-12)


def test_bilinear_softening_passes_a_third_at_four_fifths_of_energy_over_strength():
    """Petersson's knee, with the elastic stretch of the spring on top."""
    knee = 0.8 * ENERGY / STRENGTH + STRENGTH / 3 / SPRING
    assert pulled(BILINEAR, [knee])[0] == pytest.approx(STRENGTH / 3, rel=1e-12)


@pytest.mark.parametrize("width", [0.1, 1.0, 3.0])
def test_exponential_softening_falls_by_e_over_energy_over_strength(width):
    """``exp(-w ft / GF)``; chords of 0.08 are off by 1e-3."""
    left = np.exp(-width)
    there = width * ENERGY / STRENGTH + left * STRENGTH / SPRING
    assert pulled(EXPONENTIAL, [there])[0] == pytest.approx(left * STRENGTH, rel=2e-3)


def test_damage_never_heals():
    """A bond with damage 0.4 that is closed again keeps it."""
    closed, none, spring = (np.array([value]) for value in (-1e-5, 0.0, SPRING))
    after = LINEAR.update(remembered(LINEAR, [0.4]), closed, none, (spring, spring))
    assert after.history["damage"][0] == 0.4
    assert after.traction[0, 0] == SPRING * closed[0]


def test_an_opened_bond_goes_back_to_the_origin_on_its_secant():
    """Damage 1/2 carries ft / 2 at an opening of wc / 2 + ft / 2 / k, half of that at half way."""
    width = 2 * ENERGY / STRENGTH
    there = np.array([width / 2 + STRENGTH / 2 / SPRING])
    spring, none = np.array([SPRING]), np.zeros(1)
    found = LINEAR.update(remembered(LINEAR, [0.5]), there / 2, none, (spring, spring))
    assert found.traction[0, 0] == pytest.approx(STRENGTH / 4, rel=1e-12)
    assert found.tangent[0, 0, 0] == pytest.approx(STRENGTH / 2 / there[0], rel=1e-9)


def test_an_open_bond_that_slides_goes_to_the_secant_that_is_left():
    """It stayed on the secant before, and the next step began with another force."""
    width, slip_width, spring = 2 * ENERGY / STRENGTH, 2 * ENERGY / 4e6, np.array([SPRING])
    gap = np.array([0.2 * width + 0.8 * STRENGTH / SPRING])
    history = {
        "bonded": np.array([True]),
        "plastic_slip": np.zeros(1),
        "damage": np.array([0.2]),
    }
    slip = np.array([0.3 * slip_width])
    found = LINEAR.update(history, gap, slip, (spring, spring))
    damage = found.history["damage"]
    # What is left of cohesion is what the spring is stretched by beyond the slip that damaged.
    assert damage == pytest.approx(0.2 + (slip - found.traction[0, 1] / SPRING) / slip_width)
    assert damage > 0.45
    strength = (1 - damage) * STRENGTH
    secant = strength / (strength / SPRING + damage * width)
    assert found.traction[0, 0] == pytest.approx(secant * gap, rel=1e-9)
    again = LINEAR.update(found.history, gap, slip, (spring, spring))
    assert again.traction == pytest.approx(found.traction, rel=1e-9)
    # Slopes by differences of whole steps, small enough to slide on.
    for column, (opens, slides) in enumerate([(1e-10, 0.0), (0.0, 1e-10)]):
        more, less = (
            LINEAR.update(history, gap + way * opens, slip + way * slides, (spring, spring))
            for way in (1, -1)
        )
        slope = (more.traction - less.traction)[0] / 2e-10
        assert found.tangent[0, :, column] == pytest.approx(slope, rel=1e-4, abs=1e-4 * SPRING)


def test_a_bond_that_opens_and_slides_is_answered_by_few_evaluations(monkeypatch):
    """What slides, and what opening and sliding take of the strength, has one kink: 37 before."""
    asked, evolved = [], LinearSoftening.evolved

    def counted(*arguments):
        asked.append(1)
        return evolved(*arguments)

    monkeypatch.setattr(LinearSoftening, "evolved", counted)
    damage, gap, slip = np.array([0.0455, 0.2]), np.array([3.878e-6, 1e-5]), np.array([-2e-6, 4e-6])
    spring = np.full(2, 5.418e12)
    found = LINEAR.update(remembered(LINEAR, damage), gap, slip, (spring, spring))
    assert len(asked) <= 12
    left = 1 - found.history["damage"]
    assert np.abs(found.traction[:, 1]) == pytest.approx(left * LINEAR.cohesion, rel=1e-9)


def test_sliding_takes_cohesion_by_its_own_energy():
    """ws = 2 GF2 / c = 2 * 200 / 4e6 = 1e-4 m: 2.5e-5 m of sliding is damage 0.25."""
    law = replace(LINEAR, shear_fracture_energy=200.0)
    one = np.ones(1)
    after = law.evolved(remembered(law, [0.0]), -one, 2.5e-5 * one, SPRING * one)
    assert after["damage"][0] == pytest.approx(0.25, rel=1e-12)
    assert law.response(after, SPRING * one).limits.cohesion[0] == pytest.approx(3e6, rel=1e-12)


def test_a_spring_too_soft_for_the_energy_is_refused():
    """Below ft^2 / (2 GF) = 4.5e10 Pa/m the bond itself would snap back."""
    one = np.ones(1)
    with pytest.raises(SceneError, match="normal_stiffness"):
        LINEAR.evolved(remembered(LINEAR, [0.0]), one, 0 * one, 4.4e10 * one)


def test_a_broken_bond_has_its_residual_friction_angle():
    """Peak angle 0.6 while it holds, 0.4 afterwards; an unbonded contact keeps 0.6."""
    law = MohrCoulomb(friction_angle=0.6, cohesion=1.0, bonded=True, residual_friction_angle=0.4)
    friction = law.friction(law.initial(np.array([True, False])))
    assert friction == pytest.approx(np.tan([0.6, 0.4]), rel=1e-14)
    loose = MohrCoulomb(friction_angle=0.6)
    assert loose.friction(loose.initial(np.array([False])))[0] == pytest.approx(np.tan(0.6))


@pytest.mark.parametrize("wanted", [0.9, 0.5, 0.1])
def test_damping_gives_the_restitution_asked_for(wanted):
    """A mass on spring and damper by fine explicit steps until the force would pull."""
    share, step = damping_of(wanted), 1e-5
    gap, speed = 0.0, -1.0
    while True:
        force = -gap - 2 * share * speed
        if force <= 0 and gap < 0:
            break
        speed += step * force
        gap += step * speed
    assert speed == pytest.approx(wanted, rel=1e-3)  # explicit Euler at 1e-5 of a period / 2 pi
    assert restitution(share) == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("wanted", [1e-6, 5e-10, 5e-16, 1e-300])
def test_a_restitution_of_almost_nothing_has_its_damping(wanted):
    """Far beyond critical damping it is 1 / (2 share)^2."""
    assert damping_of(wanted) == pytest.approx(0.5 / np.sqrt(wanted), rel=1e-4)


@dataclass(frozen=True)
class Brittle(MohrCoulomb):
    """The common law under another name, without a softened form."""


@dataclass(frozen=True)
class Mortar(MohrCoulomb):
    """The common law under another name, which softens bilinearly."""

    softened: ClassVar[str] = "bilinear_softening"


@pytest.mark.parametrize(
    ("law", "meant"),
    [
        ("mohr_coulomb", LinearSoftening),
        (f"{ME}:Brittle", Brittle),
        (f"{ME}:Mortar", BilinearSoftening),
    ],
)
def test_a_fracture_energy_asks_for_the_softened_form_that_a_law_says_it_has(
    monkeypatch, law, meant
):
    monkeypatch.setitem(sys.modules, ME, sys.modules[__name__])
    bonded = {"bonded": True, "cohesion": 4e6, "tensile_strength": 3e6, "friction_angle": 0.6}
    table = InterfaceTable.model_validate({"law": law, **bonded, "fracture_energy": 100.0})
    with allowing(ME):
        assert type(interface_law(table)) is meant
