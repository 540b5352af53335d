"""Rows of contact points: a rigid motion of one side changes gap and slip by its own components."""

import numpy as np
import pytest

import nmm
from nmm.contact.points.contact_rows import contact_rows
from nmm.formulation import Formulation
from nmm.stepping.prepare import prepare
from nmm.verification import text

SCENE = text.scene(
    'plane = "stress"\nduration = 1.0\n[gravity]\n[inertia]\n[contact]\n',
    [
        text.material("rock", modulus=1e9),
        text.interface("joint", 20.0),
        text.box("base", (-1, -1), (4, 1)),
        text.box("block", (0, 0), (1, 1)),
        text.fixed_block("base"),
    ],
)


@pytest.mark.parametrize(
    "cover",
    [
        {},
        {"functions": "monomials", "degree": 2},
        {"type": "triangles", "functions": "monomials", "degree": 0, "size": 0.7},
        {"type": "quads", "functions": "monomials", "degree": 1, "size": 0.6},
    ],
)
def test_rows_of_a_rigid_translation_are_normal_and_tangent(cover: dict[str, object]) -> None:
    formulation = Formulation.model_validate({"cover": cover})
    ready = prepare(nmm.parse_scene(SCENE), formulation)
    manifold, contact = ready.stepper.model.manifold, ready.stepper.plan.contact
    assert contact is not None
    points = contact.candidates(ready.start, 1e-6)
    assert len(points) >= 2
    found = contact_rows(points, contact.geometry.sides, ready.start.frames)
    edges = manifold.boundary
    for body in range(manifold.n_bodies):
        sign = (edges.body[points.edge_a] == body) * 1.0 - (edges.body[points.edge_b] == body)
        for axis in range(2):
            motion = manifold.rigid_modes.toarray()[:, 3 * body + axis]
            n = points.normal
            t = np.stack([n[:, 1], -n[:, 0]], axis=1)
            np.testing.assert_allclose(found.normal @ motion, sign * n[:, axis], atol=1e-13)
            np.testing.assert_allclose(found.tangent @ motion, sign * t[:, axis], atol=1e-13)
