"""Numbers of the iterations are options: tables of ``[contact.options.iterations]``."""

import numpy as np
import pytest

from nmm.contact.enforcement.base import make_enforcement
from nmm.contact.enforcement.cone import Cone
from nmm.contact.iteration.options import DEFAULT
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.solvers.linear import make_solver
from nmm.testing.contact_oracle import random_problem

TEXT = """
[contact]
enforcement = "cone"
[contact.options.iterations.interior]
boundary = 0.9
[contact.options.iterations.alternation]
wide = 5
slow = { ahead = 20 }
"""


def test_tables_of_a_formulation_reach_the_iterations() -> None:
    method = parse_formulation(TEXT).contact
    made = make_enforcement(method.enforcement, method.options)
    assert isinstance(made, Cone)
    assert made.iterations.interior.boundary == 0.9
    assert made.iterations.alternation.wide == 5
    assert made.iterations.alternation.slow.ahead == 20
    # what is not named keeps its default, in tables within tables too
    assert made.iterations.alternation.slow.below == DEFAULT.alternation.slow.below
    assert made.iterations.rounds == DEFAULT.rounds


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"iterations": {"interior": {"bondary": 0.9}}}, 'did you mean "boundary"'),
        ({"iterations": {"interior": {"boundary": -1.0}}}, "a number > 0"),
        ({"iterations": {"interior": {"boundary": "wide"}}}, "a number"),
        (
            {"iterations": {"inside": {}}},
            "one of alternation, springs, ways, interior, rounds, barrier, memory",
        ),
        ({"iterations": 3}, "a table of options"),
    ],
)
def test_a_wrong_option_is_named_with_its_table(options: dict, said: str) -> None:
    with pytest.raises(FormulationError, match=said) as fault:
        make_enforcement("cone", options)
    assert 'enforcement "cone": iterations' in str(fault.value)


def test_options_change_what_a_step_costs_and_not_its_answer() -> None:
    problem = next(p for p in map(random_problem, range(50)) if p.n_contacts == 4)
    plain = make_enforcement("cone").solve(problem, make_solver())
    options = {"iterations": {"interior": {"boundary": 0.5}, "rounds": {"most": 1}}}
    slow = make_enforcement("cone", options).solve(problem, make_solver())
    assert plain.verdict.converged
    assert slow.verdict.converged
    assert slow.factorisations > plain.factorisations
    # resultants are unique where forces are not: both answers are within 1e-8 of the load
    moved = abs(plain.increment).max()
    assert abs(slow.increment - plain.increment).max() < 1e-6 * moved


def test_a_formulation_says_how_much_is_kept_from_step_to_step() -> None:
    made = make_enforcement("cone", {"iterations": {"memory": {"steps": 3, "factors": 1}}})
    memory = made.memory()
    for number in range(5):
        memory.keep(np.full(3, float(number)), np.array([number]))
    assert [found[0] for found in memory.found] == [4.0, 3.0, 2.0]
    assert make_enforcement("penalty").memory().options == DEFAULT.memory


def test_patience_grows_with_the_price_of_a_factorisation():
    from nmm.contact.iteration.options.budgets import Patience
    from nmm.contact.iteration.options.springs import AlternationOptions

    options = AlternationOptions(usual=600.0)
    # by hand: the root of four and of a hundred times as many unknowns, never below one
    assert [options.size(n) for n in (12, 600, 2400, 60_000)] == [1.0, 1.0, 2.0, 10.0]
    assert Patience(10.0, 1e-3, 4).longer(2.0, 3.0) == Patience(60.0, 1e-3 / 8, 8)
    assert Patience(10.0, 1e-3, 4).longer(1.0, 1.0) == Patience(10.0, 1e-3, 4)
