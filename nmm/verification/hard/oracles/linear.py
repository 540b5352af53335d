"""Oracles of linear statics that need no answer."""

from typing import TYPE_CHECKING

import numpy as np
import shapely

from integration.arrays import Floats
from nmm.verification.base import Check, Checks
from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.cases.transforms import (
    listed_anew,
    shifted,
    turned,
    with_loads_times,
)
from nmm.verification.hard.cases.units import in_units
from nmm.verification.hard.oracles.motion import ended, ran

if TYPE_CHECKING:
    from nmm.stepping.run import Run

FAR = (1.1e6, -0.9e6)
TURN = 0.613
ROUNDING = 1e-6
"""Of energies and displacements, relative to the largest: residuals are held to 1e-8."""

FORESEEN = 100.0
"""Times the rounding that a run tells by which two images of it may differ."""


def judge_linear(scene: Document) -> Checks:
    """Run a body and its images, and compare."""
    found = ran(scene)
    checks = ended(found)
    if not found.run.summary.steps or not all(check.passed for check in checks.values()):
        return checks
    first = found.run
    allowed = max(ROUNDING, FORESEEN * first.summary.audits.get("rounding", 0.0))
    checks |= equilibrium(scene, first) | work(first, allowed) | records(first)
    ways = monitored(first)
    size = float(np.ptp(first.manifold.elements.points, axis=0).max())
    images = {
        "order of blocks and corners": (listed_anew(scene, 5), 1.0, 0.0),
        # Coordinates of 1e6 m are rounded to 1e-10 m.
        "shift to 1e6": (shifted(scene, FAR), 1.0, 0.0),
        "other units": (in_units(scene, 1e3, 1e-3), 1e3, 0.0),
        "loads times -2.5": (with_loads_times(scene, -2.5), -2.5, 0.0),
        "named effects of no weight": (_idle(scene), 1.0, 0.0),
    }
    if scene["formulation"]["cover"]["type"] == "block":  # nets would lie otherwise
        images["turn"] = (turned(scene, TURN), 1.0, TURN)
    for name, (image, factor, angle) in images.items():
        checks |= _compared(name, image, ways, factor, angle, size, allowed)
    return checks | reciprocity(scene, allowed)


def reciprocity(scene: Document, allowed: float = ROUNDING) -> Checks:
    """Two unit loads: each does the same work on the motion of the other (Betti 1872)."""
    places = [scene["monitors"][0], scene["monitors"][-1]]
    modulus = min(table["young_modulus"] for table in scene["materials"].values())
    ends = np.concatenate([np.array(table["vertices"]) for table in scene["blocks"]])
    force = 1e-3 * modulus * scene.get("thickness", 1.0) * float(np.ptp(ends, axis=0).max())
    axes = np.array([[0.8, -0.6], [0.6, 0.8]])
    moved: list[dict[str, Floats]] = []
    for place, axis in zip(places, axes, strict=True):
        load = {**place, "name": "one", "kind": "point", "force": (force * axis).tolist()}
        found = ran({**_unloaded(scene), "loads": [load]})
        if found.run.summary.status != "converged":
            return {"reciprocity": ended(found)["converged"]}
        moved.append(monitored(found.run))
    one = float(moved[0][places[1]["name"]] @ axes[1])
    other = float(moved[1][places[0]["name"]] @ axes[0])
    size = max(float(np.abs(way).max()) for each in moved for way in each.values())
    return {"reciprocity": Check(abs(one - other) / size, 0.0, allowed, "Betti", 1.0)}


def _unloaded(scene: Document) -> Document:
    return {key: value for key, value in scene.items() if key not in ("loads", "gravity")}


def equilibrium(scene: Document, run: "Run") -> Checks:
    """Reactions and loads cancel."""
    total, size = applied(scene)
    axes = []
    for axis in "xy":
        names = [n for n in run.history if n.startswith("reaction:") and n.endswith(f":{axis}")]
        axes.append(sum(float(run.history[name][-1]) for name in names))
    off = float(np.abs(np.array(axes) + total).max() / size)
    return {"equilibrium": Check(off, 0.0, 1e-6, "residual of the solver", 1.0)}


