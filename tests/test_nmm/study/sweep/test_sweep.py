"""Sweeps and ensembles: grouping, resume, failures, and a cluster that loses a worker."""

import csv
import json
import os
import signal

import numpy as np
import pytest
from typer.testing import CliRunner

from nmm.cli.app import app
from nmm.errors import NmmError
from nmm.materials.elastic import Elastic
from nmm.study.cases.pool import run_here
from nmm.study.cases.record import Record
from nmm.study.sweep.report import groups, sweep_page
from nmm.study.sweep.runs import Sweep, run_study
from nmm.study.sweep.store import Store
from nmm.study.sweep.study_file import read_plan
from nmm.trust import allowing

STUDY = """
title = "stiffness"
scene = "bar.toml"
formulations = ["dda.toml", "nmm.toml"]
quantities = ["external_work"]
over = ["materials.m.young_modulus"]
[vary]
"materials.m.young_modulus" = [1.0, 2.0, 4.0]
"""


class Faulty(Elastic):
    """An elastic law that breaks."""

    def stiffness(self, plane):
        if self.young_modulus == 4.0:
            raise RuntimeError("no such stiffness")
        return super().stiffness(plane)


class Deadly(Elastic):
    """An elastic law that takes its process with it."""

    def stiffness(self, plane):
        if self.young_modulus == 4.0:
            os._exit(9)
        return super().stiffness(plane)


@pytest.fixture
def study(tmp_path, bar_text):
    (tmp_path / "bar.toml").write_text(bar_text(poisson=0.0))
    (tmp_path / "dda.toml").write_text('title = "DDA"\n')
    (tmp_path / "nmm.toml").write_text('title = "NMM"\n[cover]\ntype = "quads"\nsize = 1\n')
    path = tmp_path / "study.toml"
    path.write_text(STUDY)
    return path


@pytest.fixture
def made():
    def one(name, value, status="converged", **settings):
        return Record(name, settings, f"{name}{settings}", status, "why", {"q": value}, (1.0,))

    return one


def call(*words):
    return CliRunner().invoke(app, [str(word) for word in words])


def test_mean_and_scatter_are_taken_over_the_ensemble_only(study, made):
    plan = read_plan(study)[0].model_copy(update={"over": ("seed",), "quantities": ("q",)})
    values = [3.0, 5.0, 10.0]
    records = [made("a", v, seed=n, phi=1) for n, v in enumerate(values)]
    records += [made("a", 7.0, seed=0, phi=2), made("a", 1e9, "failed", seed=1, phi=2)]
    first, second = groups(Sweep(plan, records, 0))
    assert first.settings == (("phi", 1),)
    assert first.mean == 6
    assert first.deviation == pytest.approx(np.sqrt((9 + 1 + 16) / 2))
    assert first.variation == pytest.approx(first.deviation / 6)
    assert (second.values, second.failed) == ((7.0,), 1)
    assert np.isnan(second.deviation)
    assert "- a (seed = 1, phi = 2): **failed**: why" in sweep_page(Sweep(plan, records, 0))


def test_a_study_is_run_summed_up_and_not_run_again(study, tmp_path):
    out = tmp_path / "out"
    result = call("study", study, "--out", out, "-n", 1)
    assert result.exit_code == 0, result.output
    assert "6 cases, 0 done before, 0 failed" in result.stdout
    assert len(list((out / "cases").glob("*.json"))) == 6
    rows = list(csv.DictReader((out / "cases.csv").open()))
    # external work of uniform tension: sigma^2 area / (2 E); springs give 1 % at most
    for row in rows:
        modulus = float(row["materials.m.young_modulus"])
        assert float(row["external_work"]) == pytest.approx(2e-6 / modulus, rel=0.02)
    stamps = {path: path.stat().st_mtime_ns for path in (out / "cases").iterdir()}
    assert "6 cases, 6 done before, 0 failed" in call("study", study, "--out", out).stdout
    assert stamps == {path: path.stat().st_mtime_ns for path in (out / "cases").iterdir()}


def test_several_scenes_are_cases_named_by_their_files(study, tmp_path, bar_text):
    (tmp_path / "long.toml").write_text(bar_text(length=8, poisson=0.0))
    listed = 'scenes = ["bar.toml", "long.toml"]'
    study.write_text(STUDY.replace('scene = "bar.toml"', listed).replace('"dda.toml", ', ""))
    plan, cases = read_plan(study)
    assert [one.settings["scene"] for one in cases] == ["bar"] * 3 + ["long"] * 3
    done = run_study(plan, cases, tmp_path / "out", processes=1)
    work = {dict(one.settings)["scene"]: one.mean for one in groups(done)}
    # The work of a load on a bar grows with its length.
    assert work["long"] == pytest.approx(2 * work["bar"], rel=1e-2)
    study.write_text(STUDY.replace('scene = "bar.toml"', ""))
    with pytest.raises(NmmError, match="expected one scene, or a list scenes"):
        read_plan(study)


def test_a_killed_study_continues_with_what_is_left(study, tmp_path):
    plan, cases = read_plan(study)

    class Stop(Exception):
        pass

    def stop(number, total, record):
        if number == 2:
            raise Stop

    with pytest.raises(Stop):
        run_study(plan, cases, tmp_path / "out", processes=1, tell=stop)
    kept = list((tmp_path / "out/cases").glob("*.json"))
    assert len(kept) == 2
    kept[0].write_text(kept[0].read_text()[:40])  # cut off in the middle: counts as not done
    told = []
    done = run_study(
        plan, cases, tmp_path / "out", processes=1, tell=lambda n, m, one: told.append(one.key)
    )
    assert done.skipped == 1
    assert len(told) == len(set(told)) == 5
    assert [one.key for one in done.records] == [case.key for case in cases]


