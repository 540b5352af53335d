"""`[output]`: which states are stored, and that nothing else depends on it."""

import numpy as np
import pytest
from typer.testing import CliRunner

import nmm
from nmm.cli.app import app
from nmm.errors import SceneError
from nmm.results.storage.archive import from_file, to_bytes
from nmm.scene.read import scene_hash
from nmm.verification import text

FLOOR = [
    text.material("rock", modulus=1e9, density=2500.0),
    text.interface("any", 30.0),
    text.box("floor", (-1, -1), (3, 1)),
    text.fixed_block("floor"),
]
DROP = text.scene(
    'title = "drop"\nplane = "strain"\nduration = "60 ms"\n[inertia]\n[gravity]\n[contact]\n',
    [
        *FLOOR,
        text.box("stone", (0, 0.001), (1, 0.999)),
        '[formulation.integrator]\nstep = "{step}"\n',
    ],
)

SLIDE = text.scene(
    'title = "a block pushed over its friction"\nplane = "strain"\n[gravity]\n[contact]\n',
    [
        *FLOOR,
        text.box("stone", (0, 0), (1, 1)),
        """
[[loads]]
name = "push"
kind = "point"
point = [0, 0.1]
block = "stone"
force = ["10 kN", 0]
[loading]
until = "failure"
scaled = ["push"]
motion_after_failure = "20 ms"
[formulation.loading]
increment = 0.2
""",
    ],
)


def dropped(output="", step="1 ms"):
    return nmm.run(nmm.parse_scene(DROP.format(step=step) + output))


def pushed(output=""):
    return nmm.run(nmm.parse_scene(SLIDE + output))


def milliseconds(run):
    return [round(1000 * frame.time, 6) for frame in run.frames]


@pytest.mark.parametrize(
    ("output", "step", "expected"),
    [
        ("", "1 ms", range(61)),
        ("[output]", "1 ms", range(61)),
        ("[output]\nevery_steps = 7", "1 ms", [*range(0, 60, 7), 60]),
        ("[output]\nevery_time = '10 ms'", "1 ms", range(0, 61, 10)),
        # The first step that reaches each multiple of 7 ms: 8 for 7, 14, 22 for 21, ...
        ("[output]\nevery_time = '7 ms'", "2 ms", [0, 8, 14, 22, 28, 36, 42, 50, 56, 60]),
        ("[output]\nevery_time = '25 ms'\nevery_steps = 20", "1 ms", [0, 20, 25, 40, 50, 60]),
        ("[output]\nevery_time = '1 us'", "4 ms", range(0, 61, 4)),
        ("[output]\nevery_steps = 1000", "1 ms", [0, 60]),
    ],
)
def test_frames_come_at_the_times_and_steps_asked_for(output, step, expected):
    assert milliseconds(dropped(output, step)) == list(expected)


def test_a_stone_is_stored_when_it_first_touches():
    run = dropped('[output]\nevents = ["first_contact"]')
    # It falls 1 mm in sqrt(2 h / g) = 14.28 ms, and is seen to touch in the step that ends next.
    assert len(run.frames) == 3
    assert 14 <= milliseconds(run)[1] <= 16
    assert run.frames[1].contact_state.max() > 0
    assert milliseconds(run)[2] == 60


def test_each_change_of_the_states_of_contacts_is_stored():
    run = dropped('[output]\nevents = ["state_changes"]')
    counts = np.stack([run.history[name] for name in ("stick", "slide", "bonded", "broken")])
    changed = np.any(np.diff(counts, axis=1, prepend=0) != 0, axis=0)
    expected = {round(1000 * time, 6) for time in run.history["time"][changed]} | {0, 60}
    assert milliseconds(run) == sorted(expected)
    assert len(expected) > 3


def test_the_history_and_the_last_state_do_not_depend_on_what_is_stored():
    whole = dropped()
    few = dropped('[output]\nevery_steps = 13\nevents = ["first_contact", "first_slip"]')
    assert list(whole.history) == list(few.history)
    for name, column in whole.history.items():
        assert np.array_equal(column, few.history[name]), name
    for one, other in ((whole.frames[-1], few.frames[-1]), (whole.frames[0], few.frames[0])):
        assert np.array_equal(one.points, other.points)
        assert np.array_equal(one.stress, other.stress)


