"""Spoilt files: every one of thousands is refused by line or prepared as it stands, in time."""

import tomllib
import warnings

import numpy as np
import pytest

import nmm
from nmm.formulation import parse_formulation
from nmm.scene import Scene, parse_scene
from nmm.stepping.drive.verdict import MEANT
from nmm.verification.hard.oracles.echoes import lost
from nmm.verification.hard.spoilt.mutations import bases, shrunk, sound_files, spoilt, verdict
from nmm.verification.hard.spoilt.mutators import keys_of
from nmm.verification.hard.spoilt.sound_files import formulations, minimal

FEW, MANY = 30, 50_000
DYNAMIC, STATIC = minimal()["dynamic"], minimal()["static"]


def _keys(table):
    """All keys of a file's tables, those of tables in tables too."""
    for key, value in table.items() if isinstance(table, dict) else ():
        yield key
        for inner in value if isinstance(value, list) else [value]:
            yield from _keys(inner)


def faults(base, seed, numbers):
    """What is wrong with some of the spoilt files made of one; reduced to what it takes."""
    found = {}
    for number in numbers:
        text, kind = spoilt(base, seed, number)
        one = verdict(text, kind)
        if not one.good:
            reduced = text if one.outcome == "late" else shrunk(text, kind, one.outcome)
            found[number] = f"{one.outcome}: {one.words}\n{reduced}"
    return found


@pytest.mark.parametrize("base", bases())
def test_a_spoilt_file_is_refused_by_line_or_prepared_as_it_stands(base):
    assert not faults(base, 0, range(FEW))


@pytest.mark.slow
@pytest.mark.parametrize("base", bases(fast=False))
def test_files_that_are_spoilt_are_sound_before(base):
    kind, text = sound_files()[base]
    assert verdict(text, kind).outcome == "sound"


@pytest.mark.slow
def test_every_key_of_a_scene_stands_in_a_file_that_is_spoilt():
    said = {key for _, text in sound_files().values() for key in _keys(tomllib.loads(text))}
    # Tables of one's own and files beside the scene are refused before anything else is read.
    assert set(keys_of(Scene)) - said <= {"effects", "file"}


