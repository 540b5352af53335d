"""A notch whose faces touch everywhere opens: a double cantilever beam with a cohesive plane."""

import numpy as np
import pytest

import nmm
from nmm.scene.read import parse_scene
from nmm.verification import text
from nmm.verification.problems.cohesive.double_cantilever import ARM, NOTCH, UNIT, BentByMoments
from nmm.verification.problems.cohesive.double_cantilever import opening as opening_of
from nmm.verification.problems.cracks.crack_scenes import crack


def shut_beam(case: BentByMoments, end: float) -> str:
    """Return the beam of a case with a drawn notch in place of one that is open at its mouth."""
    scene = case.scene().replace("degree = 2", "degree = 1")
    head, rest = scene.split("vertices = ", 1)
    _, rest = rest.split("\n", 1)
    corners = text.rectangle((0.0, -ARM), (0.6, ARM))
    notch = crack("notch", [[-0.01, 0.0], [NOTCH, 0.0]])
    rest = rest.replace("[[cracks]]", f"{notch}[[cracks]]", 1)
    head = head.replace("end = 0.0001", f"end = {end}")
    return f"{head}vertices = {np.asarray(corners).tolist()}\n{rest}"


def test_a_drawn_notch_opens_and_the_crack_ahead_follows_the_closed_form() -> None:
    case = BentByMoments()
    run = nmm.run(parse_scene(shut_beam(case, 3.5e-5)))
    width, moment = opening_of(run), UNIT * run.history["load_factor"]
    assert len(width) > 8
    # Cells of half an arm, of degree 1: the moment swings as the zone passes from one to the next.
    assert moment[2:] == pytest.approx(case.moment(width)[2:], rel=0.022)
    assert abs(run.summary.energy_balance or 0.0) < 1e-4
