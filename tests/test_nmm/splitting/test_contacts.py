"""Contacts of a block that splits go on at its pieces; new faces meet without a bond."""

from dataclasses import replace

import numpy as np
import pytest

import nmm
from nmm.splitting.cuts import pieces
from nmm.splitting.division import replaced

PILE = """
title = "pile"
plane = "stress"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [3, -1], [3, 0], [-1, 0]]
[[blocks]]
name = "middle"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[blocks]]
name = "top"
material = "rock"
vertices = [[0.7, 1], [1.6, 1], [1.6, 1.5], [0.7, 1.5]]
[gravity]
acceleration = [0.5, -10]
[contact]
[interfaces.any]
between = "any"
friction_angle = "30 deg"
{bonds}
[[supports]]
name = "held"
block = "floor"
fix = ["x", "y"]
[formulation.contact]
enforcement = "{enforcement}"
"""


def at_rest(enforcement="penalty", bonds=""):
    run = nmm.run(nmm.parse_scene(PILE.format(enforcement=enforcement, bonds=bonds), "scene"))
    assert run.summary.status == "converged", run.summary.sentence
    return run


def split(run, angle):
    """Cut the middle block at an angle (rad)."""
    stepper = run.stepper
    setup = stepper.discretisation.setup
    polygon = setup.geometry.regions.polygons.to_shapely()[1]
    parts = pieces(polygon, np.array([1, 0.5]), [angle])
    found, parent = replaced(setup.geometry.regions.polygons, {1: parts})
    regions = setup.geometry.regions.divided(found, parent)
    return stepper.reshape(replace(setup.geometry, regions=regions), run.state)


def by_floor_and_top(model, points):
    """Sums of normal and shear forces at the floor and under the top block."""
    region = model.manifold.element_region[model.manifold.boundary.element]
    pair = np.sort([region[points.edge_a], region[points.edge_b]], axis=0)
    forces = np.stack([points.normal_force, points.shear_force], axis=1)
    return {which: forces[(which == pair.T).all(axis=1)] for which in ((0, 1), (1, 2))}


@pytest.mark.parametrize("enforcement", ["penalty", "lagrange"])
def test_contacts_of_faces_that_stay_keep_their_forces_point_by_point(enforcement):
    """A cut parallel to the floor leaves the faces at floor and top as they are."""
    run = at_rest(enforcement)
    before = by_floor_and_top(run.stepper.model, run.stepper.plan.contact.standing)
    change = split(run, 0.0)
    after = by_floor_and_top(change.new, run.stepper.plan.contact.standing)
    for which, forces in before.items():
        assert len(forces) >= 2
        assert np.abs(forces).max() > 1e3
        order, other = (np.lexsort(one.T) for one in (forces, after[which]))
        np.testing.assert_allclose(after[which][other], forces[order], rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("enforcement", ["penalty", "lagrange"])
def test_a_face_that_is_cut_hands_its_whole_force_to_its_parts(enforcement):
    run = at_rest(enforcement)
    before = by_floor_and_top(run.stepper.model, run.stepper.plan.contact.standing)
    change = split(run, np.pi / 2)
    after = by_floor_and_top(change.new, run.stepper.plan.contact.standing)
    for which, forces in before.items():
        np.testing.assert_allclose(after[which].sum(axis=0), forces.sum(axis=0), rtol=1e-6)


def test_new_faces_have_no_bond_though_their_material_is_bonded():
    run = at_rest(bonds='cohesion = "1 MPa"\ntensile_strength = "1 MPa"\nbonded = true')
    broken, bonds = run.stepper.broken_bonds, run.stepper.plan.contact.standing.bonded.sum()
    assert bonds > 0
    change = split(run, 0.0)
    points = run.stepper.plan.contact.standing
    region = change.new.manifold.element_region[change.new.manifold.boundary.element]
    inside = (region[points.edge_a] == 1) & (region[points.edge_b] == 1)
    assert not points.bonded[inside].any()
    assert points.bonded[~inside].sum() == bonds
    assert run.stepper.broken_bonds == broken
