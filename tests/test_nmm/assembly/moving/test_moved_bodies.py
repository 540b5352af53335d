"""Bodies moved by compiled code, against the same in whole arrays."""

import numpy as np
import pytest

from covers.approximation.block_manifold import block_manifold
from covers.approximation.uncut import uncut
from covers.local_functions.polynomials import LocalFunctions, Monomials, RigidStrain
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.assembly.moving import motion, moved_bodies
from nmm.assembly.state import State, initial_frames
from nmm.frozen import with_parts
from nmm.materials.elastic import Elastic

SQUARES = [np.array([[1.0, 1], [3, 1], [3, 2], [1, 2]]) + shift for shift in (0.0, 4.0)]


@pytest.mark.parametrize("functions", [RigidStrain(), Monomials(1)])
def test_compiled_code_moves_bodies_as_whole_arrays_do(functions: LocalFunctions) -> None:
    manifold = block_manifold(Polygons.from_vertices(SQUARES), np.arange(2), functions)
    stiffness = np.tile(Elastic(1.0, 0.2).stiffness("stress"), (2, 1, 1))
    model = Model(manifold, stiffness, np.ones(2), np.ones(2), 1.0, uncut(manifold))
    draw, n = np.random.default_rng(3).normal, manifold.n_unknowns
    frames = with_parts(initial_frames(manifold), angle=draw(size=2))
    state = State(1.0, 0.5, frames, draw(size=n), draw(size=n), draw(size=n))
    increment = draw(size=n)
    expected = motion.move(model, state, increment)
    found = moved_bodies.move(model, state, increment)
    assert (found.time, found.load_factor) == (1.0, 0.5)
    pairs = [(getattr(found, name), getattr(expected, name)) for name in RATES]
    pairs += [(getattr(found.frames, name), getattr(expected.frames, name)) for name in PLACES]
    for one, other in pairs:
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-14)  # sums of six numbers near 1


RATES = "deformation", "velocity", "acceleration"
PLACES = "centre", "way", "angle", "rotation", "turn"
