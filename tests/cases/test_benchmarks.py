"""Every benchmark problem agrees with its reference, under every formulation it applies to."""

import pytest

from nmm.verification import CASES, judge, runs

# (benchmark, variant, formulation): what is known to be wrong, with figures.
FAULTS: dict[tuple[str, str, str], str] = {}

# Combinations of more than half a second whose variant and formulation are each held by another
# run of the same benchmark in less of it: all of them are run by `make verify`.
STUDIES = {
    ("B2", "30 and 20 degrees", "augmented"),
    ("B2", "45 and 30 degrees", "cone"),
    ("B2", "45 and 30 degrees", "finite elements"),
    ("B2", "45 and 30 degrees", "lagrange"),
    ("B21 exact", "augmented", "finite elements"),
    ("B21 exact", "cone", "bilinear quads"),
    ("B21 exact", "lagrange", "bilinear quads"),
    ("B22 exact", "augmented", "finite elements"),
    ("B22 exact", "augmented", "manifold"),
    ("B22 exact", "cone", "bilinear quads"),
    ("B22 exact", "cone", "manifold"),
    ("B22 exact", "lagrange", "bilinear quads"),
    ("B22 exact", "lagrange", "finite elements"),
    ("B8 bar", "step = 0.1, enforcement = lagrange", "bilinear quads"),
    ("B8 bar", "step = 0.1, normal_penalty = 10.0", "quads"),
    ("B8 oblique", "step 0.0001 s", "manifold"),
    ("BM1", "T 0.3, 0.0", "bilinear quads"),
    ("BM3", "P at 30 degrees", "manifold degree 2"),
    ("BM3", "P at 30 degrees", "splines"),
    ("BM3", "P at 60 degrees", "manifold degree 2"),
    ("BM3", "P at 60 degrees", "quads degree 2"),
    ("BM3", "P at 75 degrees", "manifold degree 2"),
    ("BM3", "P at 75 degrees", "splines"),
    ("BM3", "SV at 15 degrees", "quads degree 2"),
    ("BM3", "SV at 15 degrees", "splines"),
    ("BM3", "SV at 30 degrees", "manifold degree 2"),
    ("BM3", "SV at 30 degrees", "quads degree 2"),
    ("BO2", "1 m", "manifold"),
    ("C4 splitting", "in compression", "bilinear quads"),
    ("C4 splitting", "in compression", "finite elements"),
    ("FK4", "120 deg", "manifold degree 2"),
    ("FK4", "60 deg", "quads degree 2"),
    ("PA2", "bilinear, 1.5 of the critical length", "bilinear quads"),
    ("PA2", "linear, 0.5 of the critical length", "bilinear quads"),
    ("PA2", "linear, 1 of the critical length", "dda"),
    ("PA2", "linear, 1.000000001 of the critical length", "dda"),
    ("PA2", "linear, 100 of the critical length", "dda"),
    ("PA2", "linear, 2 of the critical length", "bilinear quads"),
    ("VI4", "local 0.1", "bilinear quads"),
    ("VI4", "local 0.7", "bilinear quads"),
    ("WA13", "160 steps, S M / w = 0.001", "manifold"),
    ("WA13", "160 steps, S M / w = 0.001", "quads"),
    ("WA13", "160 steps, S M / w = 0.001", "splines"),
    ("WA13", "160 steps, S M / w = 1", "manifold"),
    ("WA13", "160 steps, S M / w = 1", "quads"),
    ("WA13", "160 steps, S M / w = 1", "splines"),
    ("WA2", "factor of safety 0.99", "lagrange"),
}


def is_study(case, formulation):
    """Whether a run is left to `make verify`."""
    return case.slow or (case.name, case.variant, formulation) in STUDIES


def marks(case, formulation):
    """Studies, and those that are known to fail, with the figures."""
    fault = FAULTS.get((case.name, case.variant, formulation))
    found = [] if fault is None else [pytest.mark.xfail(strict=True, reason=fault)]
    return [*found, pytest.mark.slow] if is_study(case, formulation) else found


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


def test_what_is_left_to_studies_is_held_by_quicker_runs_in_all_its_parts():
    found = [(case.name, case.variant, formulation) for case, formulation in runs(slow=True)]
    quick = [(c.name, c.variant, name) for c, name in runs(slow=True) if not is_study(c, name)]
    assert set(found) >= STUDIES
    assert {(name, variant) for name, variant, _ in quick} >= {one[:2] for one in STUDIES}
    assert {(name, cover) for name, _, cover in quick} >= {one[::2] for one in STUDIES}


@pytest.mark.parametrize("name", CASES.table)
def test_a_benchmark_says_what_it_shows_and_where_its_answer_is_from(name):
    kind = CASES.load(name)
    assert kind.name == name
    assert kind.title
    assert kind.source
    variants = [case.variant for case in kind.variants()]
    assert len(set(variants)) == len(variants)
