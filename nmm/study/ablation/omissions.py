"""What can be left out of a scene: whole tables, single entries, and what is no table."""

from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass

from nmm.study.ablation.changes import CHANGES, Tables

TABLES = {
    "gravity": ("gravity",),
    "inertia": (
        "inertia",
        "damping",
        "initial_velocities",
        "dashpots",
        "viscous_boundaries",
        "free_fields",
    ),
    "damping": ("damping",),
    "contact": ("contact", "splitting"),
    "fracture": ("fracture",),
    "fracture in time": ("fracture",),
    "cohesive zones": ("cohesive_zones",),
    "splitting": ("splitting",),
    "initial velocity": ("initial_velocities",),
    "initial stress": ("initial_stresses",),
    "springs": ("springs",),
    "dashpots": ("dashpots",),
    "bars": ("bars",),
    "foundations": ("foundations",),
    "masses": ("masses",),
    "viscous boundaries": ("viscous_boundaries", "free_fields"),
    "free fields": ("free_fields",),
    "heat": ("heat", "temperatures", "heat_fluxes", "heat_sources", "convections"),
    "seepage": ("seepage", "heads", "inflows"),
    "consolidation": ("seepage", "heads", "inflows"),
    "water pressures": ("water_pressures",),
    "joint flow": ("joint_flow", "joint_heads"),
    "transient joint flow": ("joint_flow", "joint_heads"),
}
"""Keys of a scene that go with an effect that is left out: its own, and those that need it."""
LISTS = {
    "loads": ("loads",),
    "members": ("springs", "dashpots", "bars", "foundations", "masses"),
    "heat": ("temperatures", "heat_fluxes", "heat_sources", "convections"),
    "water": ("water_pressures", "heads", "inflows", "joint_heads"),
}
"""Lists of stages, and the tables whose names stand in them."""


@dataclass(frozen=True)
class Omission:
    """One thing left out.

    Attributes
    ----------
    name
        What, in words.
    scene, formulation
        Tables without it.
    """

    name: str
    scene: Tables
    formulation: Tables


def omissions(scene: Tables, formulation: Tables) -> Iterator[Omission]:
    """Yield the tables without each effect that a scene names, each load, and what is no table.

    The latter are the dowels of its bars, forces that stages hold back, materials that they change,
    the softening, flow and creep of matter, the friction of its interfaces, what the integrator
    takes of velocities, and rotations that are finite. What stages and loading name of what is left
    out is taken from their lists. Tables hold what was given alone, no defaults.
    """
    for name, keys in TABLES.items():
        if keys[0] in scene:
            yield Omission(name, _without(scene, keys), formulation)
    for kind in ("effects", "loads"):
        yield from _one_by_one(scene, formulation, kind)
    for name, change in CHANGES.items():
        changed = change(deepcopy(scene), deepcopy(formulation))
        if changed is not None:
            yield Omission(name, *changed)


def _without(scene: Tables, keys: tuple[str, ...]) -> Tables:
    found = {key: value for key, value in scene.items() if key not in keys}
    for listed in (key for tables in LISTS.values() for key in tables if key in keys):
        found = _unlisted(found, listed, {entry["name"] for entry in scene.get(listed, ())})
    if "inertia" in keys and "supports" in found:  # ground that records move stands still
        supported = [{key: one[key] for key in one if key != "motion"} for one in found["supports"]]
        found["supports"] = supported
    return found


def _unlisted(scene: Tables, key: str, names: set[str]) -> Tables:
    """Return a scene whose stages and loading no longer name what a table has lost."""

    def left(table: Tables, name: str) -> Tables:
        listed = table.get(name)
        if listed is None:
            return table
        return {**table, name: [one for one in listed if one not in names]}

    found = dict(scene)
    (list_name,) = (name for name, tables in LISTS.items() if key in tables)
    if "stages" in scene:
        found["stages"] = [left(stage, list_name) for stage in scene["stages"]]
    if key == "loads" and "loading" in scene:
        found["loading"] = left(scene["loading"], "scaled")
    return found


def _one_by_one(scene: Tables, formulation: Tables, kind: str) -> Iterator[Omission]:
    """Yield the tables without each entry of a list or table of tables."""
    entries = scene.get(kind)
    if isinstance(entries, dict):
        for name in entries:
            rest = {key: value for key, value in entries.items() if key != name}
            yield Omission(f"{kind}.{name}", {**scene, kind: rest}, formulation)
    elif entries:
        for number, entry in enumerate(entries):
            rest = entries[:number] + entries[number + 1 :]
            unlisted = _unlisted(scene, kind, {entry["name"]})
            yield Omission(f"load {entry['name']}", {**unlisted, kind: rest}, formulation)
