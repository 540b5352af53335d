"""The stages of a scene, each as a scene, a formulation and the blocks that are there."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import ValidationError

from integration.arrays import Bools, Floats, Ints
from nmm.effects.base import Acting
from nmm.errors import Fault, FormulationError, SceneError
from nmm.model.origin import shifted
from nmm.scene.methods.cover_tables import CoverTable
from nmm.scene.stages import KINDS
from nmm.scene.tables.members import MEMBERS

if TYPE_CHECKING:
    from nmm.effects.base import Setup
    from nmm.formulation import Formulation
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene
    from nmm.scene.stages import StageTable
    from nmm.scene.tables.loading.loads import LoadTable

# Tables of forces: what is new grows with the load factor, what is listed no more fades with it.
PUSHING = ("loads", "water_pressures")


@dataclass(frozen=True)
class Stage:
    """What is solved from its beginning to its end.

    Attributes
    ----------
    name
        As the scene calls it.
    scene, formulation
        With what is there, and approximated as the stage asks.
    present
        (N,) which blocks are there.
    duration
        s; None is to rest.
    acting
        Which loads grow and which fade in it.
    reset
        Whether displacements count from its start.
    material
        (N,) that of each block, in the order of the scene.
    """

    name: str
    scene: "Scene"
    formulation: "Formulation"
    present: Bools
    duration: float | None
    acting: Acting
    reset: bool
    material: Ints

    @property
    def in_time(self) -> bool:
        """Whether time passes in it."""
        return self.duration is not None

    @property
    def dynamic(self) -> bool:
        """Whether it moves; else it comes to rest, and time that passes then does so in balance."""
        return self.duration is not None and self.scene.inertia is not None


@dataclass(frozen=True)
class Staged:
    """A stage with what its effects are built from.

    ``clock`` says whether its scene has a clock, which stands while a stage comes to rest.
    """

    stage: Stage
    setup: "Setup"
    clock: bool


def stages_of(
    scene: "Scene", formulation: "Formulation", regions: "Regions", origin: Floats
) -> list[Stage]:
    """Return the stages in order; none of a scene without any.

    ``origin`` (2,) is where the axes of formulation and regions lie in those of the scene (m).

    Raises
    ------
    SceneError
        A block that leaves without being there, arrives twice, or a stage without blocks.
    FormulationError
        Keys of a cover that do not fit.
    """
    return list(_resolved(scene, formulation, regions, origin))


def _resolved(
    scene: "Scene", formulation: "Formulation", regions: "Regions", origin: Floats
) -> Iterator[Stage]:
    present = np.ones(len(regions), dtype=bool)
    listed: dict[str, tuple[str, ...] | None] = dict.fromkeys(KINDS)
    members, before = None, frozenset[str]()
    material = np.asarray(regions.material)
    for number, table in enumerate(scene.stages):  # a handful of stages
        place = _Place(scene, number, origin)
        present = _present(table, present, regions, place)
        material = _materials(table, material, regions, place)
        formulation = _formulation(table, formulation, place)
        listed |= {kind: table.lists(kind) for kind in KINDS if table.lists(kind) is not None}
        members = members if table.members is None else table.members
        there = {one for one in _names(scene, formulation) if present[regions.select(one)].any()}
        acting = {
            key: [one for one in getattr(scene, key) if _acts(one, listed[kind], there)]
            for kind, keys in KINDS.items()
            for key in keys
        }
        names = frozenset(one.name for key in PUSHING for one in acting[key])
        moves = table.duration is not None and scene.inertia is not None
        fading = frozenset() if moves else before - names
        leaving = {
            key: [o for o in getattr(scene, key) if o.name in fading and _acts(o, None, there)]
            for key in PUSHING
        }
        named = {key: (*items, *leaving.get(key, ())) for key, items in acting.items()}
        whole = {
            # What names no effect of its own is resolved here.
            "stages": _naming(scene, table),
            **named,
            **_members(scene, members, dynamic=table.duration is not None),
            "loads": _standing(scene, table, named["loads"]),
            "monitors": tuple(one for one in scene.monitors if _acts(one, None, there)),
            "duration": table.duration,
            "inertia": scene.inertia if table.duration else None,
            "damping": scene.damping if table.duration else None,
            "viscous_boundaries": _edges(scene.viscous_boundaries, table, there),
            "free_fields": _edges(scene.free_fields, table, there),
            "initial_velocities": scene.initial_velocities if table.duration else (),
        }
        yield Stage(
            table.name,
            scene.model_copy(update=whole),
            _of_present(formulation, there),
            present,
            table.duration,
            Acting(
                names - before,
                frozenset(o.name for one in leaving.values() for o in one),
                table.release,
            ),
            table.reset_displacements,
            material,
        )
        before = names


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


def _materials(table: "StageTable", before: Ints, regions: "Regions", place: "_Place") -> Ints:
    """Return the materials (N,) of all blocks with those that the stage changes."""
    found, known = before.copy(), list(place.scene.materials)
    for block, name in table.materials.items():
        found[_chosen(block, regions, place, "materials")] = known.index(name)
    return found


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


@dataclass(frozen=True)
class _Place:
    """Where a stage stands in its file, and (2,) where the axes of the model lie (m)."""

    scene: "Scene"
    number: int
    origin: Floats

    def fault(self, key: str, value: str, expected: str, remedy: str) -> Fault:
        return Fault(self.scene.source.place("stages", self.number, key), value, expected, remedy)


def _present(table: "StageTable", before: Bools, regions: "Regions", place: _Place) -> Bools:
    present = before.copy() if table.blocks is None else np.zeros(len(regions), dtype=bool)
    for name in table.blocks or ():
        present[_chosen(name, regions, place, "blocks")] = True
    for key, names, there in (("remove", table.remove, True), ("add", table.add, False)):
        for name in names:
            chosen = _chosen(name, regions, place, key)
            if (before[chosen] != there).any():
                expected = f"a block that is {'' if there else 'not '}there before"
                said = "is not there" if there else "is there already"
                remedy = "remove the name, or list what is there by blocks"
                raise SceneError(place.fault(key, f'"{name}" {said}', expected, remedy))
            present[chosen] = not there
    if not present.any():
        remedy = "keep one, or remove the stage"
        raise SceneError(place.fault("name", "no block is left", "at least one block", remedy))
    return present


def _chosen(name: str, regions: "Regions", place: _Place, key: str) -> Any:
    chosen = regions.select(name)
    if not len(chosen):
        expected = f"one of {', '.join(regions.name[:8])}"
        raise SceneError(place.fault(key, f'"{name}": no such block', expected, "correct the name"))
    return chosen


def _formulation(table: "StageTable", now: "Formulation", place: _Place) -> "Formulation":
    """Return the formulation with the keys of its cover that the stage changes."""
    if not table.cover:
        return now
    known = now.cover.model_dump(exclude_unset=True, by_alias=True)
    try:
        whole = CoverTable.model_validate({**known, **table.cover})
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        key = ".".join(str(part) for part in first["loc"]) or "cover"
        value = f"{key}: {first['input']!r:.60}: {first['msg']}"
        expected, remedy = "keys of [cover] of a formulation", "see nmm explain cover"
        raise FormulationError(place.fault("cover", value, expected, remedy)) from None
    # The keys that stay have been shifted already.
    moved = shifted(whole, -place.origin) if place.origin.any() else whole
    own = {key: getattr(moved, key) for key in table.cover}
    return now.model_copy(update={"cover": now.cover.model_copy(update=own)})


def _of_present(formulation: "Formulation", there: set[str]) -> "Formulation":
    """Return the formulation without nets and degrees of blocks that are away."""
    cover = formulation.cover
    nets = tuple(one for one in cover.nets or () if one.block in there)
    regions = tuple(one for one in cover.regions or () if one.block is None or one.block in there)
    changes = {"nets": nets or None, "regions": regions or None}
    return formulation.model_copy(update={"cover": cover.model_copy(update=changes)})


def _acts(item: Any, listed: tuple[str, ...] | None, there: set[str]) -> bool:
    """Whether something is listed, or all are, and its block is there if it names one."""
    if item.block is not None and item.block not in there:
        return False
    return listed is None or item.name in listed


def _edges(items: tuple[Any, ...], table: "StageTable", there: set[str]) -> tuple[Any, ...]:
    """Return the boundaries of blocks that are there, which act in time alone."""
    return tuple(one for one in items if table.duration and _acts(one, None, there))


def _names(scene: "Scene", formulation: "Formulation") -> set[str]:
    """Names of blocks that anything refers to."""
    cover = formulation.cover
    placed = tuple(item for keys in KINDS.values() for key in keys for item in getattr(scene, key))
    placed += scene.monitors
    placed += (*scene.viscous_boundaries, *scene.free_fields)
    items: tuple[Any, ...] = (*placed, *(cover.nets or ()), *(cover.regions or ()))
    return {item.block for item in items if item.block is not None}
