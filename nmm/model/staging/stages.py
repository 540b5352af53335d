"""The stages of a scene, each as a scene, a formulation and the blocks that are there."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import ValidationError

from integration.arrays import Bools, Floats, Ints
from nmm.effects.base import StageLoads
from nmm.errors import Fault, FormulationError, SceneError
from nmm.model.origin import shifted
from nmm.model.staging.acting import blocks_named, keys_of_stage, named_in
from nmm.scene.faults import report
from nmm.scene.methods.cover_tables import CoverTable
from nmm.scene.stages import KINDS

if TYPE_CHECKING:
    from nmm.effects.base import Setup
    from nmm.formulation import Formulation
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene
    from nmm.scene.stages import StageTable


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
    sets_out
        (N,) blocks that begin to move in it: there, and in motion in no stage since they arrived.
    """

    name: str
    scene: "Scene"
    formulation: "Formulation"
    present: Bools
    duration: float | None
    acting: StageLoads
    reset: bool
    material: Ints
    sets_out: Bools

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
    held = frozenset[str]()
    material, moved = np.asarray(regions.material), np.zeros(len(regions), dtype=bool)
    for number, table in enumerate(scene.stages):  # a handful of stages
        place = _Place(scene, number, origin)
        present = _present(table, present, regions, place)
        material = _materials(table, material, regions, place)
        formulation = _formulation(table, formulation, place)
        listed |= {kind: table.lists(kind) for kind in KINDS if table.lists(kind) is not None}
        members = members if table.members is None else table.members
        there = {
            one for one in blocks_named(scene, formulation) if present[regions.select(one)].any()
        }
        _refuse_absent(table, there, place)
        named, names, faded = named_in(scene, table, listed, there, before)
        holding = frozenset(one.name for one in named["supports"])
        moves = table.duration is not None and scene.inertia is not None
        sets_out = present & ~moved & moves
        moved = (moved & present) | sets_out
        yield Stage(
            table.name,
            scene.model_copy(update=named | keys_of_stage(scene, table, named, members, there)),
            _of_present(formulation, there),
            present,
            table.duration,
            StageLoads(names - before, faded, table.release, holding - held, scene.in_time),
            table.reset_displacements,
            material,
            sets_out,
        )
        before, held = names, holding


def _materials(table: "StageTable", before: Ints, regions: "Regions", place: "_Place") -> Ints:
    """Return the materials (N,) of all blocks with those that the stage changes."""
    found, known = before.copy(), list(place.scene.materials)
    for block, name in table.materials.items():
        found[_chosen(block, regions, place, "materials")] = known.index(name)
    return found


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


def _refuse_absent(table: "StageTable", there: set[str], place: _Place) -> None:
    """Refuse what a stage lists on a block that is not there, which would act on nothing."""
    for kind, keys in KINDS.items():
        items = [one for key in keys for one in getattr(place.scene, key)]
        for one in items:
            if one.name in (table.lists(kind) or ()) and one.block not in (None, "all", *there):
                value = f'"{one.name}" is on block "{one.block}", which is not there'
                remedy = "take it off the list, or keep the block"
                raise SceneError(place.fault(kind, value, "what is on blocks of the stage", remedy))


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
        key = ".".join(str(part) for part in error.errors(include_url=False)[0]["loc"]) or "cover"
        told = report(error, CoverTable, place.scene.source)[0]
        at = place.fault("cover", f"{key}: {told.value}", told.expected, told.remedy)
        raise FormulationError(at) from None
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
