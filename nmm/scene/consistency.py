"""Consistency rules of a scene: names exist, and effects have what they need.

They work on unvalidated tables, so that their faults are reported together with those of values.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from pydantic import BaseModel

from nmm.scene.faults import suggestion
from nmm.scene.lines import Path
from nmm.scene.stage_rules import stage_contradictions
from nmm.scene.tables.fracture.bond_rules import bonded_crack_contradictions
from nmm.scene.tables.fracture.cohesive import cohesive_contradictions
from nmm.scene.tables.fracture.rules import fracture_contradictions
from nmm.scene.tables.heat_rules import PARTS as HEAT
from nmm.scene.tables.heat_rules import heat_contradictions
from nmm.scene.tables.member_rules import member_contradictions
from nmm.scene.tables.shaking.rules import EDGES, motion_contradictions
from nmm.scene.tables.splitting import splitting_contradictions
from nmm.scene.tables.strength_reduction import reduction_contradictions
from nmm.scene.tables.water_rules import PLACED as WATER
from nmm.scene.tables.water_rules import seepage_contradictions, water_contradictions
from nmm.scene.unread_rows import Finding, Tables, has_clock, rows

Rule = Callable[[Tables], Iterator[Finding]]

_SOLIDS = ("blocks", "tessellations")
_NAMED = ("joint_sets", "cracks", "supports", "loads", "monitors", "stages", *HEAT, *WATER, *EDGES)
_AT_BLOCKS = ("supports", "loads", "monitors", *HEAT, *WATER, *EDGES)
_ON_BLOCKS = ("initial_velocities", "initial_stresses", "joint_sets")


def contradictions(data: object) -> list[Finding]:
    """Return all contradictions of the tables of a scene; malformed entries are skipped."""
    plain = _plain(data)
    if not isinstance(plain, Mapping):
        return []
    own: tuple[Rule, ...] = (_solids, _names, _materials, _interfaces, _block_names, _densities)
    rules = (
        *own,
        _effects,
        stage_contradictions,
        heat_contradictions,
        water_contradictions,
        seepage_contradictions,
        motion_contradictions,
        member_contradictions,
        fracture_contradictions,
        bonded_crack_contradictions,
        cohesive_contradictions,
        splitting_contradictions,
        reduction_contradictions,
    )
    return [finding for rule in rules for finding in rule(plain)]


def _plain(data: object) -> object:
    """Plain tables from tables that may contain models or None, as of a scene built in Python."""
    if isinstance(data, BaseModel):
        return data.model_dump(exclude_unset=True, exclude_none=True, by_alias=True)
    if isinstance(data, Mapping):
        return {key: _plain(value) for key, value in data.items() if value is not None}
    if isinstance(data, list | tuple) and any(isinstance(item, BaseModel) for item in data):
        return [_plain(item) for item in data]
    return data


def _table(data: Tables, key: str) -> Tables:
    value = data.get(key)
    return value if isinstance(value, Mapping) else {}


def _solids(data: Tables) -> Iterator[Finding]:
    if not any(data.get(key) for key in _SOLIDS):
        yield ("blocks",), "no block", "at least one block", "add [[blocks]] or [[tessellations]]"


def _names(data: Tables) -> Iterator[Finding]:
    for keys in (_SOLIDS, *((key,) for key in _NAMED)):
        seen: dict[str, Path] = {}
        for path, row in rows(data, *keys):
            name = row.get("name")
            if not isinstance(name, str):
                continue
            if name in seen:
                first = ".".join(str(part) for part in seen[name])
                yield (*path, "name"), f'"{name}"', "a name of its own", f"{first} has it already"
            if name in ("all", "any"):
                yield (*path, "name"), f'"{name}"', "another name", f'"{name}" means every block'
            seen.setdefault(name, path)


def _materials(data: Tables) -> Iterator[Finding]:
    known = list(_table(data, "materials"))
    for path, row in rows(data, *_SOLIDS):
        name = row.get("material")
        if isinstance(name, str) and name not in known:
            expected = "the name of a material"
            yield (*path, "material"), f'"{name}"', expected, suggestion(name, known)
    if data.get("plane") == "strain":
        yield from _incompressible(data)
    for name, row in _table(data, "materials").items():
        if data.get("plane") == "stress" and isinstance(row, Mapping) and "softening_energy" in row:
            where = ("materials", name, "softening_energy")
            yield where, f"{row['softening_energy']} in plane stress", "plane strain", "remove it"


def _incompressible(data: Tables) -> Iterator[Finding]:
    for name, row in _table(data, "materials").items():
        if isinstance(row, Mapping) and row.get("poisson_ratio") == 0.5:
            remedy = "plane strain has no stiffness matrix at 0.5; use for example 0.4999"
            path = ("materials", name, "poisson_ratio")
            yield path, "0.5", "less than 0.5 in plane strain", remedy


def _interfaces(data: Tables) -> Iterator[Finding]:
    known = list(_table(data, "materials"))
    seen: dict[frozenset[str], str] = {}
    for name, row in _table(data, "interfaces").items():
        between = row.get("between", "any") if isinstance(row, Mapping) else "any"
        pair = (between,) if isinstance(between, str) else between
        if not isinstance(pair, list | tuple) or not all(isinstance(item, str) for item in pair):
            continue
        path: Path = ("interfaces", name, "between")
        for material in pair:
            if material not in known and between != "any":
                expected = "the name of a material"
                yield path, f'"{material}"', expected, suggestion(material, known)
        key = frozenset(pair)
        if key in seen:
            remedy = f'interface "{seen[key]}" has it already; keep one'
            yield path, str(between), "a pair of its own", remedy
        seen.setdefault(key, name)


def _block_names(data: Tables) -> Iterator[Finding]:
    known = [row["name"] for _, row in rows(data, *_SOLIDS) if isinstance(row.get("name"), str)]
    for path, row in rows(data, *_AT_BLOCKS, *_ON_BLOCKS):
        name = row.get("block")
        if not isinstance(name, str) or name.split(".")[0] in known:
            continue
        if name == "all":
            continue
        yield (*path, "block"), f'"{name}"', "the name of a block", suggestion(name, known)


def _densities(data: Tables) -> Iterator[Finding]:
    needs = [f"[{key}]" for key in ("gravity", "inertia") if key in data]
    needs += ["motion_after_failure"] if "motion_after_failure" in _table(data, "loading") else []
    used = [row.get("material") for _, row in rows(data, *_SOLIDS)]
    for name, row in _table(data, "materials").items():
        if needs and name in used and isinstance(row, Mapping) and "density" not in row:
            expected = f"a density in kg/m3, as {needs[0]} is named"
            remedy = 'add for example density = "2400 kg/m^3"'
            yield ("materials", name), "density missing", expected, remedy


def _effects(data: Tables) -> Iterator[Finding]:
    if "inertia" in data and "duration" not in data and not data.get("stages"):
        yield ("inertia",), "duration missing", "a duration", 'add duration = "1 s" at the top'
    if "contact" in data and not data.get("interfaces"):
        remedy = "add [interfaces.NAME] with friction_angle"
        yield ("contact",), "no interface", "at least one interface", remedy
    if "loading" in data and "inertia" in data:
        remedy = "remove [loading], or [inertia]; in dynamics loads follow their history"
        yield ("loading",), "[loading] with [inertia]", "a static scene", remedy
    if "duration" in data and "inertia" not in data:
        yield from _without_inertia(data)
    if data.get("initial_velocities") and "inertia" not in data:
        remedy = "add [inertia], or remove [[initial_velocities]]"
        yield ("initial_velocities",), "no [inertia]", "a dynamic scene", remedy
    yield from _scaled_loads(data)
    yield from _control(data)
    yield from _output(data)


def _without_inertia(data: Tables) -> Iterator[Finding]:
    """Refuse other clocks beside quasi-static time."""
    if "loading" in data:
        remedy = "remove duration, or [loading]: over time loads follow their history"
        yield ("duration",), "duration with [loading]", "one of the two", remedy
    for key in ("heat", "seepage", "joint_flow"):
        if _table(data, key).get("transient") is True:
            remedy = f"remove it, and let [{key}] have its duration, or add [inertia]"
            yield ("duration",), f"duration with transient [{key}]", "one clock", remedy


def _output(data: Tables) -> Iterator[Finding]:
    output, loading = _table(data, "output"), _table(data, "loading")
    timed = has_clock(data)
    moves = timed or "motion_after_failure" in loading
    if "every_time" in output and not moves:
        remedy = "use every_steps, or add [inertia]; growing loads have no time"
        yield ("output", "every_time"), "no [inertia]", "a scene that moves in time", remedy
    checkpoint = _table(output, "checkpoint")
    if "every_time" in checkpoint and not timed:
        remedy = "use every_steps; growing loads have no time"
        place = ("output", "checkpoint", "every_time")
        yield place, "no [inertia]", "a scene that moves in time", remedy
    if output.get("events") and "contact" not in data:
        remedy = "remove events, or add [contact]"
        yield ("output", "events"), "no [contact]", "a scene with contact", remedy


def _control(data: Tables) -> Iterator[Finding]:
    control = _table(_table(data, "loading"), "control")
    if not control:
        return
    if "contact" not in data:
        remedy = "add [contact], or remove [loading.control]"
        yield ("loading", "control"), "no [contact]", "a scene with contact", remedy
    if data.get("stages"):
        remedy = "remove stages, or [loading.control]"
        yield ("loading", "control"), "stages besides", "a path without stages", remedy
    known = [row["name"] for _, row in rows(data, "monitors") if isinstance(row.get("name"), str)]
    named = control.get("monitors", ())
    for number, name in enumerate(named if isinstance(named, list | tuple) else ()):
        if isinstance(name, str) and name not in known:
            place: Path = ("loading", "control", "monitors", number)
            yield place, f'"{name}"', "the name of a monitor", suggestion(name, known)


def _scaled_loads(data: Tables) -> Iterator[Finding]:
    supports = [row for _, row in rows(data, "supports")]
    driven = [row for row in supports if row.get("displacement") or row.get("field")]
    loads = [row for _, row in rows(data, "loads", "water_pressures")] + driven
    known = [row["name"] for row in loads if isinstance(row.get("name"), str)]
    scaled = _table(data, "loading").get("scaled", "all")
    for name in scaled if isinstance(scaled, list | tuple) else ():
        if isinstance(name, str) and name not in known:
            path: Path = ("loading", "scaled")
            expected = "the name of a load, or of a support with a displacement"
            yield path, f'"{name}"', expected, suggestion(name, known)
    if "loading" in data and not loads:
        remedy = "add [[loads]] or the displacement of a support, or remove [loading]"
        yield ("loading",), "no load", "at least one load to scale", remedy
