"""A stress that is there from the start creeps on as if it had come on in an instant."""

import numpy as np
import pytest

import nmm
from nmm.verification import text

E, NU, ETA, WEIGHT, HEIGHT, LASTS = 1e9, 0.25, 1e10, 2e4, 4.0, 100.0


def ground(inertia):
    """A column of Maxwell's matter between smooth walls, in balance under its weight."""
    return nmm.parse_scene(
        f"""plane = "strain"
        duration = {LASTS}
        [materials.salt]
        law = "maxwell"
        young_modulus = {E}
        poisson_ratio = {NU}
        viscosity = {ETA}
        density = {WEIGHT / 10}
        [[blocks]]
        name = "column"
        material = "salt"
        vertices = [[0, 0], [1, 0], [1, {HEIGHT}], [0, {HEIGHT}]]
        {text.fixed_edge("left", ((0, 0), (0, HEIGHT)), "x")}
        {text.fixed_edge("right", ((1, 0), (1, HEIGHT)), "x")}
        {text.fixed_edge("foot", ((0, 0), (1, 0)), "y")}
        [gravity]
        acceleration = [0, -10]
        {inertia}
        [[initial_stresses]]
        block = "all"
        surface = {HEIGHT}
        unit_weight = {WEIGHT}
        ratio = {NU / (1 - NU)!r}
        [[monitors]]
        name = "top"
        point = [0.5, {HEIGHT}]
        [formulation.cover]
        type = "quads"
        size = 1.0
        degree = 2
        [formulation.supports]
        method = "lagrange"
        [formulation.integrator]
        step = 2.0
        """
    )


@pytest.mark.parametrize("inertia", ["", "[inertia]"])
def test_ground_settles_by_its_deviator_in_time_too(inertia):
    """Upright strain is ``s (1 - e^(-l t)) / K``, ``l = K G / (M eta)``, ``s`` its deviator.

    In time the first step of 2 s lost half of its creep, and the run was told unbalanced.
    """
    shear, bulk = E / 2 / (1 + NU), E / 3 / (1 - 2 * NU)
    rate = bulk * shear / (bulk + 4 / 3 * shear) / ETA
    deviator = 2 / 3 * (1 - NU / (1 - NU)) * WEIGHT * HEIGHT**2 / 2
    run = nmm.run(ground(inertia))
    assert run.summary.status == "converged", run.summary.sentence
    expected = -deviator / bulk * (1 - np.exp(-rate * LASTS))
    # Steps of a twelfth of the relaxation are of order two.
    assert run.history["monitor:top:uy"][-1] == pytest.approx(expected, rel=3e-4)
    first = -deviator / bulk * (1 - np.exp(-rate * run.history["time"][3]))
    assert run.history["monitor:top:uy"][3] == pytest.approx(first, rel=1e-2)
