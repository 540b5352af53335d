"""A wedge in a crack whose faces touch at one end: held by both, however little they open."""

import numpy as np
import pytest

from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text

LOW, HIGH, TOP = 0.2, 1.0, 1.2


def wedge_in_crack(half_angle, turn=0.0):
    """Two held blocks with a crack between them, and a wedge that fills it from LOW to HIGH."""
    slope = np.tan(half_angle)
    left = [[-1, 0], [0, 0], [-TOP * slope, TOP], [-1.4, TOP]]
    right = [[0, 0], [1, 0], [1.4, TOP], [TOP * slope, TOP]]
    wedge = [[-LOW * slope, LOW], [LOW * slope, LOW], [HIGH * slope, HIGH], [-HIGH * slope, HIGH]]
    blocks = {"left": left, "right": right, "wedge": wedge}
    return [
        text.block(name, "rock", text.turned(np.array(ring, dtype=float), turn))
        for name, ring in blocks.items()
    ]


@pytest.mark.parametrize("half_angle", [0.001, 0.003, 0.01, 0.02, 0.024, 0.026, 0.05, 0.2])
@pytest.mark.parametrize("order", [[0, 1, 2], [2, 1, 0]])
def test_a_smooth_wedge_presses_both_faces_of_a_crack_by_its_weight_over_its_angle(
    half_angle, order
):
    blocks = wedge_in_crack(half_angle)
    tables = [text.material("rock"), text.interface("smooth", 0.0)]
    tables += [blocks[i] for i in order] + [text.fixed_block("left"), text.fixed_block("right")]
    found = run(parse_scene(text.scene(text.weighty(), tables)))
    assert found.summary.status == "converged", found.summary.sentence
    weight = 2600 * text.G * (HIGH**2 - LOW**2) * np.tan(half_angle)
    frame = found.frames[-1]
    rightward = frame.contact_normal[:, 0] * np.where(frame.contact_position[:, 0] < 0, 1, -1)
    pressed = -found.contact_forces[:, 0]
    # Statics to the tolerance of its balance, over a lever of 1/sin: 1e-8 / 0.001.
    for side in (frame.contact_position[:, 0] < 0, frame.contact_position[:, 0] > 0):
        assert pressed[side].sum() == pytest.approx(weight / (2 * np.sin(half_angle)), rel=1e-5)
    assert np.abs(rightward).min() == pytest.approx(np.cos(half_angle), rel=1e-9)
