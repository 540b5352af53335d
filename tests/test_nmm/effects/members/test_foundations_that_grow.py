"""A foundation along an edge of which blocks arrive and leave: each sinks by its own weight."""

import numpy as np
import pytest

import nmm
from nmm.scene.read import parse_scene

WEIGHT, BEDDING = 2000 * 10.0 * 2.0, 1e7
SUNK = WEIGHT / BEDDING


def beside_each_other(carries, stages, cover="block"):
    """Return two columns of 2 m on one foundation, which sink by 4 mm each under their weight."""
    return parse_scene(f"""
plane = "stress"

[materials.rock]
density = 2000
young_modulus = 1e13
poisson_ratio = 0.0

[[blocks]]
name = "first"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 2], [0, 2]]

[[blocks]]
name = "second"
material = "rock"
vertices = [[1.5, 0], [2.5, 0], [2.5, 2], [1.5, 2]]

[gravity]
acceleration = [0, -10]

[[foundations]]
name = "soil"
segment = [[0, 0], [2.5, 0]]
normal_stiffness = {BEDDING}
shear_stiffness = {BEDDING}
carries = "{carries}"

[[monitors]]
name = "first"
block = "first"
point = [0.5, 1]

[[monitors]]
name = "second"
block = "second"
point = [2, 1]

{stages}

[formulation.cover]
type = "{cover}"
{"size = 0.4" if cover == "triangles" else ""}
""")


ARRIVES = (
    '[[stages]]\nname = "one"\nblocks = ["first"]\n[[stages]]\nname = "two"\nadd = ["second"]\n'
)
LEAVES = '[[stages]]\nname = "one"\n[[stages]]\nname = "two"\nremove = ["second"]\n'
FINER = ARRIVES + '[[stages]]\nname = "finer"\ncover = { size = 0.23 }\n'


@pytest.mark.parametrize("carries", ["both", "compression"])
@pytest.mark.parametrize(
    ("stages", "cover", "second"),
    [
        (ARRIVES, "block", True),
        (ARRIVES, "triangles", True),
        (FINER, "triangles", True),
        (LEAVES, "block", False),
    ],
)
def test_each_block_sinks_by_its_own_weight_whenever_it_arrives(carries, stages, cover, second):
    run = nmm.run(beside_each_other(carries, stages, cover))
    assert run.summary.status == "converged", run.summary.sentence
    first = run.history["monitor:first:uy"]
    assert first[-1] == pytest.approx(-SUNK, rel=1e-4)
    assert first[0] == pytest.approx(-SUNK, rel=1e-4)
    if second:
        assert run.history["monitor:second:uy"][-1] == pytest.approx(-SUNK, rel=1e-4)
    else:
        assert np.isnan(run.history["monitor:second:uy"][-1])
