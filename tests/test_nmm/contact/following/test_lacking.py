"""Steps of a path that are no solution say whether balance or the path equation is at fault."""

import numpy as np

from nmm.contact.following.path_problem import PathStep
from nmm.contact.laws.tractions import ContactForces


def lacking(residual: float, short: float) -> str:
    none = np.zeros(0)
    contacts = ContactForces(np.zeros((0, 2)), {}, lambda: np.zeros((0, 2, 2)))
    return PathStep(none, 0.0, contacts, none, none, none, residual, short).lacking


def test_a_step_in_balance_short_of_its_target_is_not_said_to_be_out_of_balance() -> None:
    assert lacking(0.0, 1.5e-3) == "in balance, and short of the step by 0.15 %"
    assert lacking(0.2, 1.5e-3) == "out of balance by 2.0e-01"
