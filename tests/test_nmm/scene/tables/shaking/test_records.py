"""Records from files in the usual formats; what is wrong in them is told by their line."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.scene.tables.shaking.records import RecordTable

SCENE = """plane = "strain"
duration = "1 s"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "stone"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[inertia]
[[supports]]
name = "base"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
motion = {{ x = "quake" }}
[records.quake]
{keys}
"""
COLUMNS = "# time, acceleration\nt a\n0.00, 0.0\n0.01, 1.0\n\n0.02, -2.0\n0.03\t0.5\n"
SINGLE = "0.0\n1.0\n-2.0\n0.5\n"
PEER = """PEER NGA STRONG MOTION DATABASE RECORD
SOMEWHERE, 1/1/2000
ACCELERATION TIME SERIES IN UNITS OF G
NPTS=   4, DT=   .0100 SEC,
  .0E+00  .1000E+01 -.2000E+01
  .5000E+00
"""


def read(folder, keys, **files):
    for name, text in files.items():
        (folder / name.replace("__", ".")).write_text(text)
    (folder / "s.toml").write_text(SCENE.format(keys=keys))
    return nmm.read_scene(folder / "s.toml")


def told(folder, keys, **files):
    with pytest.raises(SceneError) as caught:
        read(folder, keys, **files)
    return str(caught.value).replace(f"{folder}/", "")


@pytest.mark.parametrize(
    ("keys", "factor"),
    [
        ('file = "a.txt"', 1.0),
        ('file = "b.txt"\nstep = "10 ms"', 1.0),
        ('file = "c.at2"\nunit = "g"', 9.80665),
        ('file = "a.txt"\nunit = "cm/s^2"\nscale = 2', 0.02),
        ("values = [0.0, 1.0, -2.0, 0.5]\nstep = 0.01", 1.0),
    ],
)
def test_the_usual_formats_give_the_same_motion(tmp_path, keys, factor):
    scene = read(tmp_path, keys, a__txt=COLUMNS, b__txt=SINGLE, c__at2=PEER)
    times, values = scene.records["quake"].times_and_values
    assert times == pytest.approx([0, 0.01, 0.02, 0.03])
    assert values == pytest.approx(factor * np.array([0, 1, -2, 0.5]))


def test_a_scene_that_has_read_its_file_depends_on_it_no_more(tmp_path):
    from nmm.scene import scene_hash

    scene = read(tmp_path, 'file = "a.txt"', a__txt=COLUMNS)
    assert scene.records["quake"].file is None
    other = read(tmp_path, "samples = [[0, 0], [0.01, 1], [0.02, -2], [0.03, 0.5]]")
    assert scene_hash(scene) == scene_hash(other)


@pytest.mark.parametrize(
    ("keys", "files", "said"),
    [
        ('file = "no.txt"', {}, "no.txt: No such file or directory: expected a file of numbers"),
        ('file = "a.txt"', {"a__txt": "0 1\n0.1 x\n0.2 1\n"}, 'a.txt:2: "0.1 x": expected numbers'),
        ('file = "a.txt"', {"a__txt": "0 1\n0.1 nan\n"}, 'a.txt:2: "0.1 nan": expected numbers'),
        ('file = "a.txt"', {"a__txt": "0 1\n0.1 2\n0.1 3\n"}, "a.txt:3: t = 0.1"),
        (
            'file = "a.txt"',
            {"a__txt": "0 1\n0.1 2\n0.2 3\n0.4 3\n0.5 1\n"},
            "a.txt:4: a gap of 0.2 s: expected the next value 0.1 s after the last",
        ),
        ('file = "a.txt"', {"a__txt": "0 1 2\n0.1 2 3\n"}, "a.txt:1: 3 columns"),
        ('file = "a.txt"\nstep = 0.1', {"a__txt": "1\n2\n3 4\n"}, "a.txt:3: more than one column"),
        (
            'file = "c.at2"\nunit = "g"',
            {"c__at2": PEER.replace("4,", "5,")},
            "c.at2:4: 4 values: expected 5",
        ),
        ('file = "c.at2"\nunit = "g"', {"c__at2": "nothing\n"}, 'expected a line "NPTS='),
        ('file = "c.at2"', {"c__at2": PEER}, "c.at2: no unit: expected that of its third line"),
        ('file = "c.vt2"\nunit = "g"', {"c__vt2": PEER}, 'write quantity = "velocity"'),
        ('file = "c.at2"\nunit = "g"\nstep = 0.02', {"c__at2": PEER}, "step = 0.02: expected none"),
        ("values = [1, 2]", {}, "values without step"),
        ("samples = [[0, 1], [0, 2]]", {}, "t = 0 after 0 (sample 2): expected times that"),
        ('values = [1, 2]\nstep = 1\nunit = "kg"', {}, '"kg": expected a unit of m/s^2'),
        ('values = [1, 2]\nstep = 1\nfile = "a"', {}, "file, values: expected file, samples or"),
        (
            'values = [1, 2]\nstep = 1\nquantity = "velocity"\nbaseline = "velocity"',
            {},
            "with a baseline correction",
        ),
    ],
)
def test_wrong_records_are_told_by_line(tmp_path, keys, files, said):
    assert said in told(tmp_path, keys, **files)


def test_faults_of_a_file_are_told_with_the_line_of_the_scene_that_names_it(tmp_path):
    said = told(tmp_path, 'file = "a.txt"', a__txt="0 1\n0.1 x\n0.2 y\n").splitlines()
    line = next(
        number
        for number, one in enumerate(SCENE.format(keys='file = "a.txt"').splitlines(), 1)
        if one.startswith("file")
    )
    assert len(said) == 2
    assert all(f".toml:{line}: records.quake.file: " in one for one in said)


def test_a_motion_needs_its_record_and_time(tmp_path):
    keys = "values = [1, 2]\nstep = 1"
    text = SCENE.format(keys=keys).replace("records.quake", "records.quak")
    with pytest.raises(SceneError, match='s.toml:16: .*"quake": expected the name of one of'):
        nmm.parse_scene(text, "s.toml")
    text = SCENE.format(keys=keys).replace("[inertia]\n", "").replace('duration = "1 s"\n', "")
    with pytest.raises(SceneError, match=r"no \[inertia\]: expected a dynamic scene"):
        nmm.parse_scene(text, "s.toml")


def test_a_record_of_g_is_in_standard_gravity():
    assert RecordTable(values=[0, 1], step=1, unit="g").times_and_values[1] == [0, 9.80665]


def test_samples_may_have_times_with_a_unit():
    record = RecordTable.model_validate({"samples": [[0, 0], ["0.5 h", 1], ["36 min", 0]]})
    assert [time for time, _ in record.samples] == [0.0, 1800.0, 2160.0]
