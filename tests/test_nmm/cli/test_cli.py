"""The command line: each verb by what it prints, writes and returns."""

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from typer.testing import CliRunner

from nmm.cli.app import app
from nmm.cli.terminal import console
from nmm.results import RunFolder, read_run
from nmm.shipped import example, starter


def call(*words):
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """The starter scene, cut to five steps, with a reference that holds and one that does not."""
    path = tmp_path_factory.mktemp("scene") / "short.toml"
    reference = '[[reference]]\nquantity = "{}"\nvalue = {}\ntolerance = 0.1\nsource = "hand"\n'
    known = (("blocks", 2), ("steps", 99), ("failure_load", 1.0))
    references = "".join(reference.format(*item) for item in known)
    path.write_text(starter().replace('"0.5 s"', '"5 ms"') + references)
    return path


@pytest.fixture(scope="module")
def finished(scene, tmp_path_factory):
    """The outcome of `nmm run` on the short scene, and its folder."""
    out = tmp_path_factory.mktemp("run") / "short"
    return call("run", scene, "--out", out), out


def test_help_names_every_verb():
    text = call("--help").stdout
    assert all(verb in text for verb in ("run", "demo", "check", "explain", "new", "plot"))


def test_help_names_tables_and_lets_paragraphs_flow():
    shown = call("run", "--help").stdout
    assert "where the scene's [output] asks for them" in " ".join(shown.split())
    # A line of the source is no line of the help.
    assert not any(line.strip() == "when the structure" for line in shown.splitlines())


def test_a_reader_that_has_enough_is_no_fault():
    command = f'{sys.executable} -c "from nmm.cli.app import app; app()" parts | head -1'
    done = subprocess.run(command, shell=True, capture_output=True, text=True, check=False)
    assert done.stdout.startswith("cover")
    assert done.stderr == ""


def test_version_is_printed():
    import nmm

    assert call("--version").stdout == f"nmm {nmm.__version__}\n"


def test_a_run_prints_its_verdict_first_and_its_files_last(finished):
    result, out = finished
    assert result.exit_code == 0, result.output
    lines = result.stdout.splitlines()
    assert lines[0] == read_run(out).summary.sentence
    files = [line for line in lines if line.startswith(str(out))]
    assert files == [str(out)]
    assert not (out / "pictures").exists()
    assert not (out / "paraview").exists()
    assert lines[-1] == f"next: nmm plot {out}   or: nmm export {out} for ParaView"


def test_pictures_and_paraview_files_are_made_as_a_run_ends_where_its_scene_asks(scene, tmp_path):
    asking, out = tmp_path / "asking.toml", tmp_path / "run"
    asking.write_text(scene.read_text() + "[output]\npictures = true\nparaview = true\n")
    lines = call("run", asking, "--out", out).stdout.splitlines()
    files = [line for line in lines if line.startswith(str(out))]
    assert len(files) >= 5
    assert all(Path(file).exists() for file in files)
    assert f"{out}/pictures/deformed.png" in files
    assert f"{out}/paraview/blocks.pvd" in files


def test_a_run_is_exported_for_paraview_afterwards(finished, tmp_path):
    out = Path(shutil.copytree(finished[1], tmp_path / "run"))
    result = call("export", out)
    assert result.exit_code == 0, result.output
    opened = result.stdout.split()
    assert opened[0] == f"{out}/paraview/blocks.pvd"
    assert all(Path(file).exists() for file in opened)


def test_names_between_colons_are_printed_as_they_are(capsys):
    console().print("monitor:top:ux")
    assert capsys.readouterr().out == "monitor:top:ux\n"


def test_a_run_is_compared_with_the_references_of_its_scene(finished):
    text = finished[0].stdout
    assert "blocks 2, reference 2 (+0.00 %, within the tolerance of 10 %): hand" in text
    assert "steps 5, reference 99 (-94.95 %, outside" in text
    assert "failure_load not found, reference 1 (+nan %, outside" in text


def test_the_folder_keeps_scene_and_formulation_as_run(finished):
    stored = read_run(finished[1])
    assert tomllib.loads(stored.scene)["title"] == "Block on a slope"
    assert tomllib.loads(stored.formulation)["integrator"]["step"] == 1e-3
    assert stored.summary.steps == len(stored.history["time"]) == 5


def test_quiet_prints_the_verdict_only(scene, tmp_path):
    result = call("run", scene, "--out", tmp_path / "run", "--quiet")
    assert result.exit_code == 0
    assert "unknowns" not in result.stdout
    assert str(tmp_path) not in result.stdout


def test_each_step_says_how_many_contacts_stick_and_slide_when_asked(scene, tmp_path):
    lines = call("run", scene, "--out", tmp_path / "run", "--steps").stdout.splitlines()
    told = [line for line in lines if "contacts:" in line]
    assert len(told) == 5
    # The slope is steeper than the angle of friction: both corners of the block slide.
    assert told[-1].startswith("100.0 %")
    assert told[-1].endswith("contacts: 2 slide")


