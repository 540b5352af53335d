"""Cables across a joint that opens: their forces by balance, the opening by their stretch."""

from pathlib import Path

import numpy as np
import pytest

import nmm

SCENE = Path(__file__).parents[2] / "examples/prestressed_joint/joint.toml"
QUADS = {"type": "quads", "size": 0.5, "degree": 1}
WEIGHT, PRESTRESS = 2500 * 9.81 * 3, 1e5  # N
STIFFNESS = 195e9 * np.pi * 0.015**2  # E A of a cable (N)


def opened(cover):
    scene = nmm.read_scene(SCENE)
    table = {"loading": {"increment": 0.25}} | ({"cover": cover} if cover else {})
    return nmm.run(scene, nmm.formulation.Formulation.model_validate(table))


@pytest.mark.parametrize("cover", [None, QUADS], ids=["block", "quads"])
def test_cables_carry_what_the_clamping_no_longer_does(cover):
    run = opened(cover)
    assert run.summary.status == "converged"
    lift, history = 6e5 * run.history["load_factor"], run.history
    forces = np.array([history[f"bars:{name}:force"] for name in ("left", "right")])
    gap = history["monitor:cap:uy"] - history["monitor:base:uy"]
    shut = lift < 2 * PRESTRESS + WEIGHT
    assert np.count_nonzero(shut) == 1
    # The clamped blocks and springs of contact give way by 0.3 % of the stretch of the cables.
    np.testing.assert_allclose(forces[:, shut], PRESTRESS, rtol=5e-3)
    # Balance: contact is solved to 1e-8 of the forces.
    exact = (lift - WEIGHT)[~shut] / 2
    np.testing.assert_allclose(forces[:, ~shut], [exact, exact], rtol=1e-6)
    # The cap bends by 5 um between its cables on quads; blocks of one strain do not.
    stretch = (exact - PRESTRESS) * 2.0 / STIFFNESS
    np.testing.assert_allclose(gap[~shut], stretch, atol=1e-6 if cover is None else 2e-5)
