"""Verification runner: verdicts, pages, published case folders."""

import shutil
import tomllib
from pathlib import Path

import pytest
from typer.testing import CliRunner

from nmm.cli.app import app
from nmm.errors import NmmError
from nmm.verification import CASES, Case, Check, runs
from nmm.verification.manual import in_order
from nmm.verification.outcomes import named
from nmm.verification.published import PublishedCase

ROOT = Path(__file__).resolve().parents[3]
MODULE = '''
from nmm.verification.base import Case, Check

class Mine(Case):
    """Two and two."""
    name, title, source = "mine", "a sum", "arithmetic"

    def checks(self, formulation):
        return {"sum": Check(2.0 + 2.0, %s, 0.0, "exact")}
'''

ORDERS = '''
from nmm.verification.base import Case, order
from nmm.verification.series import Series

class Mine(Case):
    """Errors that fall by eight."""
    name, title, source = "mine", "a cube", "arithmetic"

    def checks(self, formulation):
        errors = Series.of([0.4, 0.2, 0.1, 0.05], [512.0, 62.5, 7.8, 1.0], 3.0)
        return {"order": order(errors, 0.1, "chosen so")}
'''


def call(*words):
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture
def folder(tmp_path, bar_text):
    scene = tmp_path / "bar.toml"
    scene.write_text(bar_text())
    result = call("publish", scene, "--quantity", "energy", "--out", tmp_path / "case")
    assert result.exit_code == 0, result.output
    return tmp_path / "case"


def test_a_published_folder_is_reproduced(folder):
    result = call("verify", folder)
    assert result.exit_code == 0, result.output
    assert "1 run, all within tolerance" in result.stdout


def test_a_quantity_that_no_run_has_is_refused_before_the_run(tmp_path, bar_text, monkeypatch):
    monkeypatch.setattr("nmm.verification.published.run", lambda *_: pytest.fail("it was run"))
    (tmp_path / "bar.toml").write_text(bar_text())
    words = ("--quantity", "enrgy", "--out", tmp_path / "case")
    result = call("publish", tmp_path / "bar.toml", *words)
    assert result.exit_code == 1
    assert '"energy"' in result.output.replace("'", '"')


def test_publishing_a_run_without_a_step_says_how_it_ended(tmp_path):
    slides = (ROOT / "examples/published_case/slide/scene.toml").read_text()
    (tmp_path / "slide.toml").write_text(slides.replace("[inertia]", ""))
    words = ("--quantity", "energy", "--out", tmp_path / "case")
    result = call("publish", tmp_path / "slide.toml", *words)
    assert result.exit_code == 1
    told = " ".join(result.output.split())
    assert "quantity energy: the run has none (no equilibrium of loose blocks" in told


def test_a_value_that_is_missed_gives_exit_code_1(folder):
    path = folder / "expected.toml"
    value = tomllib.loads(path.read_text())["values"][0]["value"]
    path.write_text(path.read_text().replace(str(value), str(1.01 * value)))
    result = call("verify", folder)
    assert result.exit_code == 1
    assert "MISSED" in result.stdout
    assert "1 missed" in result.stdout


def test_a_scene_changed_since_it_was_published_is_refused(folder):
    path = folder / "scene.toml"
    path.write_text(path.read_text().replace("1e-3", "2e-3"))
    with pytest.raises(NmmError, match="expected the scene that was published"):
        PublishedCase(folder).checks("as published")
    assert call("verify", folder).exit_code == 1


def test_other_versions_are_told(folder):
    path = folder / "expected.toml"
    text = path.read_text()
    numpy = tomllib.loads(text)["versions"]["numpy"]
    path.write_text(text.replace(f'numpy = "{numpy}"', 'numpy = "0.1"'))
    assert PublishedCase(folder).remarks == [f"published with numpy 0.1, this is {numpy}"]


def test_a_folder_in_use_is_not_published_into(folder):
    assert call("publish", folder / "scene.toml", "--out", folder).exit_code == 1


def test_the_published_example_can_be_read_and_is_what_it_says(tmp_path):
    shutil.copytree(ROOT / "examples/published_case/slide", tmp_path / "case")
    case = PublishedCase(tmp_path / "case")
    checks = case.checks("as published")
    assert set(checks) == {"monitor:toe:ux", "monitor:toe:uy"}
    assert all(check.passed for check in checks.values())


@pytest.mark.parametrize(("right", "code"), [(4.0, 0), (5.0, 1)])
def test_a_case_of_ones_own_is_run_and_gets_its_page(right, code, tmp_path, monkeypatch):
    module = f"my_cases_{code}"
    (tmp_path / f"{module}.py").write_text(MODULE % right)
    monkeypatch.chdir(tmp_path)
    result = call("verify", f"{module}:Mine", "--out", tmp_path / "manual")
    assert result.exit_code == code, result.output
    page = (tmp_path / "manual/mine.md").read_text()
    assert "Two and two." in page
    assert ("**missed**" in page) == bool(code)
    assert (tmp_path / "manual/margins.png").exists()


def test_an_unknown_benchmark_is_named():
    result = call("verify", "B999")
    assert result.exit_code == 1
    assert "B999" in result.stderr


