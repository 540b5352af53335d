"""The studies that come with nmm."""

from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.study.cost.cost_study import read_records
from nmm.study.scikit_fem.yardstick import run_elements
from nmm.study.sweep.runs import run_study
from nmm.study.sweep.study_file import read_plan

ROOT = Path(__file__).resolve().parents[3]
STUDIES = ROOT / "examples/studies"


@pytest.fixture
def report(script):
    return script(STUDIES / "report.py")


def test_the_membrane_is_measured_under_every_formulation(report, tmp_path):
    report.measured("cook", tmp_path, repeats=1, memory=False, vary={report.SIZE: (8,)})
    records = read_records(tmp_path / "records.jsonl")
    assert [one.status for one in records] == ["converged"] * 14
    work = {one.name: one.quantities["external_work"] for one in records}
    # 12.0208 by graded finite elements; one polynomial of higher degree is less stiff
    assert work["DDA"] < work["DDA degree 2"] < work["DDA degree 3"] < 12.0208
    assert abs(work["NMM quads 1"] / 12.0208 - 1) < 0.01
    assert abs(work["moving least squares"] / 12.0208 - 1) < 0.01
    # elements that fit the panel are too stiff, the less the higher their degree
    assert work["scikit-fem P1"] < work["scikit-fem P2"] < work["scikit-fem P3"] < 12.0208


@pytest.mark.parametrize(
    ("name", "size", "allowed"),
    [
        # elements of degree 3 at this size: measured 4.1e-4, 9.7e-7 and 2.4e-2 below the reference
        ("lshape", 0.25, 3e-3),
        ("plate_with_hole", 0.25, 1e-5),
        ("edge_crack", 0.1, 4e-2),
    ],
)
def test_the_references_of_the_bodies_are_those_of_elements_on_other_meshes(
    report, name, size, allowed
):
    scene = nmm.read_scene(ROOT / "examples" / report.STUDIES[name].scene)
    cover = {"cover": {"type": "skfem", "degree": 3, "size": size}}
    found = run_elements(scene, nmm.Formulation.model_validate(cover)).history["external_work"][0]
    stated = {one.quantity: one.value for one in scene.references}["external_work"]
    # the energy of elements lies below, and a little
    assert -allowed < found / stated - 1 < 1e-7


def test_every_study_of_the_report_has_its_files(report):
    for study in report.STUDIES.values():
        assert (ROOT / "examples" / study.scene).exists()
        assert all(
            (STUDIES / "formulations" / f"{one}.toml").exists() for one in study.formulations
        )


def test_integrators_are_measured_on_a_swing_against_a_limit(report, tmp_path):
    steps = {report.STEP: (8e-3, 4e-3, 2e-3)}
    report.measured("cantilever_swings", tmp_path, repeats=1, memory=False, vary=steps)
    page = (tmp_path / "cost.md").read_text()
    assert "Richardson extrapolation" in page
    records = read_records(tmp_path / "records.jsonl")
    tip = {one.name: one.quantities["monitor:tip:uy"] for one in records}
    # both are of second order, and their finest steps are a fiftieth of the period
    assert tip["Newmark"] == pytest.approx(tip["generalized alpha"], rel=1e-3)


def test_the_ensemble_is_twelve_cases_that_differ():
    plan, cases = read_plan(STUDIES / "kitoh_seeds/study.toml")
    assert plan.over == ("tessellations.0.seed",)
    assert len({case.key for case in cases}) == 12


def test_friction_holds_back_a_sliding_block_by_its_angle(tmp_path):
    plan, cases = read_plan(STUDIES / "friction/study.toml")
    key = "interfaces.slope.friction_angle"
    chosen = [one for one in cases if one.settings[key] in ("10 deg", "31 deg")]
    done = run_study(plan, chosen, tmp_path, processes=1)
    way = {one.settings[key]: one.quantities["monitor:toe:ux"] for one in done.records}
    slope, friction = np.radians([30, 10])
    expected = -9.81 / 2 * (np.sin(slope) - np.cos(slope) * np.tan(friction)) * np.cos(slope)
    # as benchmark B2; above the angle of the slope it rests
    assert way["10 deg"] == pytest.approx(expected, rel=2e-3)
    assert abs(way["31 deg"]) < 1e-6


REPORTS = sorted((ROOT / "docs/accuracy_cost").glob("*/records.jsonl"))


@pytest.mark.parametrize("path", REPORTS, ids=[one.parent.name for one in REPORTS])
def test_the_committed_report_says_what_its_records_say(path):
    records = read_records(path)
    page = path.with_name("cost.md").read_text()
    shown = [one for one in records if one.valid]
    assert all(f"{value:.7g}" in page for one in shown for value in one.quantities.values())
    assert all(one.sentence in page for one in records if not one.valid)
    assert all(one.scene_hash and one.formulation_hash and one.versions for one in records)
    assert path.with_name("cost.png").stat().st_size < 150_000
