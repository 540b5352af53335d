"""What of a scene acts in a stage: loads, supports, members, monitors, and what time needs."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from nmm.scene.stages import KINDS
from nmm.scene.tables.members import MEMBERS

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene.model import Scene
    from nmm.scene.stages import StageTable
    from nmm.scene.tables.loading.loads import LoadTable

# Tables of forces: what is new grows with the load factor, what is listed no more fades with it.
PUSHING = ("loads", "water_pressures")


def named_in(
    scene: "Scene",
    table: "StageTable",
    listed: Mapping[str, tuple[str, ...] | None],
    there: set[str],
    before: frozenset[str],
) -> tuple[dict[str, tuple[Any, ...]], frozenset[str], frozenset[str]]:
    """Return what stages list by table, names of what pushes, and of what fades out.

    Where a stage comes to rest what pushed ``before`` and is listed no more does so by and by.
    """
    acting = {
        key: [one for one in getattr(scene, key) if acts(one, listed[kind], there)]
        for kind, keys in KINDS.items()
        for key in keys
    }
    names = frozenset(one.name for key in PUSHING for one in acting[key])
    moves = table.duration is not None and scene.inertia is not None
    fading = frozenset() if moves else before - names
    leaving = {
        key: [o for o in getattr(scene, key) if o.name in fading and acts(o, None, there)]
        for key in PUSHING
    }
    named = {key: (*items, *leaving.get(key, ())) for key, items in acting.items()}
    return named, names, frozenset(o.name for one in leaving.values() for o in one)


def keys_of_stage(
    scene: "Scene",
    table: "StageTable",
    named: Mapping[str, tuple[Any, ...]],
    members: tuple[str, ...] | None,
    there: set[str],
) -> dict[str, Any]:
    """Return the other keys of the scene of a stage: what acts in time alone, members, monitors."""
    passing = table.duration
    return {
        # What names no effect of its own is resolved here.
        "stages": _naming(scene, table),
        **_members(scene, members, dynamic=passing is not None),
        "loads": _standing(scene, table, named["loads"]),
        "monitors": tuple(one for one in scene.monitors if acts(one, None, there)),
        "duration": passing,
        "inertia": scene.inertia if passing else None,
        "damping": scene.damping if passing else None,
        "viscous_boundaries": _edges(scene.viscous_boundaries, table, there),
        "free_fields": _edges(scene.free_fields, table, there),
        "initial_velocities": scene.initial_velocities if passing else (),
    }


def _standing(
    scene: "Scene", table: "StageTable", loads: tuple["LoadTable", ...]
) -> tuple["LoadTable", ...]:
    """Return the loads of a stage; those that travel in motion are gone while it comes to rest."""
    rests = scene.inertia is not None and table.duration is None
    return tuple(one for one in loads if not (rests and one.kind == "moving"))


def _naming(scene: "Scene", table: "StageTable") -> tuple["StageTable", ...]:
    """Return what of the stages names effects: release in this one, materials in any."""
    changing = [one.model_copy(update={"release": None}) for one in scene.stages if one.materials]
    return (*changing, table) if table.release is not None else tuple(changing)


def _members(
    scene: "Scene", listed: tuple[str, ...] | None, dynamic: bool
) -> dict[str, tuple[Any, ...]]:
    """Return the members that are listed, or all, by table; dashpots act in time alone."""
    return {
        key: tuple(
            one
            for one in getattr(scene, key)
            if (listed is None or one.name in listed) and (dynamic or key != "dashpots")
        )
        for key in MEMBERS
    }


def acts(item: Any, listed: tuple[str, ...] | None, there: set[str]) -> bool:
    """Whether something is listed, or all are, and its block is there if it names one."""
    if item.block is not None and item.block not in there:
        return False
    return listed is None or item.name in listed


def _edges(items: tuple[Any, ...], table: "StageTable", there: set[str]) -> tuple[Any, ...]:
    """Return the boundaries of blocks that are there, which act in time alone."""
    return tuple(one for one in items if table.duration and acts(one, None, there))


def blocks_named(scene: "Scene", formulation: "Formulation") -> set[str]:
    """Names of blocks that anything refers to."""
    cover = formulation.cover
    placed = tuple(item for keys in KINDS.values() for key in keys for item in getattr(scene, key))
    placed += scene.monitors
    placed += (*scene.viscous_boundaries, *scene.free_fields)
    items: tuple[Any, ...] = (*placed, *(cover.nets or ()), *(cover.regions or ()))
    return {item.block for item in items if item.block is not None}
