"""Heat that is stored leaves with the blocks that hold it."""

import numpy as np
import pytest

import nmm

FLUX, HEATS, CAPACITY, CONDUCTS = 100.0, 1e5, 1e6, 10.0

SCENE = f"""plane = "stress"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0
density = 1000
heat_capacity = {CAPACITY / 1000}
conductivity = {CONDUCTS}
thermal_expansion = 1e-5
[interfaces.joint]
friction_angle = 0.5
conductance = "perfect"
[[blocks]]
name = "stays"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "leaves"
material = "rock"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[supports]]
name = "wall"
segment = [[0, 0], [0, 1]]
fix = ["x"]
[[supports]]
name = "pin"
point = [0, 0]
fix = ["y"]
[heat]
transient = true
initial = 0
duration = {HEATS}
[[heat_fluxes]]
name = "sun"
segment = [[0, 0], [0, 1]]
flux = {FLUX}
[[monitors]]
name = "end"
point = [1, 0.5]
block = "stays"
[[stages]]
name = "heated"
[[stages]]
name = "cut"
remove = ["leaves"]
heat = []
[formulation.cover]
type = "quads"
size = 0.125
degree = 1
[formulation.loading]
increment = 0.025
"""


def warmth(x):
    """Temperature of a slab of 2 m under the flux at x = 0 (Carslaw and Jaeger 1959, 3.8)."""
    length, time = 2.0, CONDUCTS / CAPACITY * HEATS
    away = (length - x) / length
    series = sum(
        (-1) ** n / n**2 * np.exp(-time * (n * np.pi / length) ** 2) * np.cos(n * np.pi * away)
        for n in range(1, 60)
    )
    return (
        FLUX / CONDUCTS * (time / length + length * ((3 * away**2 - 1) / 6 - 2 / np.pi**2 * series))
    )


def test_heat_leaves_with_a_block_and_the_balance_says_so():
    run = nmm.run(nmm.parse_scene(SCENE))
    assert run.summary.status == "converged", run.summary.sentence
    found = run.history
    middles = (np.arange(1000) + 0.5) / 1000
    stays, leaves = (CAPACITY * warmth(middles + x).mean() for x in (0.0, 1.0))
    assert stays + leaves == pytest.approx(FLUX * HEATS, rel=1e-6)
    # Of order 1 in 40 steps; what is stored stretches the block by the mean temperature.
    assert found["heat:stored"][-1] == pytest.approx(stays, rel=5e-3)
    mean = found["monitor:end:ux"][-1] / 1e-5  # of its middle, as warmth still evens out
    assert found["heat:stored"][-1] == pytest.approx(CAPACITY * mean, rel=1e-5)
    assert found["heat:taken:blocks"][-1] == pytest.approx(-leaves, rel=2e-2)
    assert run.summary.audits["field_imbalance"] < 1e-12
