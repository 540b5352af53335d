"""The interface law of `examples/own_interface`, two internal variables, against closed forms."""

import sys
from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.formulation import parse_formulation
from nmm.testing import check_interface_law

FOLDER = Path(__file__).parents[3] / "examples" / "own_interface"
SPRING, STRENGTH, COHESION = 1e10, 2e5, 3e5
PEAK, RESIDUAL, OPENING, WEAR = 0.5, 0.3, 1e-4, 4e-3


@pytest.fixture
def law(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.syspath_prepend(str(FOLDER))
    sys.modules.pop("worn_bond", None)
    from worn_bond import WornBond

    return WornBond(
        friction_angle=PEAK,
        residual_friction_angle=RESIDUAL,
        cohesion=COHESION,
        tensile_strength=STRENGTH,
        bonded=True,
        normal_stiffness=SPRING,
        shear_stiffness=SPRING,
        opening=OPENING,
        wear=WEAR,
    )


def test_it_keeps_what_contact_expects(law):
    check_interface_law(law)


def test_a_path_of_opening_pressing_and_sliding_to_and_fro_has_the_closed_form(law):
    """Open to half, press by p, slide to s and back: ``|T| = c (1 - d) + p (mu - m S)``.

    ``S`` is all that was slid beyond the spring: with the slope ``m`` of friction over it,
    ``|T| (1 - p m / k) = c (1 - d) + p (mu - m (S_0 + path))`` where ``path`` is what the slip
    would slide if the spring were at rest at its end.
    """
    springs = np.array([SPRING]), np.array([SPRING])

    def step(history, gap, slip):
        found = law.update(history, np.array([gap]), np.array([slip]), springs)
        return found.traction[0], found.history

    elastic = STRENGTH / SPRING
    half = elastic / 2 + OPENING / 2
    (pull, shear), history = step(law.initial(np.array([True])), half, 0.0)
    assert (pull, shear) == pytest.approx((STRENGTH / 2, 0.0), rel=1e-12)
    assert history["damage"][0] == pytest.approx(0.5, rel=1e-12)
    (pull, _), history = step(history, half / 2, 0.0)
    assert pull == pytest.approx(STRENGTH / 4, rel=1e-12)

    pressure, peak = 1e6, np.tan(PEAK)
    slope = (np.tan(PEAK) - np.tan(RESIDUAL)) / WEAR
    share = 1 - pressure * slope / SPRING
    pressed = -pressure / SPRING
    (pull, forth), history = step(history, pressed, 1e-3)
    want = (COHESION / 2 + pressure * (peak - slope * 1e-3)) / share
    assert (pull, forth) == pytest.approx((-pressure, want), rel=1e-12)
    slid = history["cumulative_slip"][0]
    assert slid == pytest.approx(1e-3 - want / SPRING, rel=1e-9)
    (_, back), history = step(history, pressed, 0.0)
    want = (COHESION / 2 + pressure * (peak - slope * 2 * slid)) / share
    assert back == pytest.approx(-want, rel=1e-12)
    (_, end), history = step(history, pressed, 1.0)  # friction is residual by now
    # The stress of the spring before it slides is 2e4 times this: so much more rounding.
    assert end == pytest.approx(COHESION / 2 + pressure * np.tan(RESIDUAL), rel=1e-9)


@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
def test_a_shear_box_wears_along_the_closed_form(law, enforcement):
    """2 mm of push: after each increment ``T = c + p (mu - m s)``, ``s`` slid beyond ``T / k``.

    The blocks give way by some 1e-6 of their size, 1e-3 of the push.
    """
    scene = nmm.read_scene(FOLDER / "shear_box.toml")
    formulation = parse_formulation(
        f'[contact]\nenforcement = "{enforcement}"\n[loading]\nincrement = 0.25\n'
    )
    history = nmm.run(scene, formulation, allow_code=["worn_bond"]).history
    pressure, cohesion = 1e6, 2e5
    slope = (np.tan(PEAK) - np.tan(RESIDUAL)) / WEAR
    push = 2e-3 * history["load_factor"]
    sliding = push > 2e-4
    want = (cohesion + pressure * (np.tan(PEAK) - slope * push)) / (1 - pressure * slope / 1e10)
    assert sliding.sum() >= 4
    assert np.abs(history["reaction:push:x"][sliding]) == pytest.approx(want[sliding], rel=1e-3)
