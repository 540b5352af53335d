"""Motion of bodies: exact rotation, carried deformation, velocities that keep their direction."""

from dataclasses import replace

import numpy as np
import pytest

from covers.approximation.block_manifold import block_manifold
from covers.approximation.uncut import uncut
from covers.local_functions.polynomials import LocalFunctions, Monomials, RigidStrain
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.material_points import vertex_points
from nmm.assembly.model import Model
from nmm.assembly.moving.motion import move
from nmm.assembly.state import State, initial_state
from nmm.materials.elastic import Elastic

SQUARE = np.array([[1.0, 1.0], [3.0, 1.0], [3.0, 2.0], [1.0, 2.0]])


def model(functions: LocalFunctions) -> Model:
    manifold = block_manifold(
        Polygons.from_vertices([SQUARE]), np.zeros(1, dtype=np.int64), functions
    )
    stiffness = Elastic(1.0, 0.2).stiffness("stress")[None]
    return Model(
        manifold,
        stiffness,
        np.ones(1),
        np.ones(1),
        1.0,
        uncut(manifold),
    )


def place(one: Model, state: State) -> Floats:
    return vertex_points(one.manifold).place(state.frames, state.deformation)


@pytest.mark.parametrize("functions", [RigidStrain(), Monomials(1), Monomials(2)])
def test_a_rotation_of_any_size_keeps_shape_and_strain(functions: LocalFunctions) -> None:
    one = model(functions)
    turn = one.manifold.rigid_modes.toarray()[:, 2]
    state = initial_state(one.manifold)
    for _ in range(4):
        state = move(one, state, np.pi / 6 * turn)
    angle = 4 * np.pi / 6
    c, s = np.cos(angle), np.sin(angle)
    centre = SQUARE.mean(axis=0)
    expected = centre + (SQUARE - centre) @ np.array([[c, s], [-s, c]])
    # 1e-12: rounding of four turns of coordinates near 3.
    np.testing.assert_allclose(place(one, state), expected, atol=1e-12)
    np.testing.assert_allclose(one.mean_strain(state.deformation), 0, atol=1e-14)


def test_strain_before_a_turn_is_carried_with_the_body() -> None:
    one = model(RigidStrain())
    stretch = np.array([0, 0, 0, 0.01, 0, 0.0])
    turn = np.array([0, 0, np.pi / 2, 0, 0, 0.0])
    state = move(one, move(one, initial_state(one.manifold), stretch), turn)
    corners = place(one, state)
    # The long side of 2 m, stretched by 1 %, now stands upright.
    assert np.ptp(corners[:, 1]) == pytest.approx(2.02, rel=1e-13)
    assert np.ptp(corners[:, 0]) == pytest.approx(1.0, rel=1e-13)
    polygon = one.manifold.elements.with_points(corners)
    assert polygon.areas[0] == pytest.approx(2.02, rel=1e-13)


def test_translation_keeps_its_direction_in_space_while_the_body_turns() -> None:
    one = model(Monomials(2))
    modes = one.manifold.rigid_modes.toarray()
    velocity = modes @ np.array([3.0, 4.0, 0.5])
    state = replace(initial_state(one.manifold), velocity=velocity)
    state = move(one, state, 1.0 * modes[:, 2])
    rates = one.rigid_projection @ state.velocity
    body_axes = np.array([[np.cos(1.0), np.sin(1.0)], [-np.sin(1.0), np.cos(1.0)]])
    np.testing.assert_allclose(rates[:2], body_axes @ [3.0, 4.0], atol=1e-13)
    assert rates[2] == pytest.approx(0.5, rel=1e-13)


def test_rigid_projection_recovers_a_rigid_motion_and_sees_no_strain() -> None:
    one = model(RigidStrain())
    np.testing.assert_allclose(
        one.rigid_projection @ np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])[:, None],
        # A symmetric strain of a rectangle about its centroid has a mean rotation of
        # (Sxx - Syy) / (Sxx + Syy) gxy / 2 in the least-squares sense; Sxx = 8/12, Syy = 2/12.
        [[1.0], [2.0], [3.0 + (8 - 2) / (8 + 2) * 0.15]],
        rtol=1e-13,
    )
