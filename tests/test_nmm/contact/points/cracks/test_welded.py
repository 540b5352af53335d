"""Contacts are of places that some unknown moves apart."""

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

SCENE = """
title = "Plate with a crack"
plane = "strain"

[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2

[interfaces.any]
friction_angle = 0.3

[[blocks]]
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]

[[cracks]]
name = "c"
points = [[0.31, 0.32], [0.52, 0.53], [0.71, 0.52]]

[[supports]]
name = "foot"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]

[contact]
"""
NET = '[cover]\ntype = "triangles"\nsize = 0.1\ndegree = {degree}\nangle = "11 deg"\n{more}'


@pytest.mark.parametrize("degree", [0, 1, 2])
@pytest.mark.parametrize("more", ["", "[cover.enrichment]\ntips = false\n"])
def test_every_contact_of_a_crack_has_a_row_that_moves_its_faces_apart(
    degree: int, more: str
) -> None:
    formulation = parse_formulation(NET.format(degree=degree, more=more))
    ready = prepare(parse_scene(SCENE), formulation)
    contact = ready.stepper.plan.contact
    assert contact is not None
    points = contact.candidates(ready.start, 1e-3)
    rows = contact.geometry.rows(points, ready.start).normal.toarray()
    largest = np.abs(rows).max(axis=1)
    assert len(points) > 10
    # Rows are of the order of the functions; those of one place would be 1e-16 of it.
    assert (largest > 1e-3 * np.median(largest)).all()
