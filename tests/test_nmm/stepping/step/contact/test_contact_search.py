"""How often a step is solved again for pairs that it lets through each other."""

from types import SimpleNamespace

import numpy as np

from nmm.contact.detection.tolerances import CROSSING_SOLUTIONS
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.contact.contact_search import ContactSearch, SoughtContacts


def test_a_step_is_solved_again_for_crossings_a_fixed_number_of_times():
    pair = np.array([3]), np.array([7])
    contact = SimpleNamespace(
        overlooked=lambda contacts, motion: pair, candidates=lambda *given: "contacts"
    )
    current = SimpleNamespace(plan=SimpleNamespace(contact=contact))
    search = ContactSearch(current, None, 1.0, Clock())
    statics = SimpleNamespace(step=None, state=None, inertia=None)
    sought, again = SoughtContacts(0.1, None, None, None), 0
    solved = SimpleNamespace(uncovered=False)
    while (found := search.again(statics, sought, solved, None, motion="seen")) is not None:
        sought, again = found, again + 1
        assert sought.crossings == again
        assert len(sought.crossed[0]) == again
        assert again <= CROSSING_SOLUTIONS
    assert again == CROSSING_SOLUTIONS
