"""Bodies that turn evenly are solved once a step, with forces where they act half way."""

import numpy as np
import pytest

from nmm.contact.solution.steps import ContactSteps
from nmm.formulation import Formulation
from nmm.results.sink import MemorySink
from nmm.scene.model import Scene
from nmm.stepping.prepare import prepare
from nmm.stepping.step.contact.contact_search import ContactSearch

RADIUS, SIDES, TILT, STEP, STEPS = 0.5, 20, 0.35, 1e-3, 100


def _rolled() -> float:
    """Angle (rad) that a wheel of 20 sides has rolled down a slope, from rest on one of them."""
    at = 2 * np.pi * (np.arange(SIDES) + 0.5) / SIDES
    low = RADIUS * np.cos(np.pi / SIDES)
    wheel = np.stack([RADIUS * np.cos(at), RADIUS * np.sin(at) + low], axis=1)
    scene = Scene.model_validate(
        {
            "title": "wheel",
            "plane": "strain",
            "duration": STEPS * STEP,
            "materials": {"rock": {"young_modulus": 1e8, "poisson_ratio": 0.2, "density": 2000.0}},
            "interfaces": {"joint": {"friction_angle": 0.6}},
            "blocks": [
                {
                    "name": "floor",
                    "material": "rock",
                    "vertices": [[-1, -0.5], [1, -0.5], [1, 0], [-1, 0]],
                },
                {"name": "wheel", "material": "rock", "vertices": wheel.tolist()},
            ],
            "supports": [{"name": "ground", "block": "floor", "fix": ["x", "y"]}],
            "gravity": {"acceleration": [9.81 * np.sin(TILT), -9.81 * np.cos(TILT)]},
            "inertia": {},
            "contact": {},
        }
    )
    formulation = Formulation.model_validate({"integrator": {"step": STEP}})
    end = prepare(scene, formulation).run([MemorySink()], lambda stepper, told: None)
    return float(end.frames.angle[1])


def test_a_wheel_that_rolls_is_solved_once_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    solutions, solve = [], ContactSteps.solve

    def counted(contact, *given):
        solutions.append(1)
        return solve(contact, *given)

    monkeypatch.setattr(ContactSteps, "solve", counted)
    angle, once = _rolled(), len(solutions)
    monkeypatch.setattr(ContactSearch, "_ahead", lambda *given: None)
    twice = _rolled()
    assert once < 1.15 * STEPS
    assert len(solutions) - once > 1.5 * STEPS
    # Gaps may be off by 1e-4 of the penetration either way.
    assert angle == pytest.approx(twice, rel=1e-6)
    assert angle < -0.01
