"""The studies that come with nmm."""

import importlib.util
from pathlib import Path

from nmm.study.cost import read_records
from nmm.study.plan import read_plan

ROOT = Path(__file__).resolve().parents[2]
STUDIES = ROOT / "examples/studies"


def report():
    spec = importlib.util.spec_from_file_location("report", STUDIES / "report.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_membrane_is_measured_under_every_formulation(tmp_path):
    report().cook(tmp_path, sizes=(8,), repeats=1, memory=False)
    records = read_records(tmp_path / "records.jsonl")
    assert [one.status for one in records] == ["converged"] * 10
    work = {one.name: one.quantities["external_work"] for one in records}
    # 12.0208 by graded finite elements; one polynomial of higher degree is less stiff
    assert work["DDA"] < work["DDA degree 2"] < work["DDA degree 3"] < 12.0208
    assert abs(work["NMM quads 1"] / 12.0208 - 1) < 0.01
    assert abs(work["moving least squares"] / 12.0208 - 1) < 0.01


def test_the_ensemble_is_twelve_cases_that_differ():
    plan, cases = read_plan(STUDIES / "kitoh_seeds/study.toml")
    assert plan.over == ("tessellations.0.seed",)
    assert len({case.key for case in cases}) == 12


def test_the_committed_report_says_what_its_records_say():
    records = read_records(ROOT / "docs/accuracy_cost/cook/records.jsonl")
    page = (ROOT / "docs/accuracy_cost/cook/cost.md").read_text()
    assert all(f"{one.quantities['external_work']:.7g}" in page for one in records)
    assert all(one.scene_hash and one.formulation_hash and one.versions for one in records)
