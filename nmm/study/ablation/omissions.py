"""What can be left out of a scene, as changes of the tables of scene and formulation."""

from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import dataclass
from functools import partial
from typing import Any

from nmm.model.build import WHERE_GIVEN

Tables = dict[str, Any]

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
    "viscous boundaries": ("viscous_boundaries",),
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
YIELDS = ("von_mises", "mohr_coulomb", "drucker_prager")
CREEPS = ("maxwell", "kelvin", "standard_solid", "burgers")


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
    for name, change in (
        ("dowels", _without_dowels),
        ("unreleased forces", _released),
        ("changed materials", _unchanged),
        ("softening of matter", _lasting),
        ("yield", partial(_elastic, YIELDS)),
        ("creep", partial(_elastic, CREEPS)),
        ("friction", _frictionless),
        ("kinetic damping", _undamped),
        ("finite rotation", _small),
    ):
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


Changed = tuple[Tables, Tables] | None
Change = Callable[[Tables, Tables], Changed]


def _without_dowels(scene: Tables, formulation: Tables) -> Changed:
    """With bars that joints cross as if they were cables."""
    dowels = [bar.pop("dowel", None) for bar in scene.get("bars", ())]
    return (scene, formulation) if any(dowels) else None


def _released(scene: Tables, formulation: Tables) -> Changed:
    """With all that removed blocks exerted released at once."""
    shares = [stage.pop("release", None) for stage in scene.get("stages", ())]
    named = any(share is not None for share in shares)
    return (scene, formulation) if named else None


def _unchanged(scene: Tables, formulation: Tables) -> Changed:
    """With the materials that blocks have at first."""
    changed = [stage.pop("materials", None) for stage in scene.get("stages", ())]
    return (scene, formulation) if any(changed) else None


def _lasting(scene: Tables, formulation: Tables) -> Changed:
    """With matter that yields and keeps its strength."""
    soft = [one for one in scene.get("materials", {}).values() if "softening_energy" in one]
    for material in soft:
        for key in [key for key in material if key.startswith(("softening_", "residual_"))]:
            del material[key]
    return (scene, formulation) if soft else None


def _elastic(laws: tuple[str, ...], scene: Tables, formulation: Tables) -> Changed:
    """With matter of some laws that is elastic in place of them."""
    found = [one for one in scene.get("materials", {}).values() if one.get("law") in laws]
    for material in found:
        # An angle of axes that such matter has is of its conductivities.
        for key in ("law", *(key for key in WHERE_GIVEN if key != "axis_angle")):
            material.pop(key, None)
    return (scene, formulation) if found else None


def _frictionless(scene: Tables, formulation: Tables) -> Changed:
    """Without friction between bodies that may slide; cohesion stays."""
    laws = scene.get("interfaces", {}).values()
    rough = [law for law in laws if law.get("friction_angle")]
    if not rough or "contact" not in scene:
        return None
    for law in rough:
        law["friction_angle"] = 0.0
        law.pop("dilation_angle", None)
    return scene, formulation


def _undamped(scene: Tables, formulation: Tables) -> Changed:
    """With all of the velocity at the end of a step."""
    table = formulation.get("integrator", {})
    if "inertia" not in scene or table.get("kinetic_factor", 1.0) == 1.0:
        return None
    table["kinetic_factor"] = 1.0
    return scene, formulation


def _small(scene: Tables, formulation: Tables) -> Changed:
    """With axes of bodies that stay."""
    table = formulation.setdefault("rotation", {})
    if table.get("update") == "small":
        return None
    table["update"] = "small"
    return scene, formulation
