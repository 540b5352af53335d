"""Corners that bonds hold on both sides meet nothing but their joints, until these break."""

import numpy as np

import nmm

BOUND = """
plane = "strain"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 2500
[[blocks]]
name = "ground"
material = "rock"
vertices = [[-4, 4], [-4, -2], [6, -2], [6, 0], [0, 0]]
[[blocks]]
name = "wedge"
material = "rock"
vertices = [[0, 0], [0, 2], [-2, 2]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 2], [0, 2]]
[[supports]]
name = "ground"
block = "ground"
fix = ["x", "y"]
[interfaces.joint]
friction_angle = "30 deg"
%s
[gravity]
[contact]
"""
"""A wedge on a slope of 45 degrees; its toe is in the kink, beside a block on the flat."""


BOND = """bonded = true
cohesion = "1 MPa"
tensile_strength = "1 MPa"
"""


def in_the_kink(bond: str) -> np.ndarray:
    """Return the normals (m, 2) of contacts of mere corners with the ground in its kink."""
    frame = nmm.run(nmm.parse_scene(BOUND % bond)).frames[-1]
    there = np.hypot(*frame.contact_position.T) < 1e-3
    return frame.contact_normal[there & (frame.contact_length == 0)]


def test_no_corner_of_a_bonded_net_bears_beside_its_bonds() -> None:
    assert not len(in_the_kink(BOND))


def test_without_bonds_both_corners_in_a_kink_meet_both_of_its_edges() -> None:
    normals = in_the_kink("")
    diagonal = np.sqrt(0.5)
    for edge in ([0.0, 1.0], [diagonal, diagonal]):
        # Blocks turn by some 1e-4.
        assert (np.abs(normals - edge).max(axis=1) < 1e-3).sum() == 2


def test_corners_on_joints_that_do_not_hold_meet_the_other_edge_of_their_kink() -> None:
    """A cohesion of 100 Pa must not take from two blocks what the kink bears of them."""
    normals, diagonal = in_the_kink('cohesion = "100 Pa"'), np.sqrt(0.5)
    for edge in ([0.0, 1.0], [diagonal, diagonal]):
        assert (np.abs(normals - edge).max(axis=1) < 1e-3).sum() == 1
