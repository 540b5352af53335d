"""Stress-strain laws: properties of all of them, and von Mises against closed forms."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import nmm
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.materials.elastic import Elastic, elastic_energy
from nmm.materials.mohr_coulomb import MohrCoulombPlasticity
from nmm.materials.von_mises import VonMisesPlasticity
from nmm.scene import parse_scene
from nmm.testing.laws.materials import check_law, start_of
from nmm.testing.scenes import pulled_bar

STEEL = VonMisesPlasticity(200e9, 0.3, 250e6, 20e9)


@pytest.mark.parametrize(
    "law",
    [
        Elastic(1e9, 0.3),
        VonMisesPlasticity(1e9, 0.3, 1e6),
        VonMisesPlasticity(1e9, 0.0, 1e6, 1e8),
        VonMisesPlasticity(1e9, 0.49, 1e5, 1e9),
    ],
    ids=["elastic", "perfectly plastic", "hardening", "nearly incompressible"],
)
def test_laws_keep_what_every_law_must(law):
    check_law(law)


@pytest.mark.parametrize(("friction", "dilation"), [(0.5, 0.5), (0.5, 0.2), (0.5, 0.0), (0.0, 0.0)])
def test_mohr_coulomb_keeps_what_every_law_must(friction, dilation):
    check_law(MohrCoulombPlasticity(1e5, 0.25, 20.0, friction, dilation), planes=("strain",))


def test_mohr_coulomb_is_refused_in_plane_stress():
    with pytest.raises(FormulationError, match="takes part in the yield"):
        MohrCoulombPlasticity(1e5, 0.25, 20.0, 0.5).stiffness("stress")


@dataclass(frozen=True)
class Plain(Elastic):
    """A law that answers in a plain tuple."""

    def update(self, strain, history, plane, step):
        matrix = self.stiffness(plane)
        return strain @ matrix, np.tile(matrix, (len(strain), 1, 1)), history


def test_a_law_may_answer_in_a_plain_tuple():
    check_law(Plain(1e9, 0.3))
    material = f'[materials.m]\nlaw = "{__name__}:Plain"\nyoung_modulus = 100\npoisson_ratio = 0\n'
    bar = parse_scene(pulled_bar([material], [("bar", "m")]), "bar")
    held = '[supports]\nmethod = "penalty"\nstiffness = 1e3\n'
    formulation = parse_formulation(f'[cover]\ntype = "triangles"\nsize = 0.4\n{held}')
    end = nmm.run(bar, formulation, allow_code=[__name__]).history["monitor:end:ux"][-1]
    # 1 Pa on 1 m of 100 Pa, and on springs of 1e3 moduli over the cell; iterations leave 1e-10.
    assert end == pytest.approx(1 / 100 + 0.4 / (1e3 * 100), rel=1e-9)


def test_elastic_energy_is_that_of_uniaxial_hydrostatic_and_shear_stress():
    """``s^2 / 2E``, ``3 (1 - 2 nu) s^2 / 2E`` and ``(1 + nu) s^2 / E``."""
    stress = 3e6 * np.array([[1.0, 0, 0], [1.0, 1.0, 0], [0, 0, 1.0]])
    found = elastic_energy(2e9, 0.3, stress, 3e6 * np.array([0.0, 1.0, 0.0]))
    expected = np.array([0.5, 1.5 * (1 - 2 * 0.3), 1 + 0.3]) * 3e6**2 / 2e9
    assert found == pytest.approx(expected, rel=1e-12)


@dataclass(frozen=True)
class ElasticTangent(VonMisesPlasticity):
    """A wrong law: its tangent is not that of its stress."""

    def update(self, strain, history, plane, step):
        found = super().update(strain, history, plane, step)
        return found._replace(tangent=np.tile(self.stiffness(plane), (len(strain), 1, 1)))


@dataclass(frozen=True)
class Forgetful(VonMisesPlasticity):
    """A wrong law: it leaves one of its variables out."""

    def update(self, strain, history, plane, step):
        found = super().update(strain, history, plane, step)
        return found._replace(history={"stress_zz": found.history["stress_zz"]})


@dataclass(frozen=True)
class Generous(Elastic):
    """A wrong law: paths around a loop give energy, as its matrix is not symmetric."""

    symmetric = False

    def update(self, strain, history, plane, step):
        matrix = self.stiffness(plane)
        bent = matrix + np.array([[0, 0, 0], [0, 0, 0], [0.5, 0, 0]]) * self.young_modulus
        first = np.abs(strain).max(axis=1) == 0
        tangent = np.where(first[:, None, None], matrix, bent)
        return (
            super()
            .update(strain, history, plane, step)
            ._replace(stress=strain @ bent.T, tangent=tangent)
        )


@pytest.mark.parametrize(
    ("law", "said"),
    [
        (ElasticTangent(1e9, 0.3, 1e6), "no derivative"),
        (Forgetful(1e9, 0.3, 1e6), "variables"),
        (Generous(1e9, 0.3), "of its energy"),
    ],
)
def test_a_wrong_law_is_told(law, said):
    with pytest.raises(AssertionError, match=said):
        check_law(law, planes=("stress",))


def followed(law, plane, strains):
    """Stresses (k, 3) of one point along strains (k, 3), and its variables at the end."""
    history, found = start_of(law, plane, 1), []
    for strain in strains:
        answer = law.update(np.array([strain]), history, plane, 0.0)
        history = answer.history
        found.append(answer.stress[0])
    return np.array(found), history


def test_one_way_strain_yields_and_hardens_as_its_closed_form():
    # sx - sy = yield at e = Y / 2G; then K + 4/3 G H / (3 G + H), from the radial flow.
    shear, bulk = STEEL.young_modulus / 2.6, STEEL.young_modulus / 1.2
    first, h = 250e6 / (2 * shear), STEEL.hardening_modulus
    slope = bulk + 4 / 3 * shear * h / (3 * shear + h)
    at = np.array([0.5, 1.0, 2.0, 5.0]) * first
    expected = (bulk + 4 / 3 * shear) * np.minimum(at, first) + slope * np.maximum(at - first, 0)
    found, _ = followed(STEEL, "strain", [(e, 0, 0) for e in at])
    np.testing.assert_allclose(found[:, 0], expected, rtol=1e-12)


@pytest.mark.parametrize("plane", ["stress", "strain"])
def test_pure_shear_yields_at_the_stress_over_the_root_of_three(plane):
    perfect = replace(STEEL, hardening_modulus=0.0)
    found, history = followed(perfect, plane, [(0, 0, 0.01), (0, 0, 0.03)])
    np.testing.assert_allclose(found[:, 2], 250e6 / np.sqrt(3), rtol=1e-12)
    # g_p / sqrt 3 with g_p = g - tau / G.
    way = (0.03 - found[1, 2] / (200e9 / 2.6)) / np.sqrt(3)
    assert history["accumulated_plastic_strain"][0, 0] == pytest.approx(way, rel=1e-12)


def test_plane_stress_is_the_solid_without_stress_across():
    # Against the radial return with the strain across searched by bisection: another algorithm.
    from nmm.materials.return_mapping.radial_return import radial_return

    law, strain = STEEL, np.array([[3e-3, -1e-3, 2e-3]])
    constants = (law.young_modulus, law.poisson_ratio, law.yield_stress, law.hardening_modulus)
    low, high = -5e-3, 5e-3
    for _ in range(80):
        across = (low + high) / 2
        # A strain across is one of opposite sign in the plastic strain that is taken off.
        shifted = np.array([[0, 0, 0, -across]])
        found = radial_return(strain, shifted, np.zeros(1), constants)
        low, high = (across, high) if found.stress[0, 3] < 0 else (low, across)
    projected, _ = followed(law, "stress", strain)
    np.testing.assert_allclose(projected[0], found.stress[0, :3], rtol=1e-9)


@pytest.mark.parametrize(
    ("constants", "said"),
    [((1e9, 0.3, 0.0), "yield_stress: 0.0"), ((1e9, 0.3, 1e6, -1.0), "hardening_modulus: -1.0")],
)
def test_constants_that_make_no_sense_are_refused(constants, said):
    with pytest.raises(FormulationError, match=said):
        VonMisesPlasticity(*constants)


DEGREE = np.pi / 180


def test_an_oedometer_follows_the_edge_of_the_pyramid():
    # E = 50 MPa, nu = 0.2, c = 10 kPa, phi = 30, psi = 10 degrees; piecewise linear, so that any
    # step gives it: at 1 % of strain 529.27174 and 164.87691 kPa.
    law = MohrCoulombPlasticity(50e3, 0.2, 10.0, 30 * DEGREE, 10 * DEGREE)
    for steps in (4, 40):
        strains = [(0, -0.01 * n / steps, 0) for n in range(1, steps + 1)]
        found, _ = followed(law, "strain", strains)
        np.testing.assert_allclose(found[-1][:2], [-164.87691, -529.27174], rtol=2e-8)


def test_random_stresses_return_inside_the_pyramid():
    random = np.random.default_rng(3)
    for friction, dilation, cohesion in ((30, 30, 20.0), (35, 0, 0.0), (0, 0, 20.0), (60, 20, 1.0)):
        law = MohrCoulombPlasticity(1e5, 0.4999, cohesion, friction * DEGREE, dilation * DEGREE)
        strain = random.normal(size=(20_000, 3)) * 10 ** random.uniform(-6, -1, (20_000, 1))
        found = law.update(strain, start_of(law, "strain", 20_000), "strain", 0.0)
        xx, yy, xy = found.stress.T
        middle, radius = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
        all_three = np.stack([middle + radius, middle - radius, found.history["stress_zz"][:, 0]])
        high, low = all_three.max(axis=0), all_three.min(axis=0)
        sine, cosine = np.sin(friction * DEGREE), np.cos(friction * DEGREE)
        beyond = (high - low) + (high + low) * sine - 2 * cohesion * cosine
        # Rounding of trials, up to 1e8 kPa at this Poisson's ratio.
        assert (
            beyond <= 1e-9 * (np.abs(all_three).max(axis=0) + 3e8 * np.abs(strain).max(axis=1))
        ).all()
