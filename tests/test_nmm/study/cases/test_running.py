"""Runs of cases: which code ran, and where its parts are found."""

import subprocess
import sys
from pathlib import Path

import nmm
from nmm.study.cases import running
from nmm.study.cases.pool import run_here
from nmm.study.cases.variants import cases_of
from nmm.trust import allowing


def test_the_commit_is_that_of_the_checkout():
    root = Path(running.__file__).resolve().parents[3]
    if not (root / ".git").exists():
        assert running.commit() == ""
        return
    log = ["git", "log", "-50", "--format=%H"]
    known = subprocess.run(log, cwd=root, capture_output=True, text=True).stdout.split()
    # others may have committed since the process first asked
    assert running.commit().split(" ")[0] in known


def test_parts_beside_a_scene_are_found_in_processes_of_a_pool(tmp_path, monkeypatch, bar_text):
    (tmp_path / "soft_law.py").write_text(
        "from nmm.materials.elastic import Elastic\n\n\nclass Soft(Elastic):\n    pass\n"
    )
    (tmp_path / "bar.toml").write_text(bar_text(law="soft_law:Soft"))
    monkeypatch.chdir(tmp_path)
    scene = nmm.read_scene("bar.toml")
    monkeypatch.chdir("/")  # a worker elsewhere: the name of the file leads nowhere there
    monkeypatch.setattr(sys, "path", [one for one in sys.path if one])
    monkeypatch.chdir(tmp_path)
    with allowing("soft_law"):
        cases = cases_of(scene, {"DDA": nmm.Formulation()}, {})
    monkeypatch.chdir("/")
    (record,) = run_here(cases, ["external_work"], 1, 1)
    assert record.status == "converged", record.sentence
