"""Scenes: what is read, what is refused, canonical text and hash."""

import json
import math
import pickle
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

import pytest
from pydantic import BaseModel

from nmm.errors import SceneError
from nmm.scene import Scene, canonical_text, json_schema, parse_scene, read_scene, scene_hash
from nmm.scene.expected import expected

from .good_scene import GOOD, fault_of, faults_of


def test_quantities_arrive_in_si() -> None:
    scene = parse_scene(GOOD)
    assert scene.thickness == 0.1
    assert scene.materials["concrete"].young_modulus == 27.5e9
    assert scene.interfaces["crack"].friction_angle == math.radians(37)
    assert scene.blocks[0].vertices[1] == (0.4, 0.0)
    assert scene.loads[0].force == (0.0, -1000.0)
    assert scene.loading is not None
    assert scene.loading.until == "failure"
    assert scene.gravity is None
    assert scene.inertia is None


def test_all_faults_are_reported_at_once_with_line_value_and_remedy() -> None:
    text = GOOD.replace("0.2\n[int", "0.7\n[int").replace('"-1 kN"', '"-1 kg"')
    text = text.replace('"concrete"\n', '"concret"\n').replace("thickness", "thicknes")
    lines = faults_of(text)
    assert [line.split(": ")[:2] for line in lines] == [
        ["s.toml:3", "thicknes"],
        ["s.toml:6", "materials.concrete.poisson_ratio"],
        ["s.toml:14", "blocks.0.material"],
        ["s.toml:24", "loads.0.force.1"],
    ]
    assert 'did you mean "thickness"' in lines[0]
    assert "0.7" in lines[1]
    assert "(-1, 0.5]" in lines[1]
    assert 'did you mean "concrete"' in lines[2]
    assert "dimension" in lines[3]
    assert "10 kN" in lines[3]


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ('"27.5 GPa"', "-1.0", (":5:", "-1.0", "> 0")),
        ('"27.5 GPa"', "nan", (":5:", "nan", "> 0")),
        ('"27.5 GPa"', "true", (":5:", ": true:", "not true or false")),
        ("= 0.2\n[", "= -1.0\n[", (":6:", "-1.0", "(-1, 0.5]")),
        ('"37 deg"', "37", (":9:", "37.0", '"37 deg"')),
        ('"37 deg"', '"90 deg"', (":9:", 'friction_angle: "90 deg":', "[0, pi/2)")),
        ('"27.5 GPa"', '"0 GPa"', (":5:", 'young_modulus: "0 GPa":', "> 0")),
        ('"4.7 MPa"', "-4.7e6", (":10:", "-4700000.0", ">= 0")),
        ('"2.9 MPa"', "-1", (":11:", "-1.0", ">= 0")),
        ("bonded = true", "bonded = false", ("interfaces.crack", "add bonded = true")),
        ("bonded = true", 'between = ["concrete", "stone"]\nbonded = true', ("stone", "known")),
        (
            "bonded = true",
            'bonded = true\ndilation_angle = "38 deg"',
            ("interfaces.crack", "0.663225", "friction angle, 0.645772", "gives energy"),
        ),
        (
            "bonded = true",
            'bonded = true\nresidual_friction_angle = "5 deg"\ndilation_angle = "6 deg"',
            ("interfaces.crack", "friction angle, 0.0872665", "gives energy"),
        ),
        ('fix = ["x", "y"]', 'fix = ["z"]', (":19:", '"z"', '["x", "y"]')),
        ('fix = ["x", "y"]', 'fix = ["y"]\ndisplacement = [1, 0]', ("supports.0", "x in fix")),
        ("point = [0.05, 0]", "", ("supports.0", "no place", "point, segment or block")),
        ("point = [0.05, 0]", "segment=[[0,0],[1,0]]\npoint = [0, 0]", ("point, segment",)),
        ("point = [0.05, 0]", 'block = "bean"', ('"bean"', 'mean "beam"')),
        ('kind = "point"', 'kind = "edge"', ("loads.0", "traction", "kind is edge")),
        ("point = [0.2, 0.1]", "", ("loads.0", "no place", "kind is point")),
        ("[contact]", "[contact]\n[gravity]", (":4:", "density missing", "[gravity]")),
        ("[contact]", "[contact]\n[effects.gravity]", ("[effects.gravity]", "a table [gravity]")),
        ("[contact]", "[contact]\n[contact]", ("Cannot declare [contact] twice", "TOML")),
        ("[contact]", '[contact]\n[output]\npictures = "yes"', ('pictures: "yes"', "= true")),
        ("= 0.2\n[", '= "0,2"\n[', (":6:", '"0,2"', "a number", "point: write 0.2")),
        ("[loading]", '[loading]\nscaled = ["jak"]', ("loading.scaled", 'mean "jack"')),
        ("[loading]", "[loading]\nmaximum_factor = 0", ("maximum_factor", "> 0")),
        ('until = "failure"', 'until = "death"', ("loading.until", "death", '"failure"')),
        (
            "[[loads]]",
            '[[supports]]\nname = "left"\npoint = [0, 0]\nfix=["x"]\n[[loads]]',
            ("own",),
        ),
        ('name = "beam"', 'name = "beam.1"', (":13:", "beam.1", 'without "."')),
        ('plane = "stress"', "", ("s.toml: plane: missing", "add plane = ")),
        ('plane = "stress"', 'plane = "stress', (":2:", "TOML")),
        (
            "vertices = [[0, 0], [",
            "vertices = [[0, 0, 0], [",
            (":15:", "0]: expected a point [x, y]"),
        ),
        ('fix = ["x", "y"]', 'fix = ["z"]', ('expected "x" or "y": write',)),
        ("vertices = [[0, 0], [", "vertices = [[0], [", ("0.1: missing: expected a number in m",)),
        ("[contact]", '[contact]\n[output]\nevents = "all"', ('and "shape_changes": write',)),
    ],
)
def test_a_bad_value_is_one_line_with_place_and_remedy(
    old: str, new: str, parts: tuple[str, ...]
) -> None:
    assert old in GOOD
    line = fault_of(GOOD.replace(old, new, 1))
    assert [part for part in ("s.toml", *parts) if part not in line] == [], line


