"""Whether what a run of any scene claims is so, by what needs no answer.

A run that says it has failed, is unbalanced or spent has told; what says it is right is checked.
A solver that gave up may have been wrong to, which no oracle sees: such runs are counted.
"""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.verification.base import Check, Checks, holds, limit
from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.oracles.linear import applied
from nmm.verification.hard.oracles.motion import (
    OVERLAP,
    Ran,
    energy_checks,
    overlap,
    prepared,
    ran,
)
from nmm.verification.hard.oracles.seen_again import linear, seen_again, warned_of

if TYPE_CHECKING:
    from nmm.stepping.run import Run

SURE = ("converged", "failure_load")
"""Ends that claim an answer."""

GAVE_UP = "gave up"
"""Of a run that ends `failed`: 1, which is no miss."""

HOLD_ELSEWHERE = (
    *("springs", "foundations", "dashpots", "viscous_boundaries", "water_pressures", "bars"),
    *("seepage", "joint_flow", "masses", "initial_stresses", "stages", "splitting", "fracture"),
    *("cohesive_zones", "free_fields", "strength_reduction"),
)
"""Tables whose forces no reaction of a support shows, or whose loads are not those of the file."""


def sound(scene: Document, way: str) -> Checks:
    """Run a scene, and see it once more from elsewhere.

    Raises
    ------
    NmmError
        When it is refused before it runs.
    """
    prepared(scene)
    try:
        found = ran(scene)
    except NmmError as error:
        # Strengths over a factor are known to be refused once the factor is tried.
        named = str(error).startswith("strength_reduction: strengths over")
        return {"refused before it runs": holds(named, str(error))}
    checks = _gave_up(found.run) | _records(found.run) | _named(scene, found.run)
    checks |= _finite(found.run)
    if found.run.summary.status in SURE and found.run.summary.steps:
        checks |= _balance(scene, found)
        checks |= {} if "contact" not in scene or _springy(scene) else _apart(found.run)
        checks |= seen_again(scene, found, way)
    return checks


def _gave_up(run: "Run") -> Checks:
    """Say whether the solver gave up, and why."""
    if run.summary.status != "failed":
        return {}
    return {GAVE_UP: limit(1.0, 1.0, run.summary.sentence)}


def _finite(run: "Run") -> Checks:
    """Nothing that is stored of a run that claims an answer is infinite, and no energy missing."""
    strange = [
        name
        for name, column in run.history.items()
        if np.any(np.isinf(column)) or (name.endswith("_energy") and np.any(np.isnan(column)))
    ]
    right = run.summary.status not in SURE or not strange
    return {"finite": holds(right, ", ".join(strange))}


def _balance(scene: Document, found: Ran) -> Checks:
    """Reactions carry the loads, work is stored, energy is not made; or a warning says so."""
    run, checks = found.run, Checks()
    timed = "inertia" in scene or "duration" in scene
    if not timed and not any(key in scene for key in HOLD_ELSEWHERE):
        checks |= _carried(scene, run)
    if "inertia" in scene and not _brought(scene):
        checks |= {"a rise is told": energy_checks(found)["a rise is told"]}
    if not timed and linear(scene) and "initial_stresses" not in scene:
        h = run.history
        stored = sum(float(column[-1]) for name, column in h.items() if name.endswith("_energy"))
        done = float(h["external_work"][-1])
        off = abs(done - stored) / max(abs(stored), abs(done), 1e-300)
        checks["work = energy"] = limit(
            0.0 if warned_of(run, "work_not_stored") else off, 1e-5, "linear statics"
        )
    return checks


def _brought(scene: Document) -> bool:
    """Say whether something else than loads and weight brings energy."""
    tables = ("records", "heat", "seepage", "water_pressures", "joint_flow", "initial_stresses")
    more = ("splitting", "springs", "bars", "fracture", "cohesive_zones", "foundations", "masses")
    moved = any({"displacement", "field"} & set(table) for table in scene.get("supports", []))
    return moved or any(key in scene for key in tables + more)


