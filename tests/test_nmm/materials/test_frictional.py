"""Tension cut-off of Mohr-Coulomb, and Drucker-Prager: returns, limits and tangents."""

import numpy as np
import pytest
from scipy.optimize import LinearConstraint, minimize

from nmm.errors import FormulationError
from nmm.materials.drucker_prager import DruckerPragerPlasticity
from nmm.materials.mohr_coulomb import MohrCoulombPlasticity
from nmm.testing.laws.materials import check_law, start_of
from nmm.verification.problems.matter.returns import returned

DEGREE = np.pi / 180
ELASTIC = 1e5, 0.25


@pytest.mark.parametrize(("dilation", "cut"), [(30, 5.0), (10, 5.0), (0, 0.0), (30, 34.0)])
def test_mohr_coulomb_with_a_cut_off_keeps_what_every_law_must(dilation, cut):
    check_law(
        MohrCoulombPlasticity(*ELASTIC, 20.0, 30 * DEGREE, dilation * DEGREE, cut),
        planes=("strain",),
    )


@pytest.mark.parametrize("match", ["plane_strain", "compression", "extension"])
@pytest.mark.parametrize(("dilation", "cut"), [(30, None), (10, None), (0, 5.0), (30, 5.0)])
def test_drucker_prager_keeps_what_every_law_must(match, dilation, cut):
    law = DruckerPragerPlasticity(*ELASTIC, 20.0, 30 * DEGREE, dilation * DEGREE, cut, match)
    check_law(law, planes=("strain",), strains=(1e-4, 1e-3, 1e-2))


def test_drucker_prager_without_friction_keeps_what_every_law_must():
    check_law(DruckerPragerPlasticity(*ELASTIC, 20.0, 0.0), planes=("strain",), strains=(1e-3,))


TRIALS = [
    *((40, 30, 10), (25, 20, -10), (60, -10, -40), (10, 8, -300), (9, -60, -90), (8, -1, -2)),
    *((80, 75, 60), (4, -50, -400), (6, 6, -200), (30, -100, -110)),
]


@pytest.mark.parametrize("trial", TRIALS)
@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1)])
def test_the_cut_off_returns_to_the_nearest_stress_that_is_borne(trial, order):
    # With associated flow the return is the nearest admissible stress in the norm of the elastic
    # energy: found by quadratic programming over the 12 planes, a method of its own.
    cohesion, angle, cut, nu = 20.0, 30 * DEGREE, 5.0, 0.25
    law = MohrCoulombPlasticity(*ELASTIC, cohesion, angle, angle, cut)
    sine = np.sin(angle)
    rows = [np.eye(3)[i] for i in range(3)]
    rows += [
        (1 + sine) * np.eye(3)[i] - (1 - sine) * np.eye(3)[j]
        for i in range(3)
        for j in range(3)
        if i != j
    ]
    limits = [cut] * 3 + [2 * cohesion * np.cos(angle)] * 6
    soft = (1 + nu) * np.eye(3) - nu
    nearest = minimize(
        lambda s: (s - trial) @ soft @ (s - trial) / 2,
        np.zeros(3),
        jac=lambda s: soft @ (s - trial),
        constraints=LinearConstraint(np.array(rows), -np.inf, limits),
        method="SLSQP",
        options={"ftol": 1e-16, "maxiter": 500},
    ).x
    given = np.array(trial)[list(order)]
    # Programming finds places to the root of the rounding of the energy.
    np.testing.assert_allclose(returned(law, given, 0.4), np.sort(nearest)[::-1], atol=2e-5)


@pytest.mark.parametrize(
    ("nu", "dilation", "cut"), [(0.25, 10, 5.0), (0.4999, 0, 0.0), (0.0, 30, 3.0)]
)
def test_random_stresses_return_inside_the_cut_pyramid(nu, dilation, cut):
    random = np.random.default_rng(5)
    law = MohrCoulombPlasticity(1e5, nu, 20.0, 30 * DEGREE, dilation * DEGREE, cut)
    strain = random.normal(size=(20_000, 3)) * 10 ** random.uniform(-6, -1, (20_000, 1))
    found = law.update(strain, start_of(law, "strain", 20_000), "strain", 0.0)
    xx, yy, xy = found.stress.T
    middle, radius = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    three = np.stack([middle + radius, middle - radius, found.history["stress_zz"][:, 0]])
    high, low = three.max(axis=0), three.min(axis=0)
    beyond = np.maximum((high - low) + (high + low) * 0.5 - 40 * np.cos(30 * DEGREE), high - cut)
    # Rounding of trials, up to 1e8 kPa at the Poisson's ratio of 0.4999.
    assert (beyond <= 1e-9 * (np.abs(three).max(axis=0) + 3e8 * np.abs(strain).max(axis=1))).all()


@pytest.mark.parametrize("match", ["compression", "extension"])
def test_cones_go_through_the_edges_that_they_match(match):
    # Two equal stresses and an axial one, from Mohr and Coulomb's own line.
    angle, cohesion, low = 25 * DEGREE, 12.0, -70.0
    law = DruckerPragerPlasticity(*ELASTIC, cohesion, angle, match=match)
    high = (2 * cohesion * np.cos(angle) + low * (1 - np.sin(angle))) / (1 + np.sin(angle))
    stress = np.array((high, high, low) if match == "compression" else (high, low, low))
    mean = stress.mean()
    size = np.sqrt(((stress - mean) ** 2).sum() / 2)
    eta, xi = law.slopes(angle)
    assert size + eta * mean == pytest.approx(xi * cohesion, rel=1e-12)


def test_a_biaxial_test_follows_mohr_coulomb_with_dilation():
    # From 100 kPa all round, E = 50 MPa, nu = 0.25, c = 20 kPa, phi = 30: yield at a compression of
    # 0.005049038106 where s_y = 369.282032 kPa; then d e_x = -N_psi d e_y.
    for dilation, across in ((10, -0.02291751441), (0, -0.0166339746)):
        law = MohrCoulombPlasticity(50e3, 0.25, 20.0, 30 * DEGREE, dilation * DEGREE)
        start = -100 * (1 - 2 * 0.25) / 50e3
        history = start_of(law, "strain", 1)
        history["plastic_strain"][0, 3] = -start  # the stress across is 100 kPa as well
        for down in (0.005049038106, 0.02):
            side = 0.001683012702 if down < 0.01 else -across
            given = np.array([[start + side, start - down, 0.0]])
            found = law.update(given, history, "strain", 0.0)
            expected = [-100, -369.282032, 0]
            np.testing.assert_allclose(found.stress[0], expected, rtol=1e-7, atol=1e-5)
            history = found.history
        assert history["stress_zz"][0, 0] == pytest.approx(-167.320508, rel=1e-8)


@pytest.mark.parametrize(
    ("law", "constants", "said"),
    [
        (MohrCoulombPlasticity, {"tensile_strength": 40.0}, "never acts"),
        (DruckerPragerPlasticity, {"tensile_strength": -1.0}, "tensile_strength: -1"),
        (DruckerPragerPlasticity, {"match": "inner"}, "match: 'inner'"),
        (DruckerPragerPlasticity, {"dilation_angle": 0.6}, "would give energy"),
    ],
)
def test_constants_that_make_no_sense_are_refused(law, constants, said):
    with pytest.raises(FormulationError, match=said):
        law(*ELASTIC, 20.0, 30 * DEGREE, **constants)
