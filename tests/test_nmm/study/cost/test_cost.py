"""What accuracy costs: orders, extrapolation, fronts, variants, and a small study end to end."""

import numpy as np
import pytest
from typer.testing import CliRunner

import nmm
from nmm.cli.app import app
from nmm.errors import NmmError
from nmm.study.cases.measure import measure
from nmm.study.cases.record import Record
from nmm.study.cases.variants import SIZE, StudyCase, cases_of, read_formulations, with_settings
from nmm.study.cost.cost_study import cost_study, read_records
from nmm.study.cost.front import cost_at, costs_at_levels, front
from nmm.study.cost.orders import observed_order, richardson
from nmm.study.cost.reference import extrapolated_reference, sizes_of
from nmm.study.cost.report import cost_page, write_cost_report


@pytest.fixture
def bent(bar_text):
    return bar_text(traction="[0, 1e-3]")


@pytest.fixture
def bar(bent):
    return nmm.scene.parse_scene(bent)


def made(name="a", unknowns=10, value=1.0, seconds=1.0, status="converged", **settings):
    return Record(
        name, settings, "k", status, "why", {"q": value}, (seconds,), (seconds,), unknowns=unknowns
    )


def formulation(**cover):
    return nmm.Formulation.model_validate({"cover": cover})


def test_the_order_of_exact_powers_is_found():
    sizes = np.array([1.0, 0.5, 0.3, 0.1])
    order = observed_order(sizes, 7 * sizes**2.5)
    assert order.value == pytest.approx(2.5, abs=1e-12)
    assert order.deviation < 1e-10


def test_the_confidence_of_an_order_holds_the_true_one_19_times_in_20():
    # 400 fits to noisy data: the share has a standard deviation of 1.1 %; three of them are allowed
    dice = np.random.default_rng(3)
    sizes = 2.0 ** -np.arange(6)
    held = 0
    for _ in range(400):
        order = observed_order(sizes, sizes**2 * np.exp(0.1 * dice.standard_normal(6)))
        held += abs(order.value - 2) < order.deviation
    assert held / 400 == pytest.approx(0.95, abs=0.034)


@pytest.mark.parametrize("sizes", [(1, 0.5, 0.25), (1, 0.7, 0.2)])
def test_richardson_finds_the_limit_and_the_order(sizes):
    values = [3 + 0.4 * size**1.7 for size in sizes]
    found = richardson(sizes, values)
    assert found.value == pytest.approx(3, abs=1e-10)
    assert found.order == pytest.approx(1.7, abs=1e-8)
    assert abs(values[-1] - 3) <= found.uncertainty * (1 + 1e-9)


def test_values_that_do_not_settle_keep_the_whole_last_change_as_uncertainty():
    assert richardson([1, 0.5, 0.25], [1.0, 2.0, 1.0]).uncertainty == 1.0
    assert np.isnan(richardson([1, 0.5, 0.25], [1.0, 2.0, 4.0]).order)


def test_the_front_is_what_no_other_point_beats():
    dice = np.random.default_rng(1)
    cost, error = dice.integers(0, 12, (2, 60)).astype(float)
    error[:5] = np.nan
    there = [n for n in range(60) if np.isfinite(error[n])]
    brute = [
        n in there
        and not any(
            cost[m] <= cost[n]
            and error[m] <= error[n]
            and (cost[m], error[m]) != (cost[n], error[n])
            for m in there
        )
        for n in range(60)
    ]
    assert front(cost, error).tolist() == brute


def test_cost_at_an_error_lies_between_measured_points_only():
    cost, error = [1.0, 100.0], [1e-1, 1e-3]
    assert cost_at(1e-2, cost, error).value == pytest.approx(10)  # halfway in logarithms
    assert cost_at(1e-4, cost, error) is None
    assert cost_at(0.5, cost, error).at_most
    assert str(cost_at(0.5, cost, error)) == "at most 1"
    assert costs_at_levels({"a": (cost, error)}, [1e-4]) == {1e-4: {}}


def test_the_reference_is_the_limit_of_the_formulation_that_settles_best():
    sloppy = [made("sloppy", n, 1 + 3 * n**-0.5) for n in (100, 400, 1600)]
    good = [made("good", n, 1 + 3 * n**-1.5) for n in (100, 400, 1600)]
    found = extrapolated_reference([*sloppy, *good], "q")
    assert "Richardson" in found.source
    assert "good" in found.source
    assert found.value == pytest.approx(1, abs=1e-9)
    assert set(found.limits) == {"sloppy", "good"}


def test_failed_runs_are_no_part_of_the_reference():
    runs = [made("a", n, 1 + n**-0.5) for n in (100, 400)]
    broken = made("a", 1600, 55.0, status="failed")
    assert extrapolated_reference([*runs, broken], "q").value == pytest.approx(1.05)


def test_without_two_runs_the_reference_says_why():
    with pytest.raises(NmmError, match="the run of a failed: why"):
        extrapolated_reference([made("a", status="error")], "q")


