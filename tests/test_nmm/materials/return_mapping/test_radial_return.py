"""Radial return: points that stay elastic are Hooke's, whatever others do beside them."""

import numpy as np

from nmm.materials.return_mapping.radial_return import radial_return

CONSTANTS = (200e9, 0.3, 250e6, 1e9)


def test_elastic_points_answer_alone_as_beside_one_that_flows():
    draws = np.random.default_rng(3)
    strain = 1e-4 * draws.normal(size=(6, 3))
    strain[-1] = [0.01, 0.0, 0.0]
    plastic, accumulated = np.zeros((6, 4)), np.zeros(6)
    both = radial_return(strain, plastic, accumulated, CONSTANTS)
    alone = radial_return(strain[:5], plastic[:5], accumulated[:5], CONSTANTS)
    assert both.accumulated[-1] > 0
    assert not both.accumulated[:5].any()
    # The same numbers, but for the order in which the tangent's two parts are added.
    for name in ("stress", "plastic_strain", "accumulated"):
        np.testing.assert_array_equal(getattr(both, name)[:5], getattr(alone, name))
    np.testing.assert_allclose(both.tangent[:5], alone.tangent, rtol=1e-14, atol=1e-5)
    # Hooke's law in plane strain.
    e, nu = CONSTANTS[:2]
    rigid = e / (1 + nu) / (1 - 2 * nu)
    exact = rigid * np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, (1 - 2 * nu) / 2]])
    np.testing.assert_allclose(alone.tangent[0], exact, rtol=1e-12, atol=1e-3)
    np.testing.assert_allclose(alone.stress[:, :3], strain[:5] @ exact, rtol=1e-10, atol=1.0)
