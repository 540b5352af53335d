"""Energy that goes as blocks split under contact is told where it counts."""

import pytest

import nmm
from nmm.verification import text

STRUCK = text.scene(
    'plane = "stress"\nduration = "1.6 ms"\n[contact]\n[inertia]\n',
    [
        text.material("rock", 1e9, 0.0, 2000.0),
        text.material("hard", 1e10, 0.0, 4000.0),
        text.interface("any", 20.0),
        text.box("plate", (0, 0), (1, 0.5), "rock"),
        text.box("hammer", (1.0001, 0.1), (0.3, 0.3), "hard"),
        '[[initial_velocities]]\nblock = "hammer"\nvelocity = [-9, 0]\n',
        "[splitting.rock]\ntensile_strength = 2e6\ncohesion = 1e6\nfriction_angle = 0.5\n"
        "smallest_block = 0.08\n",
    ],
)
"""A plate whose pieces are pressed together by a blow, and split again while they are."""


@pytest.mark.parametrize(("penalty", "told"), [(0.1, True), (1.0, False)])
def test_energy_of_soft_contacts_that_goes_as_their_faces_are_cut_is_told(penalty, told):
    """A force on a face that is cut is shared by more springs, which hold less energy with it."""
    numbers = f"[formulation.contact]\nnormal_penalty = {penalty}\n"
    numbers += '[formulation.integrator]\ntype = "newmark"\nstep = "20 us"\n'
    run = nmm.run(nmm.parse_scene(STRUCK + numbers, "scene"))
    assert len(run.summary.changes) > 1
    assert any("split_energy" in warning for warning in run.summary.warnings) == told