def test_where_the_unknowns_stay_the_size_is_the_setting_that_differs():
    runs = [made(step=0.1), made(step=0.05)]
    assert sizes_of(runs) == [0.1, 0.05]
    assert sizes_of([made(unknowns=100), made(unknowns=400)]) == [0.1, 0.05]


def test_blocks_are_not_run_again_for_every_size_of_a_cover(bar):
    kinds = {"dda": formulation(), "nmm": formulation(type="triangles", size=1)}
    cases = cases_of(bar, kinds, {SIZE: [1, 0.5]})
    assert [(one.name, one.settings.get(SIZE)) for one in cases] == [
        ("dda", None),
        ("nmm", 1),
        ("nmm", 0.5),
    ]


def test_a_setting_that_leads_nowhere_is_named(bar):
    with pytest.raises(NmmError, match=r"setting blocks\.7\.material: leads nowhere"):
        with_settings(StudyCase("a", bar, formulation()), {"blocks.7.material": "m"})
    with pytest.raises(NmmError, match=r"setting materials\.n\.young_modulus: leads nowhere"):
        with_settings(StudyCase("a", bar, formulation()), {"materials.n.young_modulus": 2.0})


def test_the_key_of_a_case_depends_on_its_content_only(bar, bent):
    first = StudyCase("a", bar, formulation())
    assert (
        first.key == StudyCase("b", nmm.scene.parse_scene(bent + "# no matter"), formulation()).key
    )
    assert first.key != with_settings(first, {"materials.m.young_modulus": 2.0}).key


def test_formulations_are_named_by_title_or_file(tmp_path):
    (tmp_path / "x.toml").write_text('title = "DDA"\n')
    (tmp_path / "y.toml").write_text("")
    assert list(read_formulations([tmp_path / "x.toml", tmp_path / "y.toml"])) == ["DDA", "y"]


def test_a_case_that_breaks_is_recorded_and_the_others_go_on(bar):
    broken = StudyCase("broken", bar, formulation(type="triangles", size=1, functions="none_such"))
    records = measure([broken, StudyCase("dda", bar, formulation())], ["energy"], 1, memory=False)
    assert [one.status for one in records] == ["error", "converged"]
    assert "none_such" in records[0].sentence
    assert records[0].seconds == ()
    assert records[1].family == "DDA"


def test_a_record_is_read_back_as_it_was(tmp_path):
    one = made(value=float("nan"))
    again = Record.from_json(one.to_json())
    assert np.isnan(again.quantities["q"])
    assert again.to_json() == one.to_json()


def test_a_cost_study_writes_figure_page_and_records(bar, tmp_path):
    kinds = {
        "DDA 2": formulation(functions="monomials", degree=2),
        "NMM": formulation(type="quads", degree=1),
        "broken": formulation(type="quads", functions="none_such"),
    }
    study = cost_study(bar, kinds, {SIZE: [2.0, 1.0, 0.5]}, "external_work", repeats=2)
    files = write_cost_report(study, tmp_path)
    assert [path.name for path in files] == ["cost.md", "cost.png", "records.jsonl"]
    assert all(path.stat().st_size > 100 for path in files)
    again = read_records(tmp_path / "records.jsonl")
    assert [one.to_json() for one in again] == [one.to_json() for one in study.records]
    page = cost_page(study, "cost.png")
    assert "Richardson extrapolation of the finest runs of NMM" in page
    assert page.count("**error**") == 3
    assert "broken (formulation.cover.size = 2.0)" in page
    assert study.records[0].memory is None or study.records[0].memory >= 0
    # bending and shear of the bar by beam theory: 1e-6 (4^3 / (3 I) + 4 (2.6) / (5/6)) / 2
    beam = 0.5e-6 * (64 * 4 + 4 * 2.6 * 1.2)
    assert study.reference.value == pytest.approx(beam, rel=0.02)  # the wall holds the corners


def test_the_verb_takes_formulations_sizes_and_settings(tmp_path, bent):
    scene, kind = tmp_path / "bar.toml", tmp_path / "quads.toml"
    scene.write_text(bent)
    kind.write_text('[cover]\ntype = "quads"\nsize = 1\n')
    words = ["cost", scene, "--formulations", kind, "--sizes", "2,1", "--repeats", 1]
    words += ["--vary", "formulation.cover.degree=0,1", "--quantity", "energy", "--out", tmp_path]
    result = CliRunner().invoke(app, [str(word) for word in words])
    assert result.exit_code == 0, result.output
    assert "4 cases, 0 failed" in result.stdout
    assert (tmp_path / "cost.png").exists()


def test_an_order_that_is_too_good_lessens_no_uncertainty():
    # changes of 1 and 1/16: order 4; at the order 2 that is trusted the doubt is (1/16) / 3
    found = richardson([1, 0.5, 0.25], [0.0, 1.0, 1.0625])
    assert found.order == pytest.approx(4)
    assert found.uncertainty == pytest.approx(1 / 48)
