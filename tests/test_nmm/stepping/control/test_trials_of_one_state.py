"""Trials along a path: from one state they share what is posed, and each answers as if alone."""

from pathlib import Path

import numpy as np

import nmm
from nmm.controls.path_equation import PathEquation
from nmm.formulation import Formulation
from nmm.stepping.prepare import prepare
from nmm.stepping.step.contact.contact_search import ContactSearch

BAR = Path(__file__).parents[4] / "examples" / "snap_back" / "bar.toml"


def test_trials_from_one_state_seek_contacts_once_and_answer_as_each_alone(monkeypatch):
    scene = nmm.read_scene(BAR)
    made = prepare(scene, Formulation.model_validate(scene.formulation or {}))
    stepper, state, sought = made.stepper, made.start, []
    candidates = ContactSearch.candidates

    def counted(search, *given):
        sought.append(given)
        return candidates(search, *given)

    def trial(change):
        load = stepper.plan.unit_load(state)
        return stepper.along(state, PathEquation(load, 0 * load, 1.0, change))

    monkeypatch.setattr(ContactSearch, "candidates", counted)
    loads = (2e-3, 1e-3, 5e-4)
    together = [trial(load) for load in loads]
    assert len(sought) == 1
    for load, shared in zip(loads, together, strict=True):
        stepper.forget()
        alone = trial(load)
        assert alone.state.load_factor == shared.state.load_factor == load
        # The same equations: to rounding.
        np.testing.assert_allclose(alone.increment, shared.increment, rtol=1e-12)
    assert len(sought) == 4