def test_a_scene_without_blocks_is_refused() -> None:
    start, end = GOOD.index("[[blocks]]"), GOOD.index("[[supports]]")
    assert "add [[blocks]]" in fault_of(GOOD[:start] + GOOD[end:])


def test_the_hash_sees_physics_and_neither_units_order_comments_nor_formulation() -> None:
    scene = parse_scene(GOOD)
    same = GOOD.replace('"100 mm"', "0.1 # m").replace('"27.5 GPa"', '"27500 MPa"')
    same = same.replace("[contact]\n", "") + '[contact]\n[formulation.cover]\ntype = "triangles"\n'
    assert scene_hash(parse_scene(same)) == scene_hash(scene)
    assert parse_scene(GOOD.replace("0.2\n[", "0.21\n[")) != scene
    for changed in ("[contact]", 'until = "failure"', "bonded = true", '"4.7 MPa"'):
        other = GOOD.replace(changed, "" if changed != '"4.7 MPa"' else "4.7000001e6")
        if "tensile" in other and "bonded" not in other:
            other = other.replace('tensile_strength = "2.9 MPa"', "")
        assert scene_hash(parse_scene(other)) != scene_hash(scene)


def test_the_canonical_text_reads_back_to_the_same_scene() -> None:
    scene = parse_scene(GOOD)
    assert Scene.model_validate(json.loads(canonical_text(scene))) == scene


def test_a_scene_survives_pickling_and_is_immutable() -> None:
    scene = parse_scene(GOOD, "s.toml")
    copy = pickle.loads(pickle.dumps(scene))
    assert copy == scene
    assert copy.source.place("blocks", 0) == "s.toml:12: blocks.0"
    with pytest.raises(ValueError, match="frozen"):
        scene.thickness = 2.0


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"none\.toml: No such file.*check the path"):
        read_scene(tmp_path / "none.toml")
    (tmp_path / "some.toml").write_text(GOOD)
    assert read_scene(tmp_path / "some.toml") == parse_scene(GOOD)


def test_the_json_schema_offers_numbers_and_texts_with_units() -> None:
    schema = json_schema()
    json.dumps(schema)
    kinds = schema["$defs"]["Material"]["properties"]["young_modulus"]
    assert {"type": "string"} in kinds["anyOf"]
    assert schema["additionalProperties"] is False
    assert "reference" in schema["properties"]


def test_a_history_goes_forward_in_time() -> None:
    text = GOOD.replace('[0, "-1 kN"]', "[0, -1]\nhistory = [[1, 0], [1, 1]]")
    assert "t increasing" in fault_of(text)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("bonded = true", 'bonded = "yes"'),
        ('until = "failure"', "until = inf"),
        ("[contact]", '[contact]\n[[stages]]\nname = "one"\nreset_displacements = "yes"'),
    ],
)
def test_values_of_another_kind_are_not_converted(old: str, new: str) -> None:
    assert new.split(" = ")[-1].strip('"') in "".join(faults_of(GOOD.replace(old, new)))


def _described(model: type[BaseModel], seen: set[type[BaseModel]]) -> Iterator[tuple[str, Any]]:
    for name, info in model.model_fields.items() if model not in seen else ():
        seen.add(model)
        yield f"{model.__name__}.{name}", info
        for inner in _within(info.annotation):
            if isinstance(inner, type) and issubclass(inner, BaseModel):
                yield from _described(inner, seen)


def _within(annotation: Any) -> Iterator[Any]:
    yield annotation
    for one in get_args(annotation):
        yield from _within(one)


def test_faults_of_choices_name_every_choice() -> None:
    for name, info in _described(Scene, set()):
        kinds = [one for one in _within(info.annotation) if get_origin(one) is Literal]
        words = [word for kind in kinds for word in get_args(kind)]
        said = expected(info, (name,))
        assert [word for word in words if str(word) not in said] == [], (name, said)
