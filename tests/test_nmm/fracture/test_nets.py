"""Paths and loads of growing cracks in nets that are turned and shifted at random."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pytest

import nmm
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.testing.cracked_plates import PULLED, notched_plate, turned_net
from nmm.verification import text
from nmm.verification.problems.cracks.crack_paths import force
from nmm.verification.problems.cracks.crack_scenes import crack

RULE = 'toughness = 1.0\nincrement = 0.05\nmax_growth = 0.3\ncontrol = "toughness"'
# Cells across a body of one metre, twice the length of pieces.
SIZE = 0.1


@dataclass(frozen=True)
class Nets:
    """A scene and its fronts."""

    scene: str
    fronts: Sequence[str]


def beam() -> str:
    """Return a beam of 4.4 m under three forces, with a notch half way to a support."""
    return text.scene(
        'plane = "strain"',
        [
            text.material("m", 1.0, 0.3, None),
            text.box("beam", (-2.2, 0), (4.4, 1), "m"),
            crack("notch", [[-1.0, -0.1], [-1.0, 0.3]]),
            force("push", [0.0, 1.0], -1.0),
            text.fixed_point("left", [-2.0, 0.0]),
            text.fixed_point("right", [2.0, 0.0], "y"),
            f"[fracture]\n{RULE}\n",
        ],
    )


def two_cracks() -> str:
    """Return a plate that is pulled along y, with a crack from either side, one above the other."""
    return text.scene(
        'plane = "strain"',
        [
            text.material("m", 1.0, 0.3, None),
            text.box("plate", (0, -1), (1, 2), "m"),
            crack("left", [[-0.1, 0.15], [0.25, 0.15]]),
            crack("right", [[1.1, -0.15], [0.75, -0.15]]),
            text.pulled_edge("up", [[0.0, 1.0], [1.0, 1.0]], [0.0, 1.0]),
            text.pulled_edge("down", [[0.0, -1.0], [1.0, -1.0]], [0.0, -1.0]),
            text.fixed_point("lower", [1.0, -1.0]),
            text.fixed_point("other", [0.0, -1.0], "y"),
            f"[fracture]\ntogether = 0.05\n{RULE}\n",
        ],
    )


ASIDE = notched_plate(RULE, PULLED.replace("[0, 1.0]", "[0.7, 1.0]"))
SCENES = {
    "plate pulled aside": Nets(ASIDE, ["notch:end"]),
    "beam with a notch aside": Nets(beam(), ["notch:end"]),
    "plate with two cracks": Nets(two_cracks(), ["left:end", "right:end"]),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_path_and_load_depend_on_no_turn_or_shift_of_the_net(name: str) -> None:
    """Twenty nets, pieces of half a cell; half a cell is asked for."""
    draw, nets = np.random.default_rng(7), SCENES[name]
    scene = parse_scene(nets.scene)
    paths, loads = [], []
    for angle, shift in zip(draw.uniform(0, np.pi / 3, 20), draw.random((20, 2)), strict=True):
        how = parse_formulation(turned_net(SIZE, float(angle), shift.tolist()))
        history = nmm.run(scene, how).history
        ends = [[history[f"fracture:{one}:{axis}"] for axis in "xy"] for one in nets.fronts]
        paths.append(ends)
        loads.append(history["load_factor"])
    off = np.hypot(*np.moveaxis(np.array(paths) - np.mean(paths, axis=0), 2, 0))
    # Measured 3.4e-5, 1.6e-5 and 2.2e-5 m, and 1.3e-4 of the mean load.
    assert off.max() < 2e-4
    assert loads == pytest.approx(np.tile(np.mean(loads, axis=0), (20, 1)), rel=1e-3)
