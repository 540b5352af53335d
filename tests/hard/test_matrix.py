"""The hard matrix: a small share of it, that new parts join it, and that what fails is reduced."""

from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nmm.contact.enforcement.base import ENFORCEMENTS
from nmm.contact.enforcement.penalty import Penalty
from nmm.errors import NmmError
from nmm.verification.base import limit
from nmm.verification.hard.cases.base import HardCase
from nmm.verification.hard.cases.parts import enforcements, with_parts
from nmm.verification.hard.cases.transforms import listed_anew, mirrored, shifted, turned
from nmm.verification.hard.cases.units import in_units
from nmm.verification.hard.cases.writing import block, in_time, rock
from nmm.verification.hard.oracles.motion import overlap, prepared, ran
from nmm.verification.hard.oracles.whole import GAVE_UP
from nmm.verification.hard.running.page import write_page
from nmm.verification.hard.running.records import append_record, read_records
from nmm.verification.hard.running.reducing import reduced
from nmm.verification.hard.running.registry import HARD
from nmm.verification.hard.running.running import chosen_cases, judged

# Every class runs whole under the slow marker.
SHARE = {
    "crossings": [["penalty", "shi"], ["cone", "generalized_alpha"]],
    "corners": [["penalty", "shi"], ["lagrange", "shi"]],
    "fans": [["penalty", "shi"], ["penalty", "newmark"]],
    "seams": [["penalty", "shi"]],
    "drives": [["cone", "shi"], ["penalty", "energy_momentum"]],
    "pieces": [["triangles degree 1"], ["quads degree 1"]],
    "cuts": [
        ["triangles degree 1"],
        ["quads degree 2"],
        ["bspline degree 0"],
        ["bspline degree 2"],
    ],
    "tips": [["triangles degree 1"]],
    "ligaments": [["quads degree 1"]],
    "solids": [["block"], ["triangles degree 1"], ["bspline degree 0"], ["mls degree 0"]],
    "steps": [["newmark"]],
    "scenes": [["block"], ["rigid"]],
    "anchored": [["penalty"]],
    "features": [["events"], ["bars with slip"], ["seasons"], ["standing reactions"]],
}


class Mine(Penalty):
    """An enforcement of a user's own."""


def share():
    for name, choices in SHARE.items():
        for parts in choices:
            yield from islice(chosen_cases([name], [0], parts=parts), 1)


@pytest.mark.parametrize(
    ("group", "case"), list(share()), ids=lambda one: getattr(one, "label", one)
)
def test_a_share_of_the_hard_matrix_passes(group, case):
    found = judged(group, case)
    assert found.passed, found.words


@given(st.integers(0, 10**6), st.sampled_from(["triangles degree 1", "bspline degree 1"]))
@settings(max_examples=4)
def test_any_network_of_cracks_leaves_the_pieces_of_polygon_arithmetic(seed, cover):
    for group, case in chosen_cases(["pieces"], [seed], parts=[cover]):
        found = judged(group, case)
        assert found.passed, f"{case.label}: {found.words}"


RISES = {"rise in a step", "rise in the run"}
MOMENTA = {"momentum x", "momentum y", "angular momentum"}
TOLD = {
    **dict.fromkeys(("crossings", "corners", "fans", "heaps"), RISES | MOMENTA),
    **dict.fromkeys(("wedges", "slopes", "slope_array"), RISES | {"converged"}),
    "motions": RISES | MOMENTA | {"other units", "converged"},
    "ratios": {"converged"},
    "drives": {"energy made in step", "energy made in run"},
}
"""What may miss, as the run itself says so; docs/hard_cases.md has the figures."""


@pytest.mark.slow
@pytest.mark.parametrize("group", HARD.table)
def test_hard_cases_of_a_class_pass_or_the_run_says_what_misses(group):
    seed = 0 if group == "features" else HARD.load(group).share  # these draw nothing
    found = [judged(group, case) for _, case in chosen_cases([group], [seed])]
    silent = [
        f"{one.case.label}: {one.words}"
        for one in found
        if one.crashed or set(one.missed) - TOLD.get(group, set())
    ]
    assert not silent, "\n".join(silent)


def test_an_enforcement_that_joins_the_registry_joins_the_matrix(monkeypatch):
    before = {case.label for _, case in chosen_cases(["crossings"], [0])}
    monkeypatch.setitem(ENFORCEMENTS.table, "mine", f"{__name__}:Mine")
    assert "mine" in enforcements()
    joined = [case for _, case in chosen_cases(["crossings"], [0], parts=["mine"])]
    assert joined
    assert all(case.label not in before for case in joined)
    assert all(case.scene["formulation"]["contact"]["enforcement"] == "mine" for case in joined)


def test_digits_that_rounding_takes_are_told():
    """A soft piece of 1/40 of a cell, glued by springs to one a thousand times as stiff."""
    for cover in ("bspline degree 1", "mls degree 1"):
        cases = chosen_cases(["solids"], [9], parts=[cover])
        group, case = next(one for one in cases if "seed 9," in one[1].label)
        assert "audit rounding" in " ".join(ran(case.scene).run.summary.warnings)
        found = judged(group, case)
        assert found.passed, found.words
        # Images of it, with loads of no weight among them, differ by far more than 1e-6.
        assert found.checks["named effects of no weight"].computed > 1e-5


def two_squares(apart):
    squares = [[[0, 0], [1, 0], [1, 1], [0, 1]], [[apart, 0], [apart + 1, 0], [apart + 1, 1]]]
    scene = rock()
    scene["blocks"] = [block(f"b{number}", points) for number, points in enumerate(squares)]
    return in_time(scene, 1e-3, 2, None)


