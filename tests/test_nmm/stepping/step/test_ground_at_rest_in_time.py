"""Ground under its weight and the stress that balances it stands still in time, on any cover."""

import numpy as np
import pytest

import nmm
from nmm.verification import text

WEIGHT = 25e3
BONDED = {"bonded": True, "cohesion": 1e9, "tensile_strength": 1e9}
LAYERS = [text.box(f"layer {y}", (0, y), (2, 1)) for y in range(4)]
HELD = [
    f'[[supports]]\nname = "{name}"\nsegment = {segment}\nfix = ["{axis}"]\n'
    for name, segment, axis in (
        ("base", [[0, 0], [2, 0]], "y"),
        ("left", [[0, 0], [0, 4]], "x"),
        ("right", [[2, 0], [2, 4]], "x"),
    )
]
GROUND = text.scene(
    'plane = "strain"\nduration = 0.01\n[inertia]\n[gravity]\n',
    [
        text.material("rock", 1e9, 0.2, WEIGHT / text.G),
        text.interface(
            "seam", 40.0, more={"bonded": True, "cohesion": 1e9, "tensile_strength": 1e9}
        ),
        *LAYERS,
        *HELD,
        '[[initial_stresses]]\nblock = "all"\nsurface = 4.0\nratio = 0.4\n'
        f"unit_weight = {WEIGHT}\n",
    ],
)


@pytest.mark.parametrize("contact", ["", "[contact]\n"])
@pytest.mark.parametrize(
    ("cover", "degree", "integrator"),
    [("triangles", 1, "newmark"), ("quads", 2, "shi"), ("graded", 1, "generalized_alpha")],
)
def test_ground_in_balance_stands_still(cover, degree, integrator, contact):
    table = {
        "cover": {"type": cover, "size": 0.7, "degree": degree},
        "integrator": {"type": integrator, "step": 1e-3},
    }
    found = nmm.run(nmm.parse_scene(GROUND + contact), nmm.Formulation.model_validate(table))
    assert found.summary.status == "converged", found.summary.sentence
    # Weight that nothing balanced would press it together by some 0.2 mm.
    assert np.abs(found.displacement).max() < 1e-12


def test_steps_chosen_by_their_error_do_not_follow_rounding():
    table = {
        "cover": {"type": "quads", "size": 0.7, "degree": 1},
        "integrator": {"type": "newmark", "step": "auto"},
        "loading": {"max_steps": 200},
    }
    joints = "normal_stiffness = 1e9\ncohesion = 0.0\ntensile_strength = 0.0\n"
    bonded = "bonded = true\ncohesion = 1000000000.0\ntensile_strength = 1000000000.0\n"
    jointed = GROUND.replace(bonded, joints) + "[contact]\n"
    assert jointed.count(joints) == 1
    found = nmm.run(nmm.parse_scene(jointed), nmm.Formulation.model_validate(table)).summary
    assert (found.status, list(found.warnings)) == ("converged", [])


@pytest.mark.parametrize("degree", [1, 2])
def test_a_body_in_balance_stands_still_beside_contact_that_nothing_makes(degree):
    ring = [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]
    sides = [
        f'[[supports]]\nname = "{i}"\nsegment = {ring[i : i + 2]}\nfix = ["x", "y"]\n'
        for i in range(4)
    ]
    laid = '[[initial_stresses]]\nblock = "all"\nstress = [-1e6, -2e6, 1e5]\n'
    matter = [text.material("rock", 1e9, 0.2), text.interface("any", 35.0)]
    scene = text.scene(
        'plane = "strain"\nduration = 0.01\n[inertia]\n[contact]\n',
        [*matter, text.box("body", (0, 0), (2, 2)), laid, *sides],
    )
    table = {"cover": {"type": "quads", "size": 0.5, "degree": degree}}
    found = nmm.run(nmm.parse_scene(scene), nmm.Formulation.model_validate(table))
    # All that acts is the rounding of stresses that cancel.
    assert found.summary.status == "converged", found.summary.sentence
    assert np.abs(found.displacement).max() < 1e-12
