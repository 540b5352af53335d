"""Files are data: no key of any of them runs code, reads devices or leaves the folder of a run."""

import os
import shutil
import sys
from collections.abc import Iterator, Mapping
from typing import Any, get_args, get_origin

import pytest
import tomli_w
from pydantic import BaseModel
from typer.testing import CliRunner

import nmm
from nmm.cli.app import app
from nmm.formulation import Formulation, parse_formulation
from nmm.scene import Scene, parse_scene
from nmm.scene.document import parse
from nmm.stepping.prepare import prepare
from nmm.study.sweep.study_file import StudyPlan
from nmm.trust import allowing
from nmm.verification.published import Expected

# A module that says that it ran, with a class for every base and a function.
HOSTILE = """
from pathlib import Path
Path({marker!r}).write_text("imported")
def call(*given, **options):
    Path({marker!r}).write_text("called")
class Part:
    def __init__(self, *given, **options):
        call()
"""
CODE = (
    *("hostile:call", "hostile:Part", "os:system", "shutil:rmtree", "builtins:eval"),
    *("nmm.materials.elastic:Elastic", "subprocess:Popen", "pickle:loads"),
)
SCENE: dict[str, Any] = {
    "title": "t",
    "plane": "strain",
    "duration": 1e-3,
    "materials": {"m": {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 1e3}},
    "interfaces": {"i": {"friction_angle": 0.5, "cohesion": 1e6, "bonded": True}},
    "blocks": [{"name": "b", "material": "m", "vertices": [[0, 0], [1, 0], [1, 1], [0, 1]]}],
    "tessellations": [
        {"name": "v", "material": "m", "region": [[2, 0], [3, 0], [3, 1], [2, 1]], "blocks": 2}
    ],
    "joint_sets": [{"name": "j", "block": "b", "dip": 0.3, "spacing": 0.4, "origin": [0.5, 0.5]}],
    "supports": [{"name": "s", "segment": [[0, 0], [1, 0]], "fix": ["x", "y"]}],
    "loads": [{"name": "l", "kind": "point", "point": [1, 1], "force": [1, 0]}],
    "gravity": {},
    "inertia": {},
    "contact": {},
    "initial_velocities": [{"block": "b"}],
    "initial_stresses": [{"block": "b", "stress": [0, 0, 0]}],
    "monitors": [{"name": "o", "point": [1, 1]}],
    "output": {"quantities": ["von_mises"]},
    "reference": [{"quantity": "steps", "value": 1, "tolerance": 1, "source": "x"}],
}
METHOD: dict[str, Any] = {
    "cover": {"type": "triangles", "size": 0.5},
    "contact": {"enforcement": "cone"},
    "integrator": {"type": "newmark"},
    "solver": {"type": "lu"},
}
STUDY: dict[str, Any] = {"scene": "scene.toml", "vary": {"thickness": [1.0]}}
EXPECTED: dict[str, Any] = {"values": [{"quantity": "steps", "value": 1, "tolerance": 1.0}]}

Path = tuple[str | int, ...]


def keys(model: type[BaseModel], at: Path = ()) -> Iterator[Path]:
    """Every key of a model and of the tables in it; tables by name are called x, rows 0."""
    for name, info in model.model_fields.items():
        path = (*at, info.alias or name)
        yield path
        inner = table_of(info.annotation)
        if get_origin(info.annotation) in (dict, Mapping):
            yield (*path, "x")
        if inner is not None:
            many = get_origin(info.annotation) is tuple or "tuple[" in str(info.annotation)
            named = get_origin(info.annotation) is dict
            yield from keys(inner, (*path, *((0,) if many else ("m",) if named else ())))


