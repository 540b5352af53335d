"""Scenes: schema and reader of scene files, units at the door, canonical text and hash.

Nothing is built or computed here.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nmm.scene.model import Scene as Scene
    from nmm.scene.read import build_scene as build_scene
    from nmm.scene.read import canonical_text as canonical_text
    from nmm.scene.read import json_schema as json_schema
    from nmm.scene.read import parse_scene as parse_scene
    from nmm.scene.read import read_scene as read_scene
    from nmm.scene.read import scene_hash as scene_hash

# Looked up on first use: `nmm.formulation`, which the scene's model needs, is made of stones of
# this package, so that an eager import here would be circular.
_READ = ("build_scene", "canonical_text", "json_schema", "parse_scene", "read_scene", "scene_hash")
_HOME = {"Scene": "nmm.scene.model", **dict.fromkeys(_READ, "nmm.scene.read")}
__all__ = list(_HOME)


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