def test_the_overlap_of_bodies_is_that_of_their_polygons():
    found = ran(two_squares(1.5)).run
    points = found.frames[0].points.copy()
    points[4:] -= [1.0, 0.0]
    # A right triangle over the square's right half: 1/8 is shared, of its area of 1/2.
    assert overlap(points, found) == pytest.approx(0.25, abs=1e-9)


def test_a_scene_that_fails_is_reduced_to_what_makes_it_fail():
    scene = two_squares(1.5)
    scene["monitors"] = [{"name": "m", "point": [0.5, 0.5], "block": "b0"}]
    small = reduced(scene, lambda tried: any(b["name"] == "b1" for b in tried["blocks"]))
    assert [table["name"] for table in small["blocks"]] == ["b1"]
    assert "monitors" not in small
    assert "inertia" not in small


def test_an_image_of_a_scene_is_the_scene_seen_from_elsewhere():
    scene = two_squares(1.5)
    scene["initial_velocities"] = [{"block": "b0", "velocity": [1.0, 2.0]}]

    def seen(image):
        ready = prepared(image)
        energy = ready.stepper.plan.energy("inertia", ready.start)
        return energy, float(ready.stepper.model.manifold.elements.areas.sum())

    plain = seen(scene)
    # 2600 kg at the speed of sqrt 5; the areas of a square and of half of one.
    assert plain == pytest.approx((2600 * 5 / 2, 1.5), rel=1e-12)
    for image in (shifted(scene, (10, 3)), turned(scene, 0.4), mirrored(scene)):
        assert seen(image) == pytest.approx(plain, rel=1e-12)
    assert seen(listed_anew(scene, 1)) == pytest.approx(plain, rel=1e-12)
    # Energy is force times length.
    energy, area = seen(in_units(scene, 10.0, 7.0))
    assert (energy, area) == pytest.approx((70 * plain[0], 100 * plain[1]), rel=1e-12)


def test_parts_are_set_in_a_copy():
    scene = two_squares(1.5)
    made = with_parts(scene, {"contact.enforcement": "cone"})
    assert made["formulation"]["contact"]["enforcement"] == "cone"
    assert "contact" not in scene["formulation"]


def test_the_page_lists_what_misses_and_what_crashes(tmp_path):
    def broken(scene):
        raise IndexError("no such thing")

    findings = [judged("seams", HardCase("one", {}, broken, {"cover": "block"}))]
    page = write_page(findings, tmp_path / "page.md", "seams").read_text()
    assert "| `seams` | crashed | 1 | IndexError: no such thing |" in page
    assert "| block | 0/1 |" in page


def test_the_page_counts_runs_whose_solver_gave_up_and_passes_them(tmp_path):
    case = HardCase("one", {}, lambda scene: {GAVE_UP: limit(1.0, 1.0, "it cycles")}, {})
    found = judged("seams", case)
    assert found.passed
    assert found.words == "gave up: it cycles"
    page = write_page([found], tmp_path / "page.md", "seams").read_text()
    assert "| all | | | 1 | 1 | 1 | 0 | 0 |" in page


def test_a_page_of_records_is_that_of_the_findings_themselves(tmp_path):
    made = [("pieces", case) for _, case in chosen_cases(["pieces"], [0])][:3]
    wrong = HardCase("wrong", {}, lambda scene: {"area": limit(float("nan"), 1.0, "no number")}, {})
    findings = [judged(group, case) for group, case in [*made, ("seams", wrong)]]
    for number, finding in enumerate(findings):  # in two files, and one of them twice
        append_record(finding, tmp_path / f"{number % 2}.jsonl")
    append_record(findings[0], tmp_path / "1.jsonl")
    read = read_records(sorted(tmp_path.glob("*.jsonl")))
    assert [one.passed for one in read] == [False, True, True, True]
    # Of another order of cases, rows of parts stand in another order.
    pages = [write_page(some, tmp_path / "p.md", "x").read_text() for some in (findings, read)]
    assert sorted(pages[0].splitlines()) == sorted(pages[1].splitlines())


def test_a_line_that_is_no_record_is_told_with_its_number(tmp_path):
    path = tmp_path / "spoilt.jsonl"
    path.write_text('{"class": "seams"}\n')
    with pytest.raises(NmmError, match=r"spoilt.jsonl, line 1: .*expected a record"):
        read_records([path])


@pytest.mark.parametrize("form", ["triangles", "quads"])
def test_bodies_of_dependent_functions_fly_with_carried_accelerations(form):
    scene = two_squares(1.5)
    scene["initial_velocities"] = [{"block": "b0", "velocity": [1.0, 0.5], "angular_velocity": 0.3}]
    cover = {"type": form, "size": 0.5, "functions": "monomials", "degree": 1}
    parts = {"cover": cover, "integrator.type": "generalized_alpha"}
    found = ran(with_parts(scene, parts)).run
    assert found.summary.status == "converged", found.summary.sentence
    velocity = found.frames[-1].velocity[: len(found.manifold.elements.take([0]).points)]
    assert np.isfinite(velocity).all()
    kinetic = found.history["kinetic_energy"]
    # 2600 kg at the speed of sqrt 1.25, turning with a moment of inertia of m / 6.
    right = 2600 * (1.25 + 0.3**2 / 6) / 2
    assert kinetic == pytest.approx([right, right], rel=1e-6)