def test_the_share_of_a_limit_is_the_value_over_it():
    assert Check(0.5, 1.0, 0.0, "", bound="at_most").share == 0.5
    assert Check(1.1, 1.0, 0.2, "").share == pytest.approx(0.5)
    assert Check(2.0, 1.0, 0.0, "").share == float("inf")
    assert Check(float("nan"), 1.0, 0.1, "").share == float("inf")


def test_a_name_stands_for_all_that_begin_with_it():
    assert named("B2") == ["B2"]
    assert set(named("B8")) == {"B8", "B8 bar", "B8 oblique"}
    assert set(named("B1")) == {"B1 friction", "B1 cohesion"}
    assert {"B1 friction", "B2", "B18 shear"} <= set(named("b"))
    assert not any(name.startswith("C") for name in named("b"))
    assert named("mine:Case") == ["mine:Case"]
    with pytest.raises(NmmError, match="B1 friction"):
        named("friction")
    with pytest.raises(NmmError, match="nmm verify --list"):
        named("")


def test_a_benchmark_that_two_names_stand_for_runs_once():
    # It has two variants of one formulation.
    result = call("verify", "A0b", "A0B", "A0b")
    assert result.exit_code == 0, result.output
    assert "2 runs, all within tolerance" in result.stdout


def test_slow_variants_run_when_their_benchmark_is_named_in_full(monkeypatch):
    class Long(Case):
        name, title, source = "B99 long", "", ""
        slow = True

        def checks(self, formulation):
            return {}

    monkeypatch.setitem(CASES.table, "B99 long", "anywhere:Long")
    monkeypatch.setattr(type(CASES), "load", lambda self, name: Long)
    assert list(runs(["B99"])) == []
    assert len(list(runs(["B99 long"]))) == 1
    assert len(list(runs(["B99"], slow=True))) == 1


def test_a_group_that_is_slow_as_a_whole_is_no_success():
    result = call("verify", "CO")
    assert result.exit_code == 1
    assert "CO: nothing was run: all 15 runs take more than" in result.stderr
    assert "expected --slow, or a benchmark named in full" in result.stderr
    assert "within tolerance" not in result.output


def test_what_is_left_out_for_its_seconds_is_counted():
    result = call("verify", "a0c")  # 12 runs, 3 of them slow, by `nmm verify --list A0c`
    assert result.exit_code == 0
    assert "9 runs, all within tolerance" in result.stdout
    assert result.stdout.rstrip().endswith("; 3 more with --slow")


def test_hard_cases_of_parts_that_none_has_are_no_success():
    result = call("verify", "--hard", "seams", "--part", "no_such_part")
    assert result.exit_code == 1
    assert "--hard: nothing was run: expected cases that have all of --part" in result.stderr


def test_the_list_of_benchmarks_runs_none():
    result = call("verify", "--list", "B1")
    assert result.exit_code == 0
    assert "B1 friction" in result.stdout
    assert "B2" not in result.stdout
    assert "within tolerance" not in result.stdout


def test_an_order_is_printed_with_its_confidence_and_drawn_on_its_page(tmp_path, monkeypatch):
    (tmp_path / "orders_of_mine.py").write_text(ORDERS)
    monkeypatch.chdir(tmp_path)
    result = call("verify", "orders_of_mine:Mine", "--out", tmp_path / "manual")
    assert result.exit_code == 0, result.output
    # log2 of 8.2, 8, 7.8: by hand 3.001, and half width 12.706 * s / sqrt(sum x^2) of two values.
    assert "3.00 +- " in result.stdout
    page = (tmp_path / "manual/mine.md").read_text()
    assert "![Errors over sizes](mine_convergence.png)" in page
    assert (tmp_path / "manual/mine_convergence.png").stat().st_size < 60_000


def test_groups_and_numbers_are_in_the_order_of_the_manual():
    names = ["own", "B10 cone", "PL3", "D1", "B2", "A14", "GR12", "GR2", "PL1c", "BO1"]
    assert in_order(names) == [
        "A14",
        "B2",
        "B10 cone",
        "D1",
        "GR2",
        "GR12",
        "BO1",
        "PL1c",
        "PL3",
        "own",
    ]


def test_a_benchmark_that_is_run_again_leaves_the_others_in_the_list(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, right in (("first", 5.0), ("second", 4.0), ("first", 4.0)):
        module = MODULE.replace('"mine"', f'"{name}"') % right
        (tmp_path / f"again_{name}_{right:.0f}.py").write_text(module)
        call("verify", f"again_{name}_{right:.0f}:Mine", "--out", "manual")
    index = (tmp_path / "manual/index.md").read_text()
    assert "2 runs of 2 benchmarks, 0 missed" in index
    assert index.count("[first](first.md)") == 1
    assert "**missed**" not in (tmp_path / "manual/first.md").read_text()


def test_a_quiet_hard_matrix_prints_what_misses_only():
    words = ("verify", "--hard", "seams", "--part", "penalty", "--part", "shi")
    loud, quiet = call(*words).stdout.splitlines(), call(*words, "-q").stdout.splitlines()
    assert any(line.startswith("passed") for line in loud)
    assert not any(line.startswith("passed") for line in quiet)
    assert quiet[-1].split(",")[:2] == loud[-1].split(",")[:2]
