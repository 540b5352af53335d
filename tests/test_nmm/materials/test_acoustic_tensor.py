"""Determinants of acoustic tensors, against closed forms of Mohr-Coulomb's in the plane."""

import numpy as np
import pytest

from nmm.materials.acoustic_tensor import Determinants
from nmm.materials.elastic import Elastic
from nmm.materials.mohr_coulomb import MohrCoulombPlasticity
from nmm.materials.von_mises import VonMisesPlasticity

E, NU = 1e7, 0.3
SHEAR = E / 2 / (1 + NU)


def flowing(law, way):
    """Tangent (3, 3) of a first step of strain ``way`` from rest."""
    start = {name: value[None] for name, value in law.variables("strain").items()}
    return law.update(np.array([way]), start, "strain", 0.0).tangent


def coulomb(phi, psi):
    return MohrCoulombPlasticity(E, NU, 1e3, np.radians(phi), np.radians(psi))


def test_elastic_matter_has_the_product_of_its_two_moduli_of_waves():
    """``G (lambda + 2 G)``, of shear and of pressure, in every direction."""
    found = Determinants.of(Elastic(E, NU).stiffness("strain")[None])
    pressure = E * (1 - NU) / (1 + NU) / (1 - 2 * NU)
    assert found.at(np.linspace(0, 3, 7))[0] == pytest.approx(SHEAR * pressure, rel=1e-12)


def test_determinants_are_those_of_the_tensor_of_each_normal():
    """Of tangents at random, against the product written out (brute force)."""
    tangent = np.random.default_rng(3).normal(size=(4, 3, 3))
    angles = np.linspace(0.1, 3, 9)
    for k, angle in enumerate(angles):
        c, s = np.cos(angle), np.sin(angle)
        rows = np.array([[c, 0], [0, s], [s, c]])
        expected = [np.linalg.det(rows.T @ one @ rows) for one in tangent]
        np.testing.assert_allclose(Determinants.of(tangent).at(angles)[:, k], expected, atol=1e-12)
    least, _ = Determinants.of(tangent).least()
    fine = Determinants.of(tangent).at(np.linspace(0, np.pi, 20_001)).min(axis=1)
    np.testing.assert_allclose(least, fine, atol=1e-6)


@pytest.mark.parametrize(("phi", "psi"), [(30, 0), (40, 10), (30, 20)])
def test_bands_of_mohr_coulomb_begin_between_the_angles_of_coulomb_and_roscoe(phi, psi):
    """Least at ``45 + (phi + psi) / 4`` about, of ``(sin phi - sin psi)^2`` over all that flows.

    The incompatible part of a strain alone resists: ``E / (1 - nu^2) (t a t) (t b t)`` over
    ``a : D : b`` with the gradients of yield and flow, along the band ``t``. It is nothing at
    45 degrees and half of either angle (Vermeer 1982), and least where ``cos 2 theta`` is the mean
    of both sines.
    """
    sines = np.sin(np.radians([phi, psi]))
    way = np.array([1.0, -2.0, 0.0])
    major, minor, _ = Elastic(E, NU).stiffness("strain") @ way
    yields = 2e3 * np.cos(np.radians(phi)) / (major - minor + (major + minor) * sines[0])
    # Just beyond: larger steps turn less in their tangent.
    found = Determinants.of(flowing(coulomb(phi, psi), (1 + 1e-8) * yields * way))
    elastic = SHEAR * E * (1 - NU) / (1 + NU) / (1 - 2 * NU)
    least, angle = found.least()
    expected = -((sines[0] - sines[1]) ** 2) / (
        8 * (1 - NU) * (1 + sines[0] * sines[1] / (1 - 2 * NU))
    )
    assert least[0] / elastic == pytest.approx(expected, rel=1e-6)
    # The normal from x, the major principal axis.
    assert abs(np.cos(2 * angle[0])) == pytest.approx(sines.mean(), rel=1e-6)
    ends = np.radians([45 - phi / 2, 45 - psi / 2])
    np.testing.assert_allclose(found.at(ends)[0] / elastic, 0, atol=1e-9)


@pytest.mark.parametrize(
    "law", [coulomb(30, 30), coulomb(0, 0), VonMisesPlasticity(E, NU, 1e3)], ids=str
)
def test_associated_flow_loses_nothing(law):
    """Tangents that are symmetric and no less than zero have no determinant below zero."""
    least, _ = Determinants.of(flowing(law, [1e-3, -2e-3, 5e-4])).least()
    assert least[0] > -1e-12 * E**2
