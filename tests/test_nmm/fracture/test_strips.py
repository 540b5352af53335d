"""Intensities of many cracks, and of cracks beside other matter, in strips with closed forms."""

from collections.abc import Sequence

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

import nmm
from integration.arrays import Floats
from nmm.scene.read import parse_scene
from nmm.verification import text
from nmm.verification.problems.cracks.crack_scenes import crack, net

STILL = "[fracture]\ntoughness = 1e12\nincrement = 1.0\n"
POISSON = 0.3
STIFF = 1 / (1 - POISSON**2)


def intensities(tables: Sequence[str], more: str = "") -> Floats:
    """Return K_I and K_II (n, 2) of all tips of a body of modulus one in plane strain."""
    found, told = judged(tables, more)
    assert not told
    return found


def judged(tables: Sequence[str], more: str = "") -> tuple[Floats, Sequence[str]]:
    """Return the same, and what the run warns of."""
    matter = text.material("m", 1.0, POISSON, None)
    run = nmm.run(parse_scene(text.scene('plane = "strain"', [matter, *tables, STILL + more])))
    fronts = [name.removesuffix(":K_I") for name in run.history if name.endswith(":K_I")]
    found = [[run.history[f"{one}:{k}"][-1] for k in ("K_I", "K_II")] for one in fronts]
    return np.array(found), run.summary.warnings


def driven(name: str, y: float, length: float, fix: str, way: float) -> str:
    """Table of a horizontal edge that is moved."""
    edge = f"segment = [[0, {y}], [{length}, {y}]]\nfix = [{fix}]\ndisplacement = [0, {way}]\n"
    return f'[[supports]]\nname = "{name}"\n{edge}'


def test_ten_tips_of_a_row_of_cracks_have_its_intensity() -> None:
    """sqrt(tan(pi a)) for cracks of 2 a, one a metre (Irwin 1957); rollers stand for all others."""
    row = [crack(f"c{n}", [[n + 0.2, 0.0], [n + 0.8, 0.0]]) for n in range(5)]
    found = intensities(
        [
            text.block("plate", "m", text.rectangle((0, -1.5), (5, 1.5))),
            *row,
            text.pulled_edge("up", [[0.0, 1.5], [5.0, 1.5]], [0.0, 1.0]),
            text.pulled_edge("down", [[0.0, -1.5], [5.0, -1.5]], [0.0, -1.0]),
            text.fixed_edge("left", [[0.0, -1.5], [0.0, 1.5]], "x"),
            text.fixed_edge("right", [[5.0, -1.5], [5.0, 1.5]], "x"),
            text.fixed_point("foot", [0.0, -1.5], "y"),
            net(0.1, 11.0),
        ]
    )
    assert found.shape == (10, 2)
    # Cells of a third of half a crack; 0.06 % on cells of 0.08.
    assert found / np.sqrt(np.tan(0.3 * np.pi)) == pytest.approx(np.tile([1, 0], (10, 1)), abs=3e-3)


@pytest.mark.parametrize("inner", [0.1, 0.4])
def test_two_cracks_on_one_line_have_the_intensities_of_both_in_a_plane(inner: float) -> None:
    """Cracks from ``inner`` to 1 on both sides of the middle (Willmore 1949)."""
    wide, share = 24.0, inner**2
    foci = [[x, 0.0] for x in (-1.0, -inner, inner, 1.0)]
    options = f"[formulation.cover.options]\nfocus = {foci}\nradius = 0.4\ngrowth = 0.2\n"
    found = intensities(
        [
            text.block("plate", "m", text.rectangle((-wide, -wide), (wide, wide))),
            crack("l", [[-1.0, 0.0], [-inner, 0.0]]),
            crack("r", [[inner, 0.0], [1.0, 0.0]]),
            text.pulled_edge("up", [[-wide, wide], [wide, wide]], [0.0, 1.0]),
            text.pulled_edge("down", [[-wide, -wide], [wide, -wide]], [0.0, -1.0]),
            text.fixed_point("left", [-wide, -wide]),
            text.fixed_point("right", [wide, -wide], "y"),
            net(0.1, 11.0, "graded", options),
        ]
    )
    ratio = ellipe(1 - share) / ellipk(1 - share)
    outside = (1 - ratio) * np.sqrt(np.pi / (1 - share))
    inside = (ratio - share) * np.sqrt(np.pi / (inner * (1 - share)))
    expected = [[outside, 0], [inside, 0], [inside, 0], [outside, 0]]
    # A plate 24 times as wide as the cracks has 1e-3 more; cells are as long as the ligament is.
    assert found == pytest.approx(np.array(expected), abs=3e-3 * outside)


FOUR_ALIKE = STIFF / np.sqrt(2)  # stress E' over the root of twice the distance


def parallel(cell: float) -> list[str]:
    """Long cracks one above the other: each frees the energy of a metre of what is ahead of it."""
    return [
        text.block("strip", "m", text.rectangle((0, 0), (6, 4))),
        *(crack(f"c{n}", [[-0.1, n + 0.5], [3.0, n + 0.5]]) for n in range(4)),
        driven("bottom", 0, 6, '"y"', 0),
        driven("top", 4, 6, '"y"', 4),
        text.fixed_point("end", [6.0, 0.0], "x"),
        net(cell, 11.0),
    ]


def test_four_parallel_cracks_free_what_a_strip_stores() -> None:
    found = intensities(parallel(0.15)) / FOUR_ALIKE
    assert found == pytest.approx(np.tile([1, 0], (4, 1)), abs=1e-3)


@pytest.mark.parametrize("cell", [0.5, 1.0])
def test_cracks_beside_a_tip_are_told_before_they_cost_a_percent(cell: float) -> None:
    found, told = judged(parallel(cell))
    assert any("beside a tip" in one for one in told) == (cell == 1.0)
    if not told:
        assert found / FOUR_ALIKE == pytest.approx(np.tile([1, 0], (4, 1)), abs=0.01)


@pytest.mark.parametrize(("height", "radius"), [(1.0, 0.4), (1.0, 0.8), (0.8, 0.4)])
def test_a_crack_between_stiffer_layers_frees_what_they_store(height: float, radius: float) -> None:
    """A strip of three glued layers, clamped and stretched; domains reach beyond the middle one."""
    layers = (("low", "two", 0.0, 0.5), ("mid", "m", 0.5, 1.5), ("high", "two", 1.5, 2.0))
    found = intensities(
        [
            text.material("two", 5.0, 0.2, None),
            *(
                text.block(name, of, text.rectangle((0, low), (8, high)))
                for name, of, low, high in layers
            ),
            '[interfaces.any]\nfriction_angle = "0 deg"\nbonded = true\n',
            crack("c", [[-0.1, height], [4.0, height]]),
            driven("bottom", 0, 8, '"x", "y"', 0),
            driven("top", 2, 8, '"x", "y"', 1),
            net(0.1, 11.0),
        ],
        f"radius = {radius}\n",
    )

    def constrained(modulus: float, ratio: float) -> float:
        return modulus * (1 - ratio) / ((1 + ratio) * (1 - 2 * ratio))

    stress = 1 / (1 / constrained(1.0, POISSON) + 1 / constrained(5.0, 0.2))
    # G = stress / 2 times the stretch of one; both modes where the crack is off the middle.
    assert np.hypot(*found[0]) == pytest.approx(np.sqrt(STIFF * stress / 2), rel=1e-3)
    assert (abs(found[0, 1]) < 1e-5) == (height == 1.0)
