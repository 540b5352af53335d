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
from nmm.scene.tables.loading.read_files import with_numbers


def read_scene(path: str | Path) -> Scene:
    """Return the scene of a TOML file.

    Raises
    ------
    SceneError
        All faults of the file, a line each: `file:line: key path: value: expected: remedy`.
    """
    return parse_scene(read_text(path, SceneError), str(path))


def parse_scene(text: str, place: str = "scene") -> Scene:
    """Return the scene of a TOML text; `place` names it in errors."""
    scene, source = parse(text, Scene, place, SceneError)
    return _read_from(source, scene)


def build_scene(tables: dict[str, Any], place: str = "scene") -> Scene:
    """Return the scene of tables as `tomllib` gives them, for scenes made by a program."""
    return _read_from(Source(place), build(tables, Scene, Source(place), SceneError))


def _read_from(source: Source, scene: Scene) -> Scene:
    """Read the files that a scene names, and set its source and that of its formulation."""
    records, fields = with_numbers(scene.records, scene.fields, source)
    if (records, fields) != (scene.records, scene.fields):
        scene = scene.model_copy(update={"records": records, "fields": fields})
    scene._source = source
    if scene.formulation is not None:
        scene.formulation._source = replace(source, root=("formulation",))
    return scene


def canonical_text(scene: Scene) -> str:
    """Return the scene in one form, independent of order, units and comments of its file.

    The default formulation, outputs and absent tables are left out.
    """
    empty = {name for name in Scene.model_fields if getattr(scene, name) in ((), {})}
    content = scene.model_dump(
        mode="json", by_alias=True, exclude_none=True, exclude={"formulation", "output", *empty}
    )
    return json.dumps(content, sort_keys=True, separators=(",", ":"), allow_nan=False)


def scene_hash(scene: Scene) -> str:
    """Return the SHA-256 of the canonical text in hexadecimal."""
    return hashlib.sha256(canonical_text(scene).encode()).hexdigest()


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of scene files, for editors."""
    schema = Scene.model_json_schema(by_alias=True)
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
