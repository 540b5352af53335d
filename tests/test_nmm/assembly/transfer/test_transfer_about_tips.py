"""Integrals of a transfer of fields about the tip of a crack."""

import numpy as np
import pytest

from covers.change.parentage import Parentage
from covers.change.transfer import Transfer
from nmm.formulation import Formulation
from nmm.scene import parse_scene
from nmm.stepping.prepare import prepare

SCENE = """
plane = "strain"
[materials.rock]
young_modulus = 1e10
poisson_ratio = 0.25
density = 2600
[[blocks]]
name = "plate"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[cracks]]
name = "k"
points = [[0.0, 0.5], [0.45, 0.5]]
[fracture]
criterion = "hoop_stress"
energy = 100.0
increment = 0.1
[formulation.cover]
type = "quads"
size = 0.13
"""
TIP = np.array([0.45, 0.5])


def test_products_of_strains_about_a_tip_are_integrated():
    scene = parse_scene(SCENE, "scene.toml")
    manifold = prepare(scene, scene.formulation or Formulation()).stepper.model.manifold
    assert np.allclose(manifold.singular, [TIP], atol=1e-12)
    transfer = Transfer.of(Parentage(manifold, manifold), np.ones(len(manifold.elements)))
    found = transfer.area @ (1 / np.hypot(*(transfer.points - TIP).T))
    # Over a rectangle with a corner at the tip: w arcsinh(h / w) + h arcsinh(w / h).
    right = sum(
        w * np.arcsinh(h / w) + h * np.arcsinh(w / h) for w in (0.45, 0.55) for h in (0.5, 0.5)
    )
    # Cells beyond one and a quarter of their diagonals from it have Gauss points.
    assert found == pytest.approx(right, rel=1e-6)
