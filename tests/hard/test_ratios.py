"""Heavy on light, stiff on soft, small under large, thin on thin: forces stay those of statics."""

import numpy as np
import pytest

from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text
from nmm.verification.reading import joint_force, last_way

UP = np.array([0.0, 1.0])


def stack(sizes=((1, 1), (1, 1)), densities=(2600, 2600), moduli=(20e9, 20e9), step=None):
    """Two blocks on each other on a floor, run."""
    (wide, high), (narrow, _) = sizes
    scene = text.scene(
        text.weighty(step),
        [
            text.material("rock"),
            text.material("low", modulus=moduli[0], density=densities[0]),
            text.material("top", modulus=moduli[1], density=densities[1]),
            *text.floor(),
            text.box("lower", (-wide / 2, 0), sizes[0], "low"),
            text.box("upper", (-narrow / 2, high), sizes[1], "top"),
        ],
    )
    found = run(parse_scene(scene))
    assert found.summary.status == "converged", found.summary.sentence
    return found


def pushes(found, sizes=((1, 1), (1, 1))):
    """Forces under the lower and between the blocks; contacts by the blocks they belong to."""
    frame = found.frames[-1]
    high = sizes[0][1]
    between = np.abs(frame.contact_position[:, 1] - high) < high / 2
    force = -frame.contact_force[:, 0]
    return force[~between].sum(), force[between].sum()


def weights(sizes, densities):
    low, top = (
        text.G * rho * width * height for rho, (width, height) in zip(densities, sizes, strict=True)
    )
    return low + top, top


@pytest.mark.parametrize("densities", [(2.6, 2.6e6), (2.6e6, 2.6)])
def test_masses_of_ratio_a_million_rest_on_each_other(densities):
    sizes = ((1, 1), (1, 1))
    found = stack(densities=densities)
    # The residual of the solution is relative to the heavy block: 1e-8 allowed, 1e-15 reached.
    assert pushes(found) == pytest.approx(weights(sizes, densities), rel=1e-8)


@pytest.mark.parametrize("densities", [(2.6, 2.6e6), (2.6e6, 2.6)])
def test_masses_of_ratio_a_million_come_to_rest_in_time(densities):
    found = stack(densities=densities, step=0.01)
    # Twenty steps of Shi's rule leave 3 % of the overshoot of loads put on at once.
    assert pushes(found) == pytest.approx(weights(((1, 1), (1, 1)), densities), rel=0.05)


@pytest.mark.parametrize("moduli", [(20e9, 20.0), (20.0, 20e9)])
def test_stiffnesses_of_ratio_a_billion_carry_each_other(moduli):
    densities = (1e-3, 1e-3)
    found = stack(densities=densities, moduli=moduli)
    assert pushes(found) == pytest.approx(weights(((1, 1), (1, 1)), densities), rel=1e-8)


@pytest.mark.parametrize(
    "sizes",
    [((1, 1), (1e-4, 1e-4)), ((1e-4, 1e-4), (1, 1)), ((1e-4, 1e-4), (1e-4, 1e-4))],
    ids=["small on large", "large on small", "small on small"],
)
def test_blocks_of_size_ratio_ten_thousand_rest_on_each_other(sizes):
    densities = (2600, 2600)
    found = stack(sizes, densities)
    # Each block is in balance by itself to the rounding of its contacts' gaps: 1e-16 m over the
    # penetration of 6e-17 m where a small block rests on a large one that has settled.
    low, top = weights(sizes, densities)
    assert pushes(found, sizes)[0] == pytest.approx(low, rel=1e-6)
    assert pushes(found, sizes)[1] == pytest.approx(top, rel=1e-4)


@pytest.mark.parametrize("height", [1e-3, 1e-4])
def test_strips_of_aspect_up_to_ten_thousand_rest_on_each_other(height):
    sizes = ((1.0, height), (1.0, height))
    found = stack(sizes)
    assert pushes(found, sizes) == pytest.approx(weights(sizes, (2600, 2600)), rel=1e-6)


def bars(moduli, bond):
    """Two bars of 1 m in series, pulled by 1 mPa, joined by a bond of so many Pa/m; run."""
    law = {"cohesion": 1e9, "tensile_strength": 1e9, "bonded": True}
    scene = text.scene(
        'plane = "stress"\n[contact]\n',
        [
            text.material("left", modulus=moduli[0], poisson=0.0, density=None),
            text.material("right", modulus=moduli[1], poisson=0.0, density=None),
            text.interface(
                "bond", 30.0, more=law | {"normal_stiffness": bond, "shear_stiffness": bond}
            ),
            text.box("left", (0, 0), (1, 1), "left"),
            text.box("right", (1, 0), (1, 1), "right"),
            '[[supports]]\nname = "wall"\nsegment = [[0, 0], [0, 1]]\nfix = ["x", "y"]\n',
            '[[loads]]\nname = "pull"\nkind = "edge"\nsegment = [[2, 0], [2, 1]]\n'
            "traction = [1e-3, 0]\n",
            text.monitor("root", (0, 0.5), "left"),
            text.monitor("tip", (2, 0.5), "right"),
        ],
    )
    found = run(parse_scene(scene))
    assert found.summary.status == "converged", found.summary.sentence
    return found


def stretch(found):
    """By how much the bars are longer (m); supports give way by 1e-3 / (1000 E) besides."""
    return (last_way(found, "tip") - last_way(found, "root"))[0]


def test_bars_of_stiffness_ratio_a_billion_in_series():
    """Benchmark A9: u = 1 + 1e-9 for E = 1 and 1e9 under a unit stress; here a thousandth of it.

    The joint between them is as stiff as the stiffer bar.
    """
    found = bars((1.0, 1e9), 1e9)
    assert found.stress[:, 0] == pytest.approx([1e-3, 1e-3], rel=1e-8)
    assert stretch(found) == pytest.approx(1e-3 * (1 + 2e-9), rel=1e-8)


@pytest.mark.parametrize("moduli", [(1.0, 1.0), (1.0, 1e9), (1e9, 1.0)])
@pytest.mark.parametrize("ratio", [1e6, 1e10, 1e13])
def test_a_bond_far_stiffer_than_what_it_joins_carries_the_load(moduli, ratio):
    """Its stretches are known to 1e-16 of the bars' motion: corrections bring the last digits."""
    found = bars(moduli, ratio * min(moduli))
    assert found.stress[:, 0] == pytest.approx([1e-3, 1e-3], rel=1e-8)
    expected = 1e-3 * (1 / moduli[0] + 1 / moduli[1] + 1 / (ratio * min(moduli)))
    assert stretch(found) == pytest.approx(expected, rel=1e-8)
    assert found.summary.steps == 1
    assert "relaxation" not in found.summary.sentence


@pytest.mark.parametrize("level", [0.0, 1.0])
def test_the_side_force_of_a_symmetric_stack_is_zero(level):
    found = stack()
    assert abs(joint_force(found, UP * level, UP)[1]) < 1e-9 * 2600 * text.G