@pytest.mark.slow
@pytest.mark.parametrize("base", bases(fast=False))
def test_fifty_thousand_spoilt_files_hold_no_silent_fault(base):
    assert not faults(base, 1, range(-(-MANY // len(bases(fast=False)))))


def check_that_it_runs(base, seed, numbers):
    """Run the spoilt files of one that are prepared as they stand, for some seconds each."""
    for number in numbers:
        text, kind = spoilt(base, seed, number)
        if verdict(text, kind).outcome != "sound":
            continue
        scene = parse_scene(text if kind == "scene" else DYNAMIC)
        method = parse_formulation(text) if kind == "formulation" else None
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            run = nmm.run(scene, method, budget=4)
        assert run.summary.status in MEANT, (number, text)
        if run.summary.status in ("converged", "failure_load"):
            assert not any(np.isinf(column).any() for column in run.history.values()), text
            assert np.isfinite(run.frames[-1].points).all(), (number, text)


@pytest.mark.parametrize("base", ["static", "jointed", "loaded"])
def test_a_spoilt_file_that_is_prepared_runs_to_a_verdict(base):
    check_that_it_runs(base, 2, range(8))


@pytest.mark.slow
@pytest.mark.parametrize("base", bases())
def test_spoilt_files_that_are_prepared_run_to_a_verdict(base):
    check_that_it_runs(base, 3, range(60))


def test_the_sound_files_are_sound():
    small = [name for name in bases() if name != "formulation method"]
    assert [verdict(minimal()[name]).outcome for name in small] == ["sound"] * len(small)
    assert verdict(formulations()["method"], "formulation").outcome == "sound"


def test_the_same_seed_spoils_in_the_same_way():
    assert spoilt("static", 3, 7) == spoilt("static", 3, 7)
    assert spoilt("static", 3, 7) != spoilt("static", 3, 8)


@pytest.mark.parametrize(
    ("text", "outcome"),
    [
        ("plane = 'strain'", "refused"),
        (STATIC, "sound"),
        (STATIC.replace("0.2", "0.2" + "0" * 300), "sound"),
        (STATIC.replace('"1 GPa"', '"1e999 GPa"'), "refused"),
    ],
)
def test_verdicts_of_texts_that_are_known(text, outcome):
    assert verdict(text).outcome == outcome


def test_a_reader_that_drops_or_turns_a_value_is_found_out():
    scene = parse_scene(STATIC)
    said = scene.model_dump(by_alias=True, exclude_unset=True)
    assert not list(lost(said, scene))
    assert list(lost({**said, "thickness": 2.0}, scene)) == ["thickness"]
    assert list(lost({**said, "blocks": [*said["blocks"]] * 2}, scene)) == ["blocks"]
    turned = Scene.model_construct(**{**dict(scene), "seed": True})
    assert list(lost({"seed": 1}, turned)) == ["seed"]


def test_a_traceback_a_hang_and_a_fault_without_a_line_are_found_out(monkeypatch):
    from nmm.stepping import prepare

    def broken(scene, formulation):
        raise IndexError("index -1")

    def endless(scene, formulation):
        while True:
            pass

    def curt(scene, formulation):
        raise nmm.NmmError("no")

    for wrong, outcome in ((broken, "IndexError in broken"), (endless, "late"), (curt, "told")):
        monkeypatch.setattr(prepare, "prepare", wrong)
        assert verdict(DYNAMIC, longest=0.3).outcome.startswith(outcome)


def test_a_spoilt_text_is_reduced_to_the_lines_that_it_takes(monkeypatch):
    from nmm.stepping import prepare

    def breaks(scene, formulation):
        if scene.loads:
            raise IndexError

    monkeypatch.setattr(prepare, "prepare", breaks)
    outcome = verdict(STATIC).outcome
    reduced = shrunk(STATIC, "scene", outcome)
    assert verdict(reduced).outcome == outcome
    assert "[[monitors]]" not in reduced
    assert "[[loads]]" in reduced


# Found by such files and reduced by hand: all of them were tracebacks.
@pytest.mark.parametrize(
    ("more", "said"),
    [
        ('[formulation.cover]\ntype = "quads"\nsize = 5e8\n', "check its unit"),
        ('[formulation.cover]\ntype = "graded"\nsize = 1e-30\n', "expected: take a larger size"),
        ('[formulation.cover]\ntype = "graded"\nsize = 0.005\ndegree = 0\n', "80,000 cells"),
        (
            '[formulation.cover]\ntype = "triangles"\nsize = 0.3\n[formulation.cover.enrichment]\n'
            "corners = [[0, 0]]\n",
            "re-entrant",
        ),
        (
            '[formulation.cover]\ntype = "sub_blocks"\nsize = 0.5\noptions = { stiffness = "x" }\n',
            "stiffness",
        ),
        ('[formulation.cover]\ntype = "block"\nsize = 0.5\n', "blocks have no net"),
        (
            '[[joint_sets]]\nname = "j"\ndip = 0.3\nspacing = 0.4\norigin = [5e8, 0.5]\n',
            "move it nearer",
        ),
        ('[heat]\n[[temperatures]]\nname = "t"\nblock = { a = 1 }\ntemperature = 1\n', "name"),
        ('[[cracks]]\nname = "k"\npoints = [[0.5, 0.2], [0.5, 0.8]]\n', "file.toml: [cover] type"),
        ("[formulation.contact]\nmax_passes = 1" + "0" * 30 + "\n", "contact.max_passes"),
    ],
)
def test_what_was_a_traceback_is_a_line(more, said):
    text = STATIC + more
    found = verdict(text)
    assert found.outcome == "refused", found
    assert said in found.words


def test_a_segment_without_length_holds_no_temperature():
    heated = minimal()["heated"]
    found = verdict(heated.replace("segment = [[0, 1], [1, 1]]", "segment = [[1, 1], [1, 1]]"))
    assert found.outcome == "refused"
    assert "convections" in found.words


def test_discs_reach_other_places_than_the_ends_of_edges_in_contacts_too():
    method = parse_formulation('[cover]\ntype = "mls"\nsize = 0.2\ndegree = 1\n')
    mesh = parse_formulation('[cover]\ntype = "quads"\nsize = 0.2\ndegree = 2\n')
    still = DYNAMIC.replace("velocity = [0.1, 0]", "velocity = [0, 0]")
    still = still.replace("angular_velocity = 0.1", "angular_velocity = 0")
    down = [nmm.run(parse_scene(still), one).displacement[:, 1].min() for one in (method, mesh)]
    # Two meshes of one fall and bounce in the same way; the fields differ by the net.
    assert down[0] == pytest.approx(down[1], rel=0.5)
