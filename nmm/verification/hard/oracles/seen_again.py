"""Whether a run of any scene, seen once more from elsewhere, says the same."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from nmm.errors import NmmError
from nmm.verification.base import Check, Checks, holds
from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.cases.transforms import with_loads_times
from nmm.verification.hard.oracles.images import IMAGES, Image, compared
from nmm.verification.hard.oracles.motion import Ran, ran

if TYPE_CHECKING:
    from nmm.stepping.run import Run

LAWS = ("elastic", "orthotropic")

APART = {"order": 1e-3, "shift": 1e-4, "shift up": 1e-4, "mirror": 1e-4, "turn by 37 deg": 1e-4}
"""By how much images of contact may differ: it is solved to 1e-8, impacts enlarge that."""

GROWN = 1e-4
"""The same of growth: what of its energy is booked as work hangs on the projection about tips."""

ANOTHER_WAY = "by another way they may rest under other forces"
"""What a run says whose loose blocks rubbed, or yielded, while they were brought to rest."""

OTHER_STEPS = "the steps of its fields with them"
"""What a run at rest says whose increments were cut: fields then take other steps."""

CHANCE = ("audit penetration", "audit contact_duration", "audit energy_made")
"""Warnings of steps that do not resolve impacts, where rounding chooses what touches first."""


def ways(scene: Document) -> Iterator[str]:
    """Yield the names of what leaves its answer as it is, or multiplies it."""
    cover = scene["formulation"]["cover"]["type"]
    levels = any(key in scene for key in ("seepage", "joint_flow", "water_pressures"))
    yield from ("again", "mm, N, s", "powers of two", "no weight")
    yield from () if "contact" in scene or "records" in scene else ("order",)
    yield from ("shift", "shift up")
    if not levels and "records" not in scene:
        yield from ("turn by 37 deg", "mirror") if cover == "block" else ()
    if linear(scene):
        yield "times -2.5"


def linear(scene: Document) -> bool:
    """Say whether answers are proportional to loads."""
    told = ("contact", "bars", "springs", "foundations", "heat", "seepage", "strength_reduction")
    more = ("water_pressures", "stages", "fracture", "cohesive_zones", "inertia", "duration")
    law = scene["materials"]["rock"].get("law", "elastic")
    bent = scene["formulation"].get("rotation", {}).get("update") in ("finite", "exact")
    pressed = any(load["kind"] == "pressure" for load in scene.get("loads", []))
    return law in LAWS and not bent and not pressed and not any(key in scene for key in told + more)


def seen_again(scene: Document, found: Ran, way: str) -> Checks:
    """Compare with what is seen once more: to the last bit, or to the tolerance of the solution."""
    first = found.run
    if way == "again":
        other = ran(scene).run
        same = all(
            np.array_equal(column, other.history.get(name, column[:0]), equal_nan=True)
            for name, column in first.history.items()
        )
        return {"the same bytes": holds(same, "the same scene in the same process")}
    if way == "times -2.5":
        return {way: _proportional(first, ran(with_loads_times(scene, -2.5)).run, -2.5)}
    image = Image(_idle(scene)) if way == "no weight" else IMAGES[way](scene)
    allowed = APART.get(way, 1e-5) if "contact" in scene else 1e-6
    allowed = max(allowed, GROWN) if {"fracture", "cohesive_zones"} & set(scene) else allowed
    try:
        seen = ran(image.scene).run
    except NmmError as error:
        return {way: holds(False, str(error))}
    if first.summary.status == "converged" != seen.summary.status:
        return {f"{way}: another verdict": holds(False, seen.summary.sentence)}
    # What a run tells rounding may have changed, its image may too.
    allowed = max(allowed, *(2 * run.summary.audits.get("rounding", 0.0) for run in (first, seen)))
    if "inertia" in scene and any(warned_of(run, *CHANCE) for run in (first, seen)):
        return {}
    if any(_another_answer(run) for run in (first, seen)):
        return {}
    return {way: compared(first, seen, image, allowed)}


def warned_of(run: "Run", *names: str) -> bool:
    """Say whether a warning of a run has any of the names."""
    return any(name in warning for warning in run.summary.warnings for name in names)


def _another_answer(run: "Run") -> bool:
    """Say whether a run tells that its answer is one of several."""
    told = any(words in run.summary.sentence for words in (ANOTHER_WAY, OTHER_STEPS))
    return told or warned_of(run, "audit growth_projection")


def _proportional(first: "Run", other: "Run", factor: float) -> Check:
    names = [name for name in first.history if name.startswith("monitor:")]
    ways = np.array([first.history[name][-1] for name in names])
    there = np.array([other.history[name][-1] for name in names])
    size = float(np.abs(factor * ways).max()) or 1.0
    return Check(float(np.abs(there - factor * ways).max()), 0.0, 1e-6, "linearity", size)


def _idle(scene: Document) -> Document:
    """Return a scene that names what has no weight: matter of nothing, a load of no force."""
    rock, joint = scene["materials"]["rock"], {"friction_angle": 0.3}
    none = {"name": "none", "kind": "body", "block": "all", "density": [0.0, 0.0]}
    return {
        **scene,
        "materials": {**scene["materials"], "unused": {**rock}},
        "interfaces": {**scene["interfaces"], "unused": {**joint, "between": ["unused", "unused"]}},
        "loads": [*scene.get("loads", []), none],
    }
