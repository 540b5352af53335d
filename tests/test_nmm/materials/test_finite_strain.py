"""Laws of finite strain against closed forms: stresses, energies, tangents, sheets."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from nmm.assembly.finite_strain.gradients import green, volumes
from nmm.errors import FormulationError
from nmm.materials.elastic import Elastic
from nmm.materials.neo_hookean import NeoHookean
from nmm.materials.von_mises import VonMisesPlasticity
from nmm.testing.laws.materials import check_law
from nmm.verification.problems.finite.laws import SKEW

E, NU = 1.0, 0.3
MU, LAME = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
SVK, NH = Elastic(E, NU), NeoHookean(E, NU)
LAWS = [(SVK, "strain"), (NH, "strain"), (SVK, "stress"), (NH, "stress")]


@pytest.mark.parametrize(("law", "plane"), LAWS)
def test_stress_and_tangent_are_derivatives_of_the_energy(law, plane):
    strain = np.random.default_rng(0).uniform(-0.2, 0.3, (50, 3))
    near, found = 1e-6, law.potential(strain, plane)
    for axis in range(3):
        ends = [law.potential(strain + s * near * np.eye(3)[axis], plane) for s in (1, -1)]
        slope = (ends[0].energy - ends[1].energy) / (2 * near)
        np.testing.assert_allclose(found.stress[:, axis], slope, atol=1e-8)
        slopes = (ends[0].stress - ends[1].stress) / (2 * near)
        np.testing.assert_allclose(found.tangent[:, :, axis], slopes, atol=1e-7)


def test_a_sheet_takes_the_thickness_of_least_energy():
    gradient = (np.array(SKEW) - np.eye(2)).reshape(1, 4)
    area = volumes(gradient)[0]

    def energy(across):
        trace = np.sum(np.array(SKEW) ** 2) + across**2
        log = np.log(area * across)
        return MU / 2 * (trace - 3 - 2 * log) + LAME / 2 * log**2

    least = minimize_scalar(energy, bounds=(0.3, 3), options={"xatol": 1e-12}, method="bounded")
    assert NH.potential(green(gradient), "stress").energy[0] == pytest.approx(least.fun, rel=1e-10)


@pytest.mark.parametrize(("law", "plane"), LAWS)
def test_small_strains_have_the_energy_of_hooke_to_their_own_rounding(law, plane):
    strain = 1e-7 * np.random.default_rng(1).uniform(-1, 1, (50, 3))
    found, matrix = law.potential(strain, plane), law.stiffness(plane)
    np.testing.assert_allclose(found.stress, strain @ matrix.T, atol=1e-6 * 1e-7)
    hooke = np.einsum("mi,ij,mj->m", strain, matrix, strain) / 2
    # A logarithm of 1e-7 leaves rounding of 1e-16 of the strain.
    np.testing.assert_allclose(found.energy, hooke, rtol=1e-5, atol=1e-23)


def test_beyond_finite_strain_it_is_a_law_like_every_other():
    check_law(NH)


def test_what_the_law_cannot_bear_is_refused():
    with pytest.raises(FormulationError, match="less than 1/2"):
        NeoHookean(1.0, 0.5)
    with pytest.raises(FormulationError, match="no potential of finite strain"):
        VonMisesPlasticity(1.0, 0.3, 1.0).potential(np.zeros((1, 3)), "strain")
