"""Places of points of bodies, compiled, against those by whole arrays."""

import numpy as np
import pytest

from covers.approximation.rows import Rows
from nmm.assembly.material_points import MaterialPoints
from nmm.assembly.state import Frames
from nmm.contact.points.side_kernels import places


@pytest.mark.parametrize("length", [2, 3, 6, 7, 12, 20])
@pytest.mark.parametrize("tilted", [False, True])
def test_places_are_those_of_whole_arrays(length: int, tilted: bool) -> None:
    rng = np.random.default_rng(length)
    bodies, points, n = 5, 40, 30
    body = rng.integers(bodies, size=points)
    rows = Rows(rng.integers(n, size=(points, length)), rng.normal(size=(points, 2, length)))
    material = MaterialPoints(body, rng.normal(size=(points, 2)), rows)
    tilt = rng.normal(size=bodies) if tilted else None
    frames = Frames(rng.normal(size=(bodies, 2)), rng.uniform(-4, 4, bodies), tilt)
    deformation = rng.normal(size=n)
    found = places(
        body,
        material.arm,
        rows.unknowns,
        rows.values,
        frames.centre,
        frames.rotation,
        np.zeros(0) if tilt is None else tilt,
        deformation,
    )
    expected = material.place(frames, deformation)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13)  # sums of up to 20 numbers
