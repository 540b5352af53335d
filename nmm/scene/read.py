"""Reading scenes, and their canonical text and hash."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

from nmm.errors import SceneError
from nmm.scene.document import build, parse, read_text
from nmm.scene.faults import Source
from nmm.scene.model import Scene


def read_scene(path: str | Path) -> Scene:
    """Scene of a TOML file.

    Raises
    ------
    SceneError
        All faults of the file, one line each: `file:line: key path: value: expected: remedy`.
    """
    return parse_scene(read_text(path, SceneError), str(path))


def parse_scene(text: str, place: str = "scene") -> Scene:
    """Scene of a TOML text; `place` names it in errors."""
    scene, source = parse(text, Scene, place, SceneError)
    return _read_from(source, scene)


def build_scene(tables: dict[str, Any], place: str = "scene") -> Scene:
    """Scene of tables as `tomllib` gives them, for scenes made by a program."""
    return _read_from(Source(place), build(tables, Scene, Source(place), SceneError))


def _read_from(source: Source, scene: Scene) -> Scene:
    """Tell a scene, and the formulation in it, where they stand."""
    files = [one.file for one in scene.records.values()]
    if any([*files, *(one.file for one in scene.fields.values())]):
        from nmm.scene.tables.loading.read_files import with_files

        scene = with_files(scene, source)
    scene._source = source
    if scene.formulation is not None:
        scene.formulation._source = replace(source, root=("formulation",))
    return scene


def canonical_text(scene: Scene) -> str:
    """The scene in one form, whatever its file's order, units and comments.

    The default formulation and what is stored are left out: they are no part of what happens. So
    are tables that are not there.
    """
    empty = {name for name in Scene.model_fields if getattr(scene, name) in ((), {})}
    content = scene.model_dump(
        mode="json", by_alias=True, exclude_none=True, exclude={"formulation", "output", *empty}
    )
    return json.dumps(content, sort_keys=True, separators=(",", ":"), allow_nan=False)


def scene_hash(scene: Scene) -> str:
    """SHA-256 of the canonical text, hexadecimal."""
    return hashlib.sha256(canonical_text(scene).encode()).hexdigest()


def json_schema() -> dict[str, Any]:
    """JSON schema of scene files, for editors."""
    schema = Scene.model_json_schema(by_alias=True)
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
