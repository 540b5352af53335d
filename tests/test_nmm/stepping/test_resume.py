"""Two halves of a run are the whole, byte by byte; and what cannot be gone on with says so."""

import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.errors import DamageError, StorageError
from nmm.testing.resumed import stopping
from nmm.testing.resumed.killing import check_same_bytes, killed_and_gone_on

SPEC = importlib.util.spec_from_file_location(
    "restart_scenes", Path(__file__).with_name("restart_scenes.py")
)
scenes = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(scenes)

CHECKPOINT = scenes.CHECKPOINT


def stopped_after(text, folder, steps):
    """Run the text of a scene until an exception ends it after so many steps."""
    return stopping.stopped_after(nmm.parse_scene(text, "scene"), folder, steps)


@pytest.mark.parametrize("steps", [5, pytest.param(1, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", scenes.SCENES)
def test_two_halves_are_the_whole_bit_by_bit(name, steps, tmp_path, whole):
    text = scenes.scene_of(name, CHECKPOINT)
    run, folder = whole(text)
    assert run.summary.steps > steps
    if name.startswith("growing"):
        assert run.history["fracture:notch:end:x"][-1] > 0.45  # where it was cut to
    stopped_after(text, tmp_path / "half", steps)
    resumed = nmm.resume(tmp_path / "half")
    check_same_bytes(run, resumed, (folder, tmp_path / "half"))


@pytest.mark.parametrize(
    ("name", "what", "count"),
    [
        ("wall", "step", 11),
        pytest.param("wall", "write", 9, marks=pytest.mark.slow),
        ("softening", "write", 14),
        pytest.param("bonds break", "step", 5, marks=pytest.mark.slow),
        pytest.param("bonds break", "write", 10, marks=pytest.mark.slow),
        pytest.param("wall cone", "write", 12, marks=pytest.mark.slow),
        pytest.param("slope", "write", 11, marks=pytest.mark.slow),
        pytest.param("slope", "step", 19, marks=pytest.mark.slow),
    ],
)
def test_a_run_killed_at_any_moment_goes_on_to_the_same_bytes(name, what, count, tmp_path):
    text = scenes.scene_of(name, CHECKPOINT)
    (tmp_path / "scene.toml").write_text(text)
    whole = nmm.run(nmm.read_scene(tmp_path / "scene.toml"), out=tmp_path / "whole")
    resumed = killed_and_gone_on(tmp_path / "scene.toml", tmp_path / "half", what, count)
    check_same_bytes(whole, resumed, (tmp_path / "whole", tmp_path / "half"))


def test_a_run_stopped_twice_goes_on_twice(tmp_path, whole):
    text = scenes.scene_of("wall", CHECKPOINT)
    stopped_after(text, tmp_path / "half", 6)
    with pytest.raises(stopping.StoppedError):
        nmm.resume(tmp_path / "half", progress=stopping.interrupting(5))
    resumed = nmm.resume(tmp_path / "half")
    run, folder = whole(text)
    check_same_bytes(run, resumed, (folder, tmp_path / "half"))


def test_a_run_in_memory_gives_what_it_gives_in_a_folder(tmp_path):
    scene = nmm.parse_scene(scenes.scene_of("wall", "checkpoint = { every_time = '9 ms' }"))
    kept, stored = nmm.run(scene), nmm.run(scene, out=tmp_path / "run")
    assert np.array_equal(kept.displacement, stored.displacement)


def test_a_run_whose_budget_was_spent_goes_on(tmp_path, whole):
    text = scenes.scene_of("wall", CHECKPOINT)
    spent = nmm.run(nmm.parse_scene(text, "scene"), out=tmp_path / "half", budget=0.0)
    assert spent.summary.status == "budget_spent"
    resumed = nmm.resume(tmp_path / "half")
    run, folder = whole(text)
    check_same_bytes(run, resumed, (folder, tmp_path / "half"))


OWN_EFFECT = """
from typing import Self

import numpy as np

from nmm.effects.base import Effect


class Tired(Effect):
    # A drag that grows with every accepted step and acts on all unknowns.

    def __init__(self, n):
        self.steps, self.n = 0, n

    @classmethod
    def from_setup(cls, setup) -> Self:
        return cls(setup.model.manifold.n_unknowns)

    def force(self, state, end):
        return np.full(self.n, 1e-3 * self.steps)

    def work(self, before, after):
        self.steps += 1
        return 0.0

    def carried(self):
        return {"steps": self.steps}

    def carry(self, carried):
        self.steps = carried["steps"]
"""


@pytest.mark.parametrize("remembers", [True, False])
def test_an_effect_of_ones_own_goes_on_with_what_it_says_it_carries(remembers, tmp_path):
    own = OWN_EFFECT if remembers else OWN_EFFECT.split("    def carried")[0]
    module = f"tired_{remembers}".lower()
    (tmp_path / f"{module}.py").write_text(own)
    text = scenes.scene_of("classical update", CHECKPOINT).split("[formulation.rotation]")[0]
    text += f'[effects.drag]\ntype = "{module}:Tired"\n'
    (tmp_path / "scene.toml").write_text(text)
    scene, trust = nmm.read_scene(tmp_path / "scene.toml"), {"allow_code": [module]}
    whole = nmm.run(scene, out=tmp_path / "whole", **trust)
    half = stopping.stopped_after(scene, tmp_path / "half", 6, **trust)
    resumed = nmm.resume(half, **trust)
    same = np.array_equal(whole.displacement, resumed.displacement)
    assert same == remembers


@pytest.fixture
def stopped(tmp_path):
    """Folder of a run that was stopped after its second checkpoint."""
    return stopped_after(scenes.scene_of("softening", CHECKPOINT), tmp_path / "run", 6)


def test_a_run_that_has_ended_is_not_gone_on_with(tmp_path):
    nmm.run(nmm.parse_scene(scenes.scene_of("softening", CHECKPOINT)), out=tmp_path / "run")
    with pytest.raises(StorageError, match=r"its run has ended \(converged\): expected one that"):
        nmm.resume(tmp_path / "run")


def test_a_folder_without_checkpoint_says_how_to_get_one(tmp_path):
    stopped_after(scenes.scene_of("softening"), tmp_path / "run", 3)
    with pytest.raises(StorageError, match=r"no checkpoint.npz in it: .* \[output\] checkpoint"):
        nmm.resume(tmp_path / "run")
    with pytest.raises(StorageError, match="expected a run folder"):
        nmm.resume(tmp_path)


def rewritten(folder, **changed):
    """Change fields of the header of a checkpoint."""
    path = folder / "checkpoint.npz"
    with np.load(path) as stored:
        arrays = {name: stored[name] for name in stored.files}
    header = json.loads(arrays["header"].item()) | changed
    np.savez(path, **{**arrays, "header": np.array(json.dumps(header))})


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"version": "0.0.1"}, "of another version: version '0.0.1': expected"),
        ({"format": 99}, "of another version: format 99: expected"),
        ({"scene_hash": "ab"}, "of another scene: scene_hash 'ab': expected"),
        ({"formulation_hash": "ab"}, "of another formulation: formulation_hash 'ab': expected"),
    ],
)
def test_a_checkpoint_of_something_else_is_refused(stopped, changed, said):
    rewritten(stopped, **changed)
    with pytest.raises(StorageError, match=said):
        nmm.resume(stopped)
    # The folder was given free and is as it was.
    assert not (stopped / ".lock").exists()
    assert nmm.read_run(stopped).summary.status == "stopped"


