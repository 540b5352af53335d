"""Consistency rules of stages, on unvalidated tables as in `nmm.scene.consistency`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from nmm.scene.faults import suggestion
from nmm.scene.lines import Path
from nmm.scene.stages import KINDS
from nmm.scene.unread_rows import Finding, Tables

BLOCKS = ("blocks", "remove", "add")


def stage_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield names in stages that do not exist, and what is incompatible with stages."""
    stages = _list(data, "stages")
    if not stages:
        return
    yield from _beside(data)
    solids = [*_names(data, "blocks"), *_names(data, "tessellations")]
    known = {
        kind: [name for key in keys for name in _names(data, key)] for kind, keys in KINDS.items()
    }
    leaves = False
    for number, stage in enumerate(stages):
        if not isinstance(stage, Mapping):
            continue
        path: Path = ("stages", number)
        for key in BLOCKS:
            for name in _texts(stage, key):
                if name != "all" and name.split(".")[0] not in solids:
                    yield (*path, key), f'"{name}"', "the name of a block", suggestion(name, solids)
        yield from _materials(stage, path, solids, [*data.get("materials", ())])
        for key, names in known.items():
            for name in _texts(stage, key):
                if name not in names:
                    expected = f"the name of one of {', '.join(KINDS[key])}"
                    yield (*path, key), f'"{name}"', expected, suggestion(name, names)
        leaves = leaves or (number > 0 and ("remove" in stage or "blocks" in stage))
        if "release" in stage and not leaves:
            remedy = "remove it, or name the blocks that leave in the stage"
            yield (
                (*path, "release"),
                "release",
                "a stage in which blocks leave, or after it",
                remedy,
            )
        if "duration" in stage and "inertia" not in data:
            yield from _two_clocks(data, path)


def _materials(stage: Tables, path: Path, solids: list[str], known: list[str]) -> Iterator[Finding]:
    given = stage.get("materials")
    for block, name in given.items() if isinstance(given, Mapping) else ():
        where = (*path, "materials", block)
        if block != "all" and block.split(".")[0] not in solids:
            yield where, f'"{block}"', "the name of a block", suggestion(block, solids)
        if isinstance(name, str) and name not in known:
            yield where, f'"{name}"', "the name of a material", suggestion(name, known)


def _two_clocks(data: Tables, path: Path) -> Iterator[Finding]:
    """Refuse quasi-static time beside a transient field with a clock of its own."""
    for key in ("heat", "seepage", "joint_flow"):
        table = data.get(key)
        if isinstance(table, Mapping) and table.get("transient") is True:
            remedy = f"remove it, and let [{key}] have its duration, or add [inertia]"
            value = f"duration with transient [{key}]"
            yield (*path, "duration"), value, "one clock", remedy


def _beside(data: Tables) -> Iterator[Finding]:
    if "duration" in data:
        remedy = "remove it, and give each of [[stages]] the duration it has"
        yield ("duration",), "duration with [[stages]]", "durations of stages", remedy
    if "loading" in data:
        remedy = "remove [loading], or [[stages]]: stages bring their loads on in full"
        yield ("loading",), "[loading] with [[stages]]", "one of the two", remedy
    rotation = data.get("formulation", {})
    rotation = rotation.get("rotation", {}) if isinstance(rotation, Mapping) else {}
    if isinstance(rotation, Mapping) and rotation.get("update") == "linear":
        remedy = 'use update = "exact"'
        path: Path = ("formulation", "rotation", "update")
        yield path, '"linear" with [[stages]]', "places that are kept", remedy


def _list(data: Tables, key: str) -> list[Any]:
    value = data.get(key)
    return list(value) if isinstance(value, list | tuple) else []


def _names(data: Tables, key: str) -> list[str]:
    rows = [row for row in _list(data, key) if isinstance(row, Mapping)]
    return [row["name"] for row in rows if isinstance(row.get("name"), str)]


def _texts(row: Tables, key: str) -> list[str]:
    return [name for name in _list(row, key) if isinstance(name, str)]
