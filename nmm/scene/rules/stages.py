"""Rules of stages: what they name exists, and what they exclude is not there."""

from __future__ import annotations

from collections.abc import Generator, Iterator

from nmm.scene.lines import Path
from nmm.scene.rules.course import two_clocks
from nmm.scene.rules.unread_tables import (
    SOLIDS,
    Finding,
    Tables,
    names,
    rows,
    table,
    texts,
    unknown,
    unknown_block,
)
from nmm.scene.stages import KINDS

BLOCKS = ("blocks", "remove", "add")


def stage_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield names in stages that do not exist, and what is incompatible with stages."""
    if data.get("stages"):
        yield from _beside(data)
    known = {kind: names(data, *keys) for kind, keys in KINDS.items()}
    leaves, gone = False, 0.0
    for path, stage in rows(data, "stages"):
        yield from _blocks_and_materials(data, stage, path)
        for key, given in known.items():
            expected = f"the name of one of {', '.join(KINDS[key])}"
            for name in texts(stage, key):
                yield from unknown((*path, key), name, expected, given)
        leaves = leaves or (path[1] != 0 and ("remove" in stage or "blocks" in stage))
        if "release" in stage and not leaves:
            remedy = "remove it, or name the blocks that leave in the stage"
            expected = "a stage in which blocks leave, or after it"
            yield (*path, "release"), "release", expected, remedy
        gone = yield from _gone(stage, path, gone)
        if "duration" in stage and "inertia" not in data:
            yield from two_clocks(data, (*path, "duration"))


def _gone(stage: Tables, path: Path, gone: float) -> Generator[Finding, None, float]:
    """Yield a release that falls where no blocks leave; return what is gone after the stage."""
    released = stage.get("release")
    if not isinstance(released, int | float):
        return gone
    if released < gone and not {"remove", "blocks"} & stage.keys():
        expected = f"at least the {gone:g} of the stage before: what is gone does not come back"
        remedy = "leave it out where the share stays"
        yield (*path, "release"), f"{released:g}", expected, remedy
    return float(released)


def _blocks_and_materials(data: Tables, stage: Tables, path: Path) -> Iterator[Finding]:
    blocks, materials = names(data, *SOLIDS), list(table(data, "materials"))
    for key in BLOCKS:
        for name in texts(stage, key):
            yield from unknown_block((*path, key), name, blocks)
    for block, name in table(stage, "materials").items():
        where = (*path, "materials", block)
        yield from unknown_block(where, block, blocks)
        yield from unknown(where, name, "the name of a material", materials)


def _beside(data: Tables) -> Iterator[Finding]:
    if "duration" in data:
        remedy = "remove it, and give each of [[stages]] the duration it has"
        yield ("duration",), "duration with [[stages]]", "durations of stages", remedy
    if "loading" in data:
        remedy = "remove [loading], or [[stages]]: stages bring their loads on in full"
        yield ("loading",), "[loading] with [[stages]]", "one of the two", remedy
    if table(table(data, "formulation"), "rotation").get("update") == "linear":
        path = ("formulation", "rotation", "update")
        remedy = 'use update = "exact"'
        yield path, '"linear" with [[stages]]', "places that are kept", remedy
