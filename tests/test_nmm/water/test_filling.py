"""What pores that are filled in part take from the flow, and its derivative."""

import numpy as np
import pytest
from scipy.sparse import csr_array

from nmm.water.free_surface import Filling


@pytest.mark.parametrize("wider", [1.0, 4.0])
def test_the_slope_is_the_derivative_of_the_load_whatever_the_width(wider):
    random = np.random.default_rng(2)
    points, unknowns, elements = 40, 6, 5
    owner = random.integers(0, elements, points)
    filling = Filling(
        csr_array(random.random((points, unknowns))),
        random.random(points),
        csr_array(random.random((unknowns, points))),
        1.0 + random.random(elements),
        owner,
        np.ones(points),
    )
    head, way, step = random.random(unknowns), random.normal(size=unknowns), 1e-6
    change = filling.load(head + step * way, wider) - filling.load(head - step * way, wider)
    # Linear between kinks, which none of these points meets within the step.
    np.testing.assert_allclose(-change / (2 * step), filling.slope(head, wider) @ way, rtol=1e-7)
