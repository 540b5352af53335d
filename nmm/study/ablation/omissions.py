"""What can be left out of a scene, as changes of the tables of scene and formulation."""

from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

Tables = dict[str, Any]

TABLES = {
    "gravity": ("gravity",),
    "inertia": ("inertia",),
    "damping": ("damping",),
    "contact": ("contact",),
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
"""Keys of a scene that go with an effect that is left out."""


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
    the friction of its interfaces, what the integrator takes of velocities, and rotations that are
    finite. Tables hold what was given alone, no defaults.
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
        ("friction", _frictionless),
        ("kinetic damping", _undamped),
        ("finite rotation", _small),
    ):
        changed = change(deepcopy(scene), deepcopy(formulation))
        if changed is not None:
            yield Omission(name, *changed)


def _without(scene: Tables, keys: tuple[str, ...]) -> Tables:
    return {key: value for key, value in scene.items() if key not in keys}


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
            yield Omission(f"load {entry['name']}", {**scene, kind: rest}, formulation)


Changed = tuple[Tables, Tables] | None
Change = Callable[[Tables, Tables], Changed]


def _without_dowels(scene: Tables, formulation: Tables) -> Changed:
    """With bars that joints cross as if they were cables."""
    dowels = [bar.pop("dowel", None) for bar in scene.get("bars", ())]
    return (scene, formulation) if any(dowels) else None


def _released(scene: Tables, formulation: Tables) -> Changed:
    """With all that removed blocks exerted released at once."""
    shares = [stage.pop("release", None) for stage in scene.get("stages", ())]
    held = any(share is not None for share in shares)
    return (scene, formulation) if held else None


def _unchanged(scene: Tables, formulation: Tables) -> Changed:
    """With the materials that blocks have at first."""
    changed = [stage.pop("materials", None) for stage in scene.get("stages", ())]
    return (scene, formulation) if any(changed) else None


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
