"""Paths and loads of a crack that turns, as cells and pieces are halved together."""

import numpy as np
import pytest

import nmm
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.testing.cracked_plates import notched_plate, turned_net
from nmm.verification import text

# As much along the upper edge as across it: the crack leaves its line by 13 degrees.
PULLED = text.pulled_edge("up", [[0, 0.5], [1, 0.5]], [1.0, 1.0])


def grown(piece: float) -> np.ndarray:
    """Return place and load factor (n, 3) of the tip, with cells as long as pieces."""
    keys = f'toughness = 1.0\nincrement = {piece}\nmax_growth = 0.4\ncontrol = "toughness"'
    scene = parse_scene(notched_plate(keys, PULLED))
    h = nmm.run(scene, parse_formulation(turned_net(piece))).history
    return np.stack([h["fracture:notch:end:x"], h["fracture:notch:end:y"], h["load_factor"]], 1)


@pytest.mark.slow  # 15 s
def test_path_and_load_converge_as_cells_and_pieces_are_halved_together() -> None:
    ends = np.array([grown(piece)[-1] for piece in (0.2, 0.1, 0.05)])
    first, then = np.abs(np.diff(ends, axis=0))
    # Order of at least a half: what is left halves in two halvings.
    assert (then < first / np.sqrt(2)).all()
    # If it stays so, what is left is 2.4 times the last change: 1.2 mm of 89 and 1.5e-3 of a load.
    assert then[1] < 1e-3
    assert then[2] < 1e-3 * ends[-1, 2]
