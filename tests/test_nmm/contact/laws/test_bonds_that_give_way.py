"""A bond that loses its force faster than what is beside it can take up gives way by itself."""

import pytest

import nmm
from nmm.verification import text

AREA = [(name, text.rectangle((k, 0), (k + 1, 1))) for k, name in enumerate(("a", "b", "c"))]


def bond(between, cohesion, stiffness, more=""):
    return (
        f"[interfaces.{''.join(between)}]\nbetween = {list(between)}\nbonded = true\n"
        f"friction_angle = 0\ncohesion = {cohesion}\ntensile_strength = {cohesion}\n"
        f"normal_stiffness = 1e10\nshear_stiffness = {stiffness}\n{more}"
    )


def test_a_weak_bond_leaves_its_load_to_the_strong_one_beside_it():
    """``1e6 + 1e9 * 1e-4 = 1.1e6 N`` is the first peak; at 1.11e6 the strong bond bears all.

    The weak one falls by 5e9 N/m, five times as fast as the strong one of 1e9 N/m takes up.
    Acceleration aimed at the answer behind the peak, and the step was given up at any increment.
    """
    scene = text.scene(
        'plane = "strain"',
        [
            *(text.material(name, 1e12, 0.0) for name, _ in AREA),
            *(text.block(name, name, corners) for name, corners in AREA),
            bond("ab", 1e6, 1e10, 'law = "linear_softening"\nfracture_energy = 100.0\n'),
            bond("bc", 3e6, 1e9),
            text.fixed_block("a"),
            text.fixed_block("c"),
            text.fixed_edge("foot", [(1, 0), (2, 0)], "x"),
            text.fixed_edge("top", [(1, 1), (2, 1)], "x"),
            '[[loads]]\nname = "push"\nkind = "body"\nblock = "b"\ndensity = [0, -1e6]\n',
            "[loading]\nuntil = 1.11\n[contact]\n[formulation.loading]\nincrement = 0.555\n",
            '[formulation.rotation]\nupdate = "small"\n',
            text.monitor("middle", (1.5, 0.5), "b"),
        ],
    )
    run = nmm.run(nmm.parse_scene(scene))
    assert run.summary.status == "converged", run.summary.sentence
    # The block strains by 1e-6 of a metre over the slip of 1.11 mm.
    assert run.history["monitor:middle:uy"][-1] == pytest.approx(-1.11e-3, rel=1e-3)
