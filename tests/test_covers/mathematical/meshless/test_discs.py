"""Covers of discs: kernels, weights, congruent cells."""

import numpy as np
import pytest

from covers.mathematical.meshless.kernels import KERNELS
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from nmm.testing.covers import random_points


@pytest.mark.parametrize("name", KERNELS)
def test_kernels_vanish_with_their_slope_at_the_rim_and_differ_by_their_slope(name):
    kernel = KERNELS[name]
    r = np.linspace(0.01, 0.99, 50)
    slope = (kernel(r + 1e-6)[0] - kernel(r - 1e-6)[0]) / 2e-6
    np.testing.assert_allclose(kernel(r)[1], slope, atol=1e-8)
    for value in kernel(np.array([1.0, 1.5])):
        np.testing.assert_allclose(value, 0, atol=1e-15)


def test_shepard_weights_are_positive():
    cover = MovingLeastSquares.regular([[0.0, 0.0], [2.0, 1.0]], 0.2, degree=0)
    assert (cover.weights(*random_points(cover, 500)) >= 0).all()


def test_collinear_discs_do_not_determine_a_linear_fit():
    net = Quads.regular([[0, 0], [1, 1]], 1.0)
    nodes = np.array([[0.3, 0.5], [0.5, 0.5], [0.7, 0.5]])
    cover = MovingLeastSquares.on_cells(nodes, np.ones(3), net.vertices, net.cell_vertices)
    with pytest.raises(ValueError, match="do not determine a fit"):
        cover.weights(np.zeros(1, dtype=np.int64), np.array([[0.4, 0.3]]))


def test_cells_that_other_discs_touch_are_not_congruent() -> None:
    cover = MovingLeastSquares.regular([[1e5, 1e5], [1e5 + 1, 1e5 + 1]], 0.1, degree=1)
    shapes = [np.flatnonzero(cover.cell_shape == one) for one in np.unique(cover.cell_shape)]
    assert len(shapes) > 1
    for cells in shapes:
        first = cover.vertices[cover.cell_vertices[cells, 0]]
        away = cover.patch_centre[cover.cell_patches[cells]] - first[:, None]
        here = cover.cell_patches[cells] >= 0
        assert (here == here[0]).all()
        assert np.abs((away - away[0])[here]).max() < 1e-9