def test_a_run_without_out_takes_a_free_name(scene, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "runs/short").mkdir(parents=True)
    result = call("run", scene, "--quiet")
    assert result.exit_code == 0, result.output
    assert (tmp_path / "runs/short-2/summary.json").exists()


def test_a_run_whose_budget_was_spent_is_gone_on_with(scene, finished, tmp_path):
    checkpointed = tmp_path / "checkpointed.toml"
    lasting = scene.read_text() + "[output.checkpoint]\nevery_steps = 2\n"
    checkpointed.write_text(lasting)
    spent = call("run", checkpointed, "--out", tmp_path / "run", "-q", "--budget", "0")
    assert spent.exit_code == 3, spent.output
    result = call("run", "--resume", tmp_path / "run")
    assert result.exit_code == 0, result.output
    assert result.stdout.splitlines()[0] == read_run(finished[1]).summary.sentence
    assert read_run(tmp_path / "run").summary.steps == 5


def test_a_run_needs_a_scene_or_a_folder_to_go_on_with_and_not_both(scene, tmp_path):
    neither = call("run")
    assert neither.exit_code == 1
    assert "SCENE: missing: expected a scene file, or --resume" in neither.stderr
    both = call("run", scene, "--resume", tmp_path)
    assert both.exit_code == 1
    assert f"SCENE: {scene}: expected none beside --resume" in both.stderr
    assert "expected a run folder" in call("run", "--resume", tmp_path).stderr


def test_a_formulation_file_replaces_the_scenes_own(scene, tmp_path):
    other = tmp_path / "other.toml"
    other.write_text('[integrator]\nstep = "2.5 ms"\n')
    result = call("run", scene, "--formulation", other, "--out", tmp_path / "run", "-q")
    assert result.exit_code == 0, result.output
    assert read_run(tmp_path / "run").summary.steps == 2


def test_a_run_into_a_folder_of_something_else_is_refused(scene, tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    result = call("run", scene, "--out", tmp_path)
    assert result.exit_code == 1
    assert "not a run folder" in result.stderr


def test_check_names_every_fault_of_both_files(tmp_path):
    scene, formulation = tmp_path / "a.toml", tmp_path / "f.toml"
    scene.write_text(starter().replace('"strain"', '"stain"', 1).replace("poisson_ratio", "nu", 1))
    formulation.write_text("[integrator]\nstep = -1\n")
    result = call("check", scene, "--formulation", formulation)
    assert result.exit_code == 1
    assert f'{scene}:6: plane: "stain"' in result.stderr
    assert "poisson_ratio" in result.stderr
    assert f"{formulation}:2: integrator.step" in result.stderr
    assert result.stderr.splitlines()[-1].endswith("faults")


def test_check_finds_faults_of_geometry(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(starter().replace("[5.196152422706632, 3]]", "[5.196152422706632, 0]]", 1))
    result = call("check", path)
    assert result.exit_code == 1
    assert str(path) in result.stderr


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"rigid_strain"', '"rigid_strian"', 'cover.functions: local functions: "rigid_strian"'),
        ('"block"  ', '"blok"  ', 'or "module:Name" of your own: did you mean "block"?'),
        ('"1 ms"', '"1 ms"\ntype = "newmarc"', 'did you mean "newmark"?'),
        (
            '"1 ms"',
            '"1 ms"\ntype = "newmark"\n[formulation.integrator.options]\nbeta = "x"',
            'integrator "newmark": beta: "x": expected a number',
        ),
        ("density =", 'law = "plastic"\ndensity =', 'materials.rock.law: material law: "plastic"'),
        ("# cohesion", 'law = "x"\n# cohesion', 'interfaces.joint.law: interface law: "x"'),
    ],
)
def test_check_names_parts_that_do_not_exist_with_their_line(old, new, said, tmp_path):
    path = tmp_path / "a.toml"
    assert old in starter()
    path.write_text(starter().replace(old, new, 1))
    result = call("check", path)
    assert result.exit_code == 1
    (line, count) = result.stderr.splitlines()
    assert line.startswith(f"{path}:")
    assert said in line
    assert count == "1 fault"


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ('enforcement = "penality"', 'contact.enforcement: "penality"'),
        ("options = {toleranc = 1e-9}", "toleranc: expected one of iterations, iteration"),
    ],
)
def test_a_wrong_enforcement_is_named_by_check_and_by_run(table, said, scene, tmp_path):
    chosen = tmp_path / "f.toml"
    chosen.write_text(f"[contact]\n{table}\n")
    for verb in ("check", "run"):
        result = call(verb, scene, "--formulation", chosen)
        assert result.exit_code == 1
        assert f"{chosen}:2: " in result.stderr
        assert said in result.stderr


def test_a_place_that_cannot_be_written_is_one_line(scene, tmp_path):
    (tmp_path / "file").write_text("")
    result = call("run", scene, "--out", tmp_path / "file" / "run")
    assert result.exit_code == 1
    (line,) = result.stderr.splitlines()
    assert line.startswith(str(tmp_path / "file"))
    assert "cannot be written, not a directory: expected a folder that can be made" in line