def table_of(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((found for one in get_args(annotation) if (found := table_of(one))), None)


def with_value(tables: Any, path: Path, value: Any) -> Any:
    """A copy of tables with a value at a path, which is made where it is missing."""
    if not path:
        return value
    first, *rest = path
    if isinstance(first, int):
        rows = list(tables) if isinstance(tables, list) else []
        rows += [{}] * (first + 1 - len(rows))
        return [*rows[:first], with_value(rows[first], tuple(rest), value), *rows[first + 1 :]]
    table = dict(tables) if isinstance(tables, dict) else {}
    return {**table, first: with_value(table.get(first), tuple(rest), value)}


@pytest.fixture
def watched(tmp_path, monkeypatch):
    """A folder with hostile modules in it; what they or the system's own commands do is seen."""
    marker = tmp_path / "marker"
    for name in ("hostile", "uncertainties", "sparseqr"):  # two are optional imports of libraries
        (tmp_path / f"{name}.py").write_text(HOSTILE.format(marker=str(marker)))

    def never(*given, **options):
        raise AssertionError(f"called with {given}")

    monkeypatch.setattr(os, "system", never)
    monkeypatch.setattr(shutil, "rmtree", never)
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    assert not marker.exists(), marker.read_text()
    assert "hostile" not in sys.modules
    assert str(tmp_path) not in sys.path


def attempts(tables: dict[str, Any], model: type[BaseModel]) -> Iterator[dict[str, Any]]:
    for path in dict.fromkeys(keys(model)):
        naming = path[-1] in ("law", "type", "enforcement", "functions", "options", "quantities")
        for code in CODE if naming else CODE[:1]:
            yield with_value(tables, path, code)
            if path[-1] == "quantities":
                yield with_value(tables, path, [code])
            if path[-1] == "options":
                yield with_value(tables, path, {"command": code, "path": code, code: code})
            elif path[-1] in ("law", "type", "enforcement", "functions"):
                options = with_value(tables, (*path[:-1], "options"), {"command": "echo"})
                yield with_value(options, path, code)


def test_every_kind_of_key_is_walked():
    found = set(keys(Scene)) | set(keys(Formulation))
    assert ("materials", "m", "law") in found
    assert ("interfaces", "m", "options", "x") in found
    assert ("tessellations", 0, "seed") in found
    assert ("formulation", "cover", "regions", 0, "polygon") in found
    assert ("solver", "type") in found
    assert ("effects", "m", "type") in found
    assert ("output", "quantities") in found
    assert len(found) > 200


@pytest.mark.parametrize("kind", ["scene", "formulation", "study", "expected"])
def test_no_key_runs_code(watched, kind):
    base, model = {
        "scene": (SCENE, Scene),
        "formulation": (METHOD, Formulation),
        "study": (STUDY, StudyPlan),
        "expected": (EXPECTED, Expected),
    }[kind]
    (watched / "scene.toml").write_text(tomli_w.dumps(SCENE))
    ran = 0
    for tables in attempts(base, model):  # thousands
        text = tomli_w.dumps(tables)
        try:
            ran += use(kind, text, watched)
        except nmm.NmmError:
            continue
    assert ran  # keys that may hold any text leave a scene that is sound


def use(kind: str, text: str, folder: Any) -> bool:
    """Do with a file what check, explain and the verbs of studies do before they run it."""
    if kind == "scene":
        scene = parse_scene(text, str(folder / "scene.toml"))
        prepare(scene, scene.formulation or Formulation())
    elif kind == "formulation":
        prepare(parse_scene(tomli_w.dumps(SCENE)), parse_formulation(text))
    elif kind == "study":
        from nmm.study.sweep.study_file import read_plan

        (folder / "study.toml").write_text(text)
        read_plan(folder / "study.toml")
    else:
        from nmm.scene.document import parse

        parse(text, Expected, "expected.toml", nmm.NmmError)
    return True


HOLD = {"materials": {"m": {**SCENE["materials"]["m"], "law": "hostile:Part"}}}


@pytest.mark.parametrize("verb", ["check", "explain", "run", "cost", "compare"])
def test_verbs_run_no_module_beside_a_scene(watched, verb):
    (watched / "scene.toml").write_text(tomli_w.dumps({**SCENE, **HOLD}))
    result = CliRunner().invoke(app, [verb, "scene.toml"])
    assert result.exit_code == 1
    assert "--allow-code hostile" in result.output


def test_a_published_case_runs_no_code(watched):
    case = watched / "case"
    case.mkdir()
    shutil.copyfile(watched / "hostile.py", case / "hostile.py")
    (case / "scene.toml").write_text(tomli_w.dumps({**SCENE, **HOLD}))
    (case / "expected.toml").write_text(tomli_w.dumps(EXPECTED))
    result = CliRunner().invoke(app, ["verify", "case"])
    assert result.exit_code == 1
    assert "--allow-code hostile" in result.output


def test_a_run_folder_is_drawn_without_its_code(watched, bar_text):
    text = bar_text(more="[formulation.cover]\ntype = 'triangles'\nsize = 0.5\n")
    nmm.run(parse_scene(text), out=watched / "run")
    method = watched / "run" / "formulation.toml"
    method.write_text(method.read_text().replace('"triangles"', '"hostile:Part"'))
    result = CliRunner().invoke(app, ["plot", "run"])
    assert result.exit_code == 1
    assert "deformed.png" in result.output
    assert "covers.png is not drawn" in result.output
    assert "--allow-code hostile" in result.output


def test_a_file_that_is_called_like_a_benchmark_is_no_word_of_the_user(watched):
    (watched / "hostile:Part").write_text("")
    result = CliRunner().invoke(app, ["verify", "hostile:Part"])
    assert result.exit_code == 1


def test_a_study_whose_values_name_code_runs_none(watched):
    from nmm.study.sweep.runs import run_study
    from nmm.study.sweep.study_file import read_plan

    (watched / "scene.toml").write_text(tomli_w.dumps({**SCENE, "duration": 1e-3}))
    (watched / "study.toml").write_text(
        tomli_w.dumps({**STUDY, "vary": {"materials.m.law": ["hostile:Part"]}})
    )
    plan, cases = read_plan(watched / "study.toml")
    done = run_study(plan, cases, watched / "out", processes=1)
    assert [one.status for one in done.records] == ["error"]
    assert "--allow-code hostile" in done.records[0].sentence


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("os:system", "a subclass of nmm.materials.base.Law"),
        ("nmm.materials.base:Law", "define modulus, stiffness"),
        ("nmm.interfaces.mohr_coulomb:MohrCoulomb", "a subclass of nmm.materials.base.Law"),
        ("nothing_of_this_name:Law", "a module that can be imported"),
    ],
)
def test_what_is_allowed_must_be_a_part_of_its_kind_before_it_is_called(watched, name, expected):
    material = {**SCENE["materials"]["m"], "law": name, "options": {"command": "echo"}}
    scene = parse_scene(tomli_w.dumps({**SCENE, "materials": {"m": material}}))
    with allowing(name.partition(":")[0]), pytest.raises(nmm.NmmError, match=expected):
        prepare(scene, Formulation())