def test_growing_loads_store_their_last_equilibrium_and_the_motion_after_it():
    whole, few = pushed(), pushed("[output]\nevery_steps = 4\nevery_time = '5 ms'")
    assert whole.summary.status == "failure_load"
    load = [frame for frame in few.frames if frame.stage == "load"]
    kept = [0, *range(4, len(whole.history["step"]), 4)]
    if kept[-1] != len(whole.history["step"]):
        kept.append(len(whole.history["step"]))
    factors = np.concatenate([[0], whole.history["load_factor"]])
    assert [frame.load_factor for frame in load] == list(factors[kept])
    all_load = [frame for frame in whole.frames if frame.stage == "load"]
    assert [frame.load_factor for frame in all_load] == list(factors)
    assert np.array_equal(load[-1].points, all_load[-1].points)
    assert len([frame for frame in whole.frames if frame.stage == "failure"]) == 20  # each step
    moved = [frame.time for frame in few.frames if frame.stage == "failure"]
    start = load[-1].time
    # By steps of 1 ms: the 4th, 8th, ...; by time: 5, 10, 15 and 20 ms.
    expected = start + 1e-3 * np.array([4, 5, 8, 10, 12, 15, 16, 20])
    assert moved == pytest.approx(expected, abs=1e-12)


def test_the_summary_counts_the_frames_and_books_the_motion_after_failure():
    run = pushed()
    assert run.summary.frames == len(run.frames)
    assert run.summary.seconds["motion after failure"] > 0
    # Of contacts the motion is not counted, as it is no result: the history holds all.
    for name, count in run.summary.largest_contacts.items():
        assert count == run.history[name].max(), name


@pytest.mark.parametrize(
    ("scene", "said"),
    [
        (SLIDE.replace('motion_after_failure = "20 ms"', "") + "[output]\nevery_time = 1",
         "output.every_time: no [inertia]: expected a scene that moves in time"),
        (DROP.format(step="1 ms").replace("[contact]", "") + "[output]\nevents = ['first_slip']",
         "output.events: no [contact]: expected a scene with contact"),
        (DROP.format(step="1 ms") + "[output]\nevents = ['boom']", "output.events"),
        (DROP.format(step="1 ms") + "[output]\nevery_steps = 0", "output.every_steps"),
        (DROP.format(step="1 ms") + "[output]\nevery_time = '-1 s'", "output.every_time"),
        (DROP.format(step="1 ms") + "[output]\nframes = 3", "output.frames"),
    ],
)  # fmt: skip
def test_what_cannot_be_stored_is_told_by_key(scene, said):
    with pytest.raises(SceneError) as fault:
        nmm.parse_scene(scene)
    assert said in str(fault.value)


def test_what_is_stored_is_no_part_of_what_happens():
    plain, asked = (DROP.format(step="1 ms") + more for more in ("", "[output]\nevery_steps = 3"))
    assert scene_hash(nmm.parse_scene(plain)) == scene_hash(nmm.parse_scene(asked))


@pytest.mark.parametrize(
    ("output", "said"),
    [
        ("", "frames: 62 at most, "),
        ("[output]\nevery_steps = 20", "frames: 5 at most, "),
        ("[output]\nevents = ['first_slip']", "frames: 2 at most and one for each event, "),
    ],
)
def test_explain_says_what_frames_take(output, said, tmp_path):
    path = tmp_path / "drop.toml"
    path.write_text(DROP.format(step="1 ms") + output)
    lines = CliRunner().invoke(app, ["explain", str(path)]).stdout.splitlines()
    (line,) = [one for one in lines if one.startswith("frames:")]
    assert line.startswith(said)
    nmm.run(nmm.read_scene(path), out=tmp_path / "run")
    first = tmp_path / "run/frames/000000.npz"  # no contacts are in it
    told = float(line.split(" KiB each")[0].split()[-1]) * 1024
    assert len(to_bytes(from_file(first), packed=False)) == pytest.approx(told, rel=0.25)
    assert first.stat().st_size < told