def applied(scene: Document) -> tuple[Floats, float]:
    """Resultant (2,) of all loads and weight, and the sum of their sizes (N)."""
    thickness = scene.get("thickness", 1.0)
    forces = []
    areas = {
        table["name"]: shapely.Polygon(table["vertices"], table.get("holes", [])).area
        for table in scene["blocks"]
    }
    for load in scene.get("loads", []):
        if load["kind"] == "edge":
            length = float(np.linalg.norm(np.subtract(*load["segment"])))
            forces.append(thickness * length * np.array(load["traction"]))
        elif load["kind"] == "body":
            forces.append(thickness * areas[load["block"]] * np.array(load["density"]))
        else:
            forces.append(np.array(load["force"]))
    if "gravity" in scene:
        for table in scene["blocks"]:
            density = scene["materials"][table["material"]]["density"]
            mass = thickness * areas[table["name"]] * density
            forces.append(mass * np.array(scene["gravity"]["acceleration"]))
    total = np.sum(forces, axis=0)
    return total, float(np.sum(np.abs(forces))) or 1.0


def work(run: "Run", allowed: float = ROUNDING) -> Checks:
    """Half the work of loads at their last value is what is stored."""
    h = run.history
    stored = sum(float(column[-1]) for name, column in h.items() if name.endswith("_energy"))
    done = float(h["external_work"][-1])
    off = abs(done - stored) / max(abs(stored), 1e-300)
    return {"work = energy": Check(off, 0.0, allowed, "linear statics", 1.0)}


def records(run: "Run") -> Checks:
    """Summary, history and frames say the same."""
    h, summary, last = run.history, run.summary, run.frames[-1]
    steps = Check(float(summary.steps), float(len(h["step"])), 0.0, "one row a step")
    residual = Check(
        summary.equilibrium_residual or 0.0, float(h["residual"].max()), 0.0, "the largest of rows"
    )
    moved = np.abs(last.points - run.frames[0].points - last.displacement).max()
    largest = np.abs(last.displacement).max() or 1.0
    scale = largest + 1e-10 * np.abs(last.points).max()
    return {
        "steps of the summary": steps,
        "residual of the summary": residual,
        "frames": Check(float(moved), 0.0, 1e-6, "points have moved by displacements", scale),
    }


def monitored(run: "Run") -> dict[str, Floats]:
    """Displacement (2,) of every monitor at the end (m)."""
    names = [name.split(":")[1] for name in run.history if name.endswith(":ux")]
    return {
        name: np.array([run.history[f"monitor:{name}:u{axis}"][-1] for axis in "xy"])
        for name in names
    }


def _compared(
    name: str,
    image: Document,
    ways: dict[str, Floats],
    factor: float,
    angle: float,
    size: float,
    allowed: float,
) -> Checks:
    found = ran(image)
    if found.run.summary.status != "converged":
        return {name: ended(found)["converged"]}
    c, s = np.cos(angle), np.sin(angle)
    matrix = factor * np.array([[c, -s], [s, c]])
    seen = monitored(found.run)
    largest = max(float(np.abs(way).max()) for way in ways.values()) * abs(factor)
    off = max(float(np.abs(seen[key] - matrix @ way).max()) for key, way in ways.items())
    # Ways below 1e-12 of the size are rounding.
    scale = largest + 1e-12 * size * abs(factor)
    return {name: Check(off / scale, 0.0, allowed, "rounding, or what the run says of it", 1.0)}


def _idle(scene: Document) -> Document:
    """Return a scene that names more than it has: a material, an interface, a monitor, a load."""
    made = {
        **scene,
        "materials": {
            **scene["materials"],
            "unused": {"young_modulus": 7.0, "poisson_ratio": 0.1, "density": 1.0},
        },
        "interfaces": {
            **scene.get("interfaces", {}),
            "unused": {"friction_angle": 0.3, "between": ["unused", "unused"]},
        },
        "loads": [
            *scene.get("loads", []),
            {"name": "none", "kind": "body", "block": "b0", "density": [0.0, 0.0]},
        ],
    }
    made["loading"] = {"until": 1.0}
    return made