def test_a_checkpoint_that_was_cut_off_is_refused_at_every_length(stopped):
    path = stopped / "checkpoint.npz"
    whole = path.read_bytes()
    for share in (0.0, 0.3, 0.6, 0.9, 0.999):
        path.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(DamageError, match="checkpoint.npz: damaged"):
            nmm.resume(stopped)


def test_a_checkpoint_with_a_byte_that_was_changed_is_refused(stopped):
    path = stopped / "checkpoint.npz"
    whole = path.read_bytes()
    with np.load(path) as stored:
        largest = max((stored[name] for name in stored.files if name.isdigit()), key=np.size)
    at = whole.index(largest.tobytes())
    path.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :])
    with pytest.raises(DamageError, match="checkpoint.npz: damaged"):
        nmm.resume(stopped)


def test_an_altered_scene_is_refused(stopped):
    path = stopped / "scene.toml"
    path.write_text(path.read_text().replace("3000000.0", "3100000.0"))
    with pytest.raises(
        StorageError, match=r"scene.toml: missing or altered: expected it as it was"
    ):
        nmm.resume(stopped)


def test_what_was_written_before_the_checkpoint_must_be_there(stopped):
    lines = (stopped / "history.csv").read_text().splitlines(keepends=True)
    (stopped / "history.csv").write_text("".join(lines[:3]))
    with pytest.raises(DamageError, match="2 lines of it can be read: expected the 4 before"):
        nmm.resume(stopped)
    (stopped / "history.csv").write_text("".join(lines))
    (stopped / "frames" / "000001.npz").unlink()
    with pytest.raises(DamageError, match="000001.npz: missing: expected it as the run wrote it"):
        nmm.resume(stopped)


@pytest.mark.parametrize(("name", "said"), [("run.json", "altered"), ("history.csv", "line 2")])
def test_bytes_that_are_no_text_before_the_checkpoint_are_told(stopped, name, said):
    lines = (stopped / name).read_bytes().split(b"\n")
    (stopped / name).write_bytes(b"\n".join([lines[0], b"\xff" + lines[1][1:], *lines[2:]]))
    with pytest.raises(StorageError, match=f"{name}.*{said}"):
        nmm.resume(stopped)


def test_a_run_that_has_lost_its_mark_is_not_gone_on_with(stopped):
    (stopped / "run.json").unlink()
    with pytest.raises(StorageError, match=r"run.json: missing or altered"):
        nmm.resume(stopped)


def test_a_checkpoint_makes_no_object_that_its_reader_does_not_know(stopped):
    path = stopped / "checkpoint.npz"
    with np.load(path) as stored:
        arrays = {name: stored[name] for name in stored.files}
    tree = {"kind": "Popen", "parts": {"args": "true"}}
    np.savez(path, **{**arrays, "tree": np.array(json.dumps(tree))})
    with pytest.raises(DamageError, match="damaged .*Popen"):
        nmm.resume(stopped)


def test_a_run_that_replaces_another_deletes_its_checkpoint(stopped):
    nmm.run(nmm.parse_scene(scenes.scene_of("softening")), out=stopped)
    assert not (stopped / "checkpoint.npz").exists()
