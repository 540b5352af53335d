"""Every benchmark problem agrees with its reference, under every formulation it applies to."""

import pytest

from nmm.verification import CASES, judge, runs

# (benchmark, variant, formulation): what is known to be wrong, with figures.
FAULTS: dict[tuple[str, str, str], str] = {}


def marks(case, formulation):
    """Slow cases, and those that are known to fail, with the figures."""
    fault = FAULTS.get((case.name, case.variant, formulation))
    found = [] if fault is None else [pytest.mark.xfail(strict=True, reason=fault)]
    return [*found, pytest.mark.slow] if case.slow else found


RUNS = [
    pytest.param(
        case,
        formulation,
        id=", ".join(filter(None, (case.name, case.variant, formulation))),
        marks=marks(case, formulation),
    )
    for case, formulation in runs(slow=True)
]


@pytest.mark.parametrize(("case", "formulation"), RUNS)
def test_a_benchmark_agrees_with_its_reference(case, formulation):
    outcome = judge(case, formulation)
    assert outcome.passed, "\n" + "\n".join(outcome.lines())
    assert outcome.checks


@pytest.mark.parametrize("name", CASES.table)
def test_a_benchmark_says_what_it_shows_and_where_its_answer_is_from(name):
    kind = CASES.load(name)
    assert kind.name == name
    assert kind.title
    assert kind.source
    variants = [case.variant for case in kind.variants()]
    assert len(set(variants)) == len(variants)
