"""Criteria of growth against closed forms, and against maxima found by brute force."""

import numpy as np
import pytest

from integration.arrays import Floats
from nmm.fracture.criteria.base import CRITERIA, Criterion
from nmm.fracture.criteria.energy_release import EnergyRelease
from nmm.fracture.criteria.hoop_stress import HoopStress
from nmm.fracture.criteria.straight_ahead import StraightAhead
from nmm.fracture.criteria.strain_energy_density import StrainEnergyDensity
from nmm.fracture.toughness import Toughness
from nmm.testing import check_criterion

# K_I, K_II, kink of the largest hoop stress (degrees) and its intensity, kink of the least density.
MIXED = np.array(
    [
        [1, 0.05, -5.69651590, 1.0037337395, -5.678076],
        [1, 0.25, -25.33293861, 1.0853006672, -24.164637],
        [1, 0.5, -40.20781872, 1.2827945709, -37.627234],
        [1, 1, -53.13010235, 1.7888543820, -51.906734],
        [0.2, 1, -66.75956464, 1.2673806457, -74.630382],
        [0, 1, -70.52877937, 1.1547005384, -82.337744],
    ]
)
KAPPA = 3 - 4 * 0.3
CRITERION: list[Criterion] = [CRITERIA.make(name) for name in CRITERIA.names()]
TURNING = [item for item in CRITERION if not isinstance(item, StraightAhead)]


@pytest.mark.parametrize("criterion", CRITERION, ids=lambda item: type(item).__name__)
def test_criteria_keep_what_every_one_promises(criterion: Criterion) -> None:
    check_criterion(criterion)


@pytest.mark.parametrize("row", MIXED, ids=lambda row: f"{row[0]:g}-{row[1]:g}")
@pytest.mark.parametrize("sign", [1, -1])
def test_cracks_kink_where_the_hoop_stress_is_largest(row: Floats, sign: int) -> None:
    one, two, angle, equivalent, _ = row
    found = HoopStress().kink(np.array([one]), np.array([sign * two]), np.array([KAPPA]))
    # The table has eight digits of degrees, ten of intensities.
    assert np.degrees(found.angle[0]) == pytest.approx(sign * angle, abs=6e-9)
    assert found.equivalent[0] == pytest.approx(equivalent, abs=6e-11)
    exact = 2 * np.arctan2(-2 * two, one + np.sqrt(one**2 + 8 * two**2))
    assert found.angle[0] == pytest.approx(sign * exact, abs=1e-10)


@pytest.mark.parametrize("row", MIXED, ids=lambda row: f"{row[0]:g}-{row[1]:g}")
def test_cracks_kink_where_the_strain_energy_density_is_least(row: Floats) -> None:
    one, two = np.array([row[0]]), np.array([row[1]])
    found = StrainEnergyDensity().kink(one, two, np.array([KAPPA]))
    # The table minimised values, which resolves angles to the root of rounding.
    assert np.degrees(found.angle[0]) == pytest.approx(row[4], abs=3e-6)


def test_the_least_density_of_pure_sliding_has_a_closed_form() -> None:
    nu = np.array([0.0, 0.1, 0.25, 0.3, 0.45])
    found = StrainEnergyDensity().kink(np.zeros(5), np.ones(5), 3 - 4 * nu)
    assert found.angle == pytest.approx(-np.arccos((1 - 2 * nu) / 3), abs=1e-10)


def test_the_hoop_stress_is_the_largest_of_all_directions() -> None:
    mix = np.linspace(0.0, np.pi / 2, 30)
    one, two, t = np.cos(mix), np.sin(mix), np.linspace(-np.pi, np.pi, 20001)[:, None]
    hoop = np.cos(t / 2) ** 2 * (one * np.cos(t / 2) - 3 * two * np.sin(t / 2))
    found = HoopStress().kink(one, two, np.full(30, KAPPA))
    assert found.equivalent == pytest.approx(hoop.max(axis=0), abs=1e-7)


def test_kinks_that_release_most_are_those_of_the_literature() -> None:
    # Amestoy and Leblond (1992): 75.6 degrees in pure sliding, against 77.3 of local symmetry and
    # 70.5 of the hoop stress; for little sliding all agree with -2 K_II / K_I.
    found = EnergyRelease().kink(np.array([0.0, 1.0]), np.array([1.0, 1e-4]), np.full(2, KAPPA))
    assert np.degrees(found.angle[0]) == pytest.approx(-75.6, abs=0.3)
    assert found.angle[1] == pytest.approx(-2e-4, rel=1e-3)
    # A kink of no angle keeps the release rate, so that the best has at least as much.
    assert found.equivalent[0] ** 2 == pytest.approx(1.517, abs=5e-3)


def test_criteria_agree_for_little_sliding() -> None:
    one, two, kappa = np.ones(1), np.array([0.02]), np.array([KAPPA])
    angles = [float(item.kink(one, two, kappa).angle[0]) for item in TURNING]
    assert angles == pytest.approx([-0.04] * len(angles), rel=5e-3)


def test_a_crack_that_is_pressed_but_slides_kinks_too() -> None:
    for criterion in TURNING:
        found = criterion.kink(np.array([-0.15]), np.ones(1), np.array([KAPPA]))
        assert found.equivalent[0] > 0.7
        assert -np.radians(95) < found.angle[0] < -np.radians(65)


def test_fracture_energy_and_intensity_are_one_toughness() -> None:
    stiff = np.array([30e9 / (1 - 0.2**2)])
    by_energy = Toughness(energy=100.0)
    assert by_energy.intensities(stiff) == pytest.approx(1.767767e6, rel=1e-6)
    assert Toughness(intensity=1.767767e6).energies(stiff) == pytest.approx(100.0, rel=1e-6)
    for wrong in ({}, {"intensity": 1.0, "energy": 1.0}, {"energy": -1.0}, {"intensity": 0.0}):
        with pytest.raises(ValueError, match="expected"):
            Toughness(**wrong)


def test_what_presses_a_crack_that_slides_straight_on_holds_it_by_nothing() -> None:
    """Pure sliding is a limit from both sides: rounding of K_I had held an end-notched beam."""
    found = StraightAhead().kink(np.array([1e-9, -1e-9, -2.0]), np.ones(3), np.full(3, KAPPA))
    assert found.equivalent == pytest.approx(np.ones(3), abs=1e-15)