def _carried(scene: Document, run: "Run") -> Checks:
    """Reactions of supports cancel the loads of the file, resultants worked out from it alone."""
    loads = [load for load in scene.get("loads", []) if load["kind"] != "moving"]
    pressed = any(load["kind"] == "pressure" for load in loads)
    moved = any({"displacement", "field"} & set(table) for table in scene["supports"])
    fielded = any("field" in load for load in loads)
    told = warned_of(run, "residual", "equilibrium", "force")
    if pressed or moved or fielded or told or any("history" in load for load in loads):
        return {}
    if not loads and "gravity" not in scene:
        return {}
    total, size = applied({**scene, "loads": loads})
    factor = float(run.history["load_factor"][-1])
    weight, _ = applied({**scene, "loads": []}) if "gravity" in scene else (np.zeros(2), 0.0)
    names = [[n for n in run.history if n.startswith("reaction:") and n.endswith(a)] for a in "xy"]
    held = np.array([sum(float(run.history[n][-1]) for n in names[axis]) for axis in range(2)])
    off = float(np.abs(held + factor * (total - weight) + weight).max() / (factor * size))
    return {"equilibrium": Check(off, 0.0, 1e-5, "resultants of the file", 1.0)}


def _apart(run: "Run") -> Checks:
    """Nobody is in anybody, or the run says how deep."""
    if len(run.topologies) > 1 or warned_of(run, "penetration", "overlap"):
        return {}
    return {"overlap of bodies": limit(overlap(run.frames[-1].points, run), 5 * OVERLAP, "shapely")}


def _springy(scene: Document) -> bool:
    """Say whether joints have a stiffness of their own, by which bodies come nearer."""
    return any("normal_stiffness" in table for table in scene["interfaces"].values())


def _records(run: "Run") -> Checks:
    """Summary, history and frames say the same."""
    if not run.summary.steps:
        return {}
    last, rows = run.frames[-1], float(len(run.history["step"]))
    checks = {"steps of the summary": Check(float(run.summary.steps), rows, 0.0, "rows")}
    if run.summary.status == "converged":
        off = np.abs(last.points - run.stepper.place(run.state) - run.origin).max()
        checks["last frame"] = Check(float(off), 0.0, 1e-12, "the last state", _reach(last.points))
    return checks


def _reach(points: Floats) -> float:
    return float(np.abs(points).max()) or 1.0


def _named(scene: Document, run: "Run") -> Checks:
    """Effects that ran are those whose tables stand in the file."""
    loads = scene.get("loads", [])
    kinds = {load["kind"] for load in loads if "field" not in load}
    bonded = any(table.get("bonded") for table in scene["interfaces"].values())
    damping = scene.get("damping", {})
    there = {
        **{"loads": bool(kinds & {"edge", "point"}), "body loads": "body" in kinds},
        **{"pressures": "pressure" in kinds, "moving loads": "moving" in kinds},
        **{"field loads": any("field" in load for load in loads)},
        **{"viscous damping": bool({"mass", "stiffness", "ratios"} & set(damping))},
        **{"local damping": "local" in damping, "dowels": any("dowel" in b for b in _bars(scene))},
        **{"bonded interfaces": bonded and "contact" not in scene},
        **{"initial velocity": "initial_velocities" in scene},
        **{"initial stress": "initial_stresses" in scene},
        **{"consolidation": scene.get("seepage", {}).get("coupled", False)},
        **{"transient joint flow": scene.get("joint_flow", {}).get("transient", False)},
        **{"changed materials": any("materials" in one for one in scene.get("stages", []))},
        **{"unreleased forces": any("release" in one for one in scene.get("stages", []))},
        **{"fracture in time": {"fracture", "inertia"} <= set(scene)},
    }
    strange = [
        name
        for name in run.summary.effect_seconds
        if not there.get(name, name.replace(" ", "_") in scene)
    ]
    return {"effects nobody named": holds(not strange, ", ".join(strange))}


def _bars(scene: Document) -> list[Document]:
    return list(scene.get("bars", []))