def test_a_module_that_is_allowed_runs_and_its_folder_is_left_again(tmp_path):
    (tmp_path / "stiff_law.py").write_text(
        "from nmm.materials.elastic import Elastic\nclass Stiff(Elastic):\n    pass\n"
    )
    material = {**SCENE["materials"]["m"], "law": "stiff_law:Stiff"}
    (tmp_path / "scene.toml").write_text(tomli_w.dumps({**SCENE, "materials": {"m": material}}))
    scene = nmm.read_scene(tmp_path / "scene.toml")
    before = list(sys.path)
    with pytest.raises(nmm.NmmError, match="--allow-code stiff_law"):
        nmm.run(scene)
    assert nmm.run(scene, allow_code=["stiff_law"]).summary.status == "converged"
    assert sys.path == before
    with pytest.raises(nmm.NmmError, match="--allow-code stiff_law"):  # it is not remembered
        nmm.run(scene)


def test_two_modules_of_one_name_are_not_taken_for_each_other(tmp_path):
    for folder, factor in (("one", 1.0), ("two", 2.0)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "namesake_law.py").write_text(
            "from nmm.materials.elastic import Elastic\nclass Mine(Elastic):\n"
            f"    def stiffness(self, plane):\n        return {factor} * super().stiffness(plane)\n"
        )
        material = {**SCENE["materials"]["m"], "law": "namesake_law:Mine"}
        text = tomli_w.dumps({**SCENE, "materials": {"m": material}})
        (tmp_path / folder / "scene.toml").write_text(text)
    first, second = (nmm.read_scene(tmp_path / name / "scene.toml") for name in ("one", "two"))
    nmm.run(first, allow_code=["namesake_law"])
    with pytest.raises(nmm.NmmError, match="rename it"):
        nmm.run(second, allow_code=["namesake_law"])