def test_check_passes_a_sound_scene(scene):
    result = call("check", scene)
    assert result.exit_code == 0, result.output
    assert result.stdout.splitlines()[0] == "no faults"


def test_a_missing_scene_is_one_line():
    result = call("run", "nothing.toml")
    assert result.exit_code == 1
    assert result.stderr.splitlines() == [
        "nothing.toml: No such file or directory: expected a TOML file: check the path"
    ]


def test_explain_says_what_is_simulated_and_what_would_call_for_the_rest(scene):
    result = call("explain", scene)
    assert result.exit_code == 0, result.output
    simulated, others = (
        {
            cells[1].strip(): cells[2].strip()
            for cells in (line.split("│") for line in part.splitlines())
            if len(cells) > 2
        }
        for part in result.stdout.split("not simulated")
    )
    assert {"gravity", "inertia", "contact"} <= set(simulated)
    assert "loads" not in simulated
    assert others["loads"] == "[[loads]] with force or traction"
    assert "unknowns: 12" in result.stdout  # two blocks of six


def test_explain_says_how_time_passes_in_stages_without_inertia(tmp_path):
    text = starter().replace("[inertia]", "").replace('duration = "', '# "')
    (tmp_path / "a.toml").write_text(text + '[[stages]]\nname = "later"\nduration = "2 s"\n')
    result = call("explain", tmp_path / "a.toml")
    assert result.exit_code == 0, result.output
    assert "stages: later (2 s)" in result.stdout
    assert "no inertia" in result.stdout


def test_a_scene_may_name_a_law_of_a_module_beside_it(scene, tmp_path):
    (tmp_path / "my_laws.py").write_text(
        "from nmm.materials.elastic import Elastic\nclass Mine(Elastic):\n    pass\n"
    )
    path = tmp_path / "a.toml"
    path.write_text(starter().replace("[materials.rock]", '[materials.rock]\nlaw = "my_laws:Mine"'))
    result = call("explain", path, "--allow-code", "my_laws")
    assert result.exit_code == 0, result.output


def test_new_writes_a_scene_that_is_sound_and_refuses_to_replace_one(tmp_path):
    path = tmp_path / "slope.toml"
    assert call("new", tmp_path / "slope").exit_code == 0
    assert call("check", path).exit_code == 0
    path.write_text("mine")
    result = call("new", path)
    assert result.exit_code == 1
    assert path.read_text() == "mine"
    assert call("new", "").exit_code == 1
    call("new", tmp_path / "slope.v2")
    assert (tmp_path / "slope.v2.toml").exists()


def test_a_stopped_run_can_be_drawn(tmp_path, write_run):
    class Stopped(RunFolder):
        def finish(self, summary):
            pass

    write_run(Stopped(tmp_path / "run"), blocks=10, frames=2)
    result = call("plot", tmp_path / "run", "--frame", 1, "--component", "xx")
    assert result.exit_code == 0, result.output
    drawn = {Path(line).name for line in result.stdout.splitlines()}
    assert {"deformed.png", "stress_xx.png", "contact_forces.png", "history.png"} <= drawn


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--frame", 9], "--frame 9: expected -2 to 1: the run has 2"),
        (["--component", "zz"], "component 'zz': expected one of mises"),
    ],
)
def test_plot_refuses_what_a_run_does_not_have(options, message, tmp_path, write_run):
    write_run(RunFolder(tmp_path / "run"), blocks=10, frames=2)
    result = call("plot", tmp_path / "run", *options)
    assert result.exit_code == 1
    assert message in result.stderr


def test_a_run_without_frames_draws_its_history_alone_and_says_so(tmp_path, write_run):
    write_run(RunFolder(tmp_path / "run"), blocks=10, frames=2)
    for frame in (tmp_path / "run/frames").iterdir():
        frame.unlink()
    drawn, written = call("plot", tmp_path / "run"), call("export", tmp_path / "run")
    assert (drawn.exit_code, written.exit_code) == (1, 1)
    assert "history.png" in drawn.stdout
    assert "no frame: expected one for pictures of blocks: run it again" in drawn.stderr
    assert "nothing to export: expected frames: run it again" in written.stderr
    assert not (tmp_path / "run/paraview").exists()
    message = "--frame 0: expected none: the run has 0"
    assert message in call("plot", tmp_path / "run", "--frame", 0).stderr


def test_what_to_try_next_can_be_typed_where_a_name_has_blanks(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert "nmm check 'a slope.toml'   or: nmm run 'a slope.toml'" in call("new", "a slope").stdout


@pytest.mark.parametrize("sizes", ["a,b", "0.2,", "0.2,-0.1"])
def test_sizes_that_are_no_lengths_are_refused_before_anything_runs(sizes, scene):
    result = call("cost", scene, f"--sizes={sizes}")
    assert result.exit_code == 1
    assert f"--sizes {sizes}: expected lengths in m, with commas" in result.stderr


def test_the_demo_scene_is_found():
    assert example("kitoh_beam/kitoh_130.toml").is_file()
