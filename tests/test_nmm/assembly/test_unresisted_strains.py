"""Strains that flowing matter resists with nothing: a trace of elastic stiffness in its tangent."""

import numpy as np

from nmm.assembly.unresisted_strains import TRACE, resisting
from nmm.materials.mohr_coulomb import MohrCoulombPlasticity
from nmm.materials.von_mises import VonMisesPlasticity

FRICTION, DILATION = np.radians(30.0), np.radians(10.0)
# Pressed to 1 % between walls: on the edge where both stresses across are equal.
PRESSED = np.array([[0.0, -0.01, 0.0]])


def oedometer() -> tuple[np.ndarray, np.ndarray]:
    """Tangent and elastic stiffness (1, 3, 3) of soil in an oedometer."""
    soil = MohrCoulombPlasticity(
        young_modulus=50e6,
        poisson_ratio=0.2,
        cohesion=10e3,
        friction_angle=FRICTION,
        dilation_angle=DILATION,
    )
    start = {name: value[None] for name, value in soil.variables("strain").items()}
    tangent = soil.update(PRESSED, start, "strain", 0.0).tangent
    return tangent, soil.stiffness("strain")[None]


def test_an_edge_of_the_pyramid_resists_one_strain_beside_the_turn_of_its_axes() -> None:
    tangent, elastic = oedometer()
    # Along the edge stresses across and along are as 1 to (1 + sin phi) / (1 - sin phi); flow
    # leaves the strain that has no part in both planes: as the same of the dilation angle.
    along, across = ((1 + np.sin(one)) / (1 - np.sin(one)) for one in (FRICTION, DILATION))
    found = tangent[0, :2, :2] / tangent[0, 0, 0]
    np.testing.assert_allclose(found, np.outer([1, along], [1, across]), rtol=1e-12)
    resists = resisting(tangent, elastic)
    free = np.array([across, -1.0, 0.0])
    # The strain that nothing resists meets the trace alone, to rounding of the tangent.
    left = resists[0] @ free / (TRACE * elastic[0] @ free + [0, 0, 1])
    np.testing.assert_allclose(left[:2], 1.0, rtol=1e-6)
    # All else is as it was: to the trace.
    np.testing.assert_allclose(resists, tangent, rtol=0, atol=2 * TRACE * elastic.max())


def test_matter_that_hardens_keeps_its_tangent() -> None:
    steel = VonMisesPlasticity(
        young_modulus=2e11,
        poisson_ratio=0.3,
        yield_stress=250e6,
        hardening_modulus=2e9,
    )
    start = {name: value[None] for name, value in steel.variables("strain").items()}
    tangent = steel.update(PRESSED, start, "strain", 0.0).tangent
    assert resisting(tangent, steel.stiffness("strain")[None]) is tangent