def test_a_store_keeps_no_half_written_file(study, tmp_path, made):
    store = Store(tmp_path / "cases")
    store.keep(made("a", float("nan")))
    (file,) = store.folder.iterdir()
    assert json.loads(file.read_text())["quantities"] == {"q": None}


def test_a_case_that_lacks_a_quantity_is_run_again(study, tmp_path):
    _, (case, *_) = read_plan(study)
    store = Store(tmp_path / "cases")
    store.keep(Record("x", {}, case.key, "converged", "", {"energy": 1.0}))
    assert store.find(case, ["energy"]).name == case.name
    assert store.find(case, ["energy", "failure_load"]) is None


@pytest.fixture
def laws(study, monkeypatch, bar_text):
    """Makes scenes of the study use a law of this file."""
    monkeypatch.setenv("PYTHONPATH", os.path.dirname(__file__))
    monkeypatch.syspath_prepend(os.path.dirname(__file__))

    def use(name):
        module = __name__.split(".")[-1]
        (study.parent / "bar.toml").write_text(bar_text(poisson=0.0, law=f"{module}:{name}"))
        with allowing(module):
            return read_plan(study)

    return use


def test_a_case_that_breaks_is_recorded_and_run_again_when_asked(laws, tmp_path):
    plan, cases = laws("Faulty")
    cases = [one for one in cases if one.settings["materials.m.young_modulus"] == 4.0]
    done = run_study(plan, cases, tmp_path / "out", processes=1)
    assert [one.status for one in done.records] == ["error", "error"]
    assert "no such stiffness" in done.records[0].sentence
    assert run_study(plan, cases, tmp_path / "out").skipped == 2
    assert run_study(plan, cases, tmp_path / "out", processes=1, again=True).skipped == 0


def test_a_process_that_dies_costs_its_own_case_only(laws):
    plan, cases = laws("Deadly")
    cases = [one for one in cases if one.name == "DDA"]
    records = {one.key: one for one in run_here(cases, plan.quantities, 1, 1)}
    status = [records[case.key].status for case in cases]
    assert status == ["converged", "converged", "error"]
    assert "died" in records[cases[2].key].sentence


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"bar.toml"', '"none.toml"', "none.toml: No such file"),
        ('over = ["materials', 'over = ["material', "expected a key of"),
        ("quantities", "quantity", 'unknown key "quantity"'),
        ('"materials.m.young_modulus" = [1.0', '"materials.m.young_modulus" = [-1.0', "young"),
    ],
)
def test_faults_of_a_study_file_are_named(study, old, new, message):
    study.write_text(study.read_text().replace(old, new))
    with pytest.raises(NmmError, match=message):
        read_plan(study)


def test_more_cases_than_memory_holds_are_told_before_the_first_is_made(study):
    """Four keys of 300 values are 8.1e9 scenes."""
    keys = ("materials.m.young_modulus", "materials.m.poisson_ratio", "thickness", "title")
    lines = [f'"{key}" = {[float(number) for number in range(1, 301)]}' for key in keys]
    study.write_text(STUDY.split("[vary]")[0] + "[vary]\n" + "\n".join(lines))
    with pytest.raises(NmmError, match=r"\[vary\]: 16,200,000,000 cases, about .* GB of memory"):
        read_plan(study)


@pytest.fixture
def cluster():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        processes=True,
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
        silence_logs=50,
    ) as local:
        yield local


def test_a_cluster_that_loses_a_worker_loses_no_case_and_counts_none_twice(
    study, tmp_path, cluster
):
    from distributed import Client

    moduli = ", ".join(str(1.0 + n) for n in range(12))
    study.write_text(study.read_text().replace("1.0, 2.0, 4.0", moduli))
    nmm = (tmp_path / "nmm.toml").read_text()
    (tmp_path / "nmm.toml").write_text(nmm.replace("size = 1", "size = 0.06"))  # a second a case
    plan, cases = read_plan(study)
    told = []
    with Client(cluster.scheduler_address, set_as_default=False) as client:
        pids = client.run(os.getpid)

        def kill_one(number, total, record):
            told.append(record.key)
            if number == 14:  # the twelve quick cases are done, the slow ones are under way
                os.kill(min(pids.values()), signal.SIGKILL)

        done = run_study(
            plan, cases, tmp_path / "out", scheduler=cluster.scheduler_address, tell=kill_one
        )
        assert set(client.run(os.getpid).values()) != set(pids.values())
    assert sorted(told) == sorted(case.key for case in cases)
    assert [one.status for one in done.records] == ["converged"] * 24
    works = [one.quantities["external_work"] for one in done.records]
    expected = [2e-6 / one.settings["materials.m.young_modulus"] for one in done.records]
    assert works == pytest.approx(expected, rel=0.02)


def test_a_scheduler_that_does_not_answer_is_named(study, tmp_path, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr("nmm.study.cases.pool.PATIENCE", "1s")
    result = call("study", study, "--out", tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")
    assert result.exit_code == 1
    assert "--scheduler tcp://127.0.0.1:9: no answer" in result.stderr