def test_devices_and_folders_are_no_scenes(tmp_path):
    for place in ("/dev/zero", tmp_path, tmp_path / "missing.toml"):
        with pytest.raises(nmm.NmmError, match="check the path"):
            nmm.read_scene(place)


@pytest.mark.parametrize("kind", ["records", "fields"])
def test_devices_and_pipes_beside_a_scene_are_no_files_of_numbers(tmp_path, kind):
    os.mkfifo(tmp_path / "pipe")
    for place in ("/dev/zero", "pipe"):
        text = tomli_w.dumps({**SCENE, kind: {"q": {"file": place}}})
        (tmp_path / "scene.toml").write_text(text)
        with pytest.raises(nmm.NmmError, match=rf"{kind}.q.file: .*: a pipe or a device, no file"):
            nmm.read_scene(tmp_path / "scene.toml")


@pytest.mark.parametrize("name", ["a\nb", "[red]x", "../x", "a/b", "a\\b", "\x1b[31mx", "x\u202ey"])
def test_names_that_are_no_words_are_refused(name):
    for key in ("blocks", "supports", "monitors"):
        with pytest.raises(nmm.NmmError, match="line breaks"):
            parse_scene(tomli_w.dumps(with_value(SCENE, (key, 0, "name"), name)))
    with pytest.raises(nmm.NmmError):
        parse_scene(tomli_w.dumps({**SCENE, "materials": {name: SCENE["materials"]["m"]}}))


def test_faults_never_move_or_colour_the_terminal():
    text = tomli_w.dumps(SCENE) + '\n"x\\u001b[31m\\n" = 1\n["y\\u009b"]\n'
    with pytest.raises(nmm.NmmError) as caught:
        parse_scene(text)
    assert all(line.isprintable() for line in str(caught.value).splitlines())


RED = "\x1b[31mx"
STUDIED = {"scene": "s.toml", "quantities": ["energy"], "vary": {"thickness": [1.0, 2.0]}}
COMPARED = {"values": [{"quantity": "energy", "value": 1.0, "tolerance": 0.1}]}


@pytest.mark.parametrize(
    ("model", "more"),
    [
        *((StudyPlan, {key: RED}) for key in ("title", "scene")),
        *((StudyPlan, {key: [RED]}) for key in ("scenes", "formulations", "quantities", "over")),
        (StudyPlan, {"vary": {RED: [1.0]}}),
        *((Expected, {key: RED}) for key in ("title", "source", "scene_hash", "formulation_hash")),
        *((Expected, {"versions": table}) for table in ({RED: "1"}, {"numpy": RED})),
        (Expected, {"values": [{**COMPARED["values"][0], "quantity": RED}]}),
    ],
)
def test_no_text_of_a_study_or_a_published_case_moves_or_colours_the_terminal(model, more):
    known = STUDIED if model is StudyPlan else COMPARED
    with pytest.raises(nmm.NmmError) as caught:
        parse(tomli_w.dumps({**known, **more}), model, "file.toml", nmm.NmmError)
    assert all(line.isprintable() for line in str(caught.value).splitlines())


def test_a_fault_is_one_line_that_can_be_printed_whatever_it_quotes():
    fault = nmm.NmmError(f"study.toml: over: {RED}\n: expected a key")
    assert str(fault) == "study.toml: over: \\x1b[31mx\\n: expected a key" == fault.faults[0]
