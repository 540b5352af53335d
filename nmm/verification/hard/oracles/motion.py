"""Oracles of bodies that move and touch: energy, who is inside whom, area, momentum."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import shapely

from integration.arrays import Floats
from integration.polygons import diameters
from nmm.verification.base import Check, Checks, holds, limit
from nmm.verification.hard.cases.base import Document

if TYPE_CHECKING:
    from nmm.stepping.run import Run
    from nmm.stepping.simulation import Simulation

STEP_RISE = 1e-6
"""Largest rise of energy in a step, in the turnover."""

RUN_RISE = 1e-4
"""Largest rise of energy over its lowest value before, in the turnover."""

UNTOLD = 2.0
"""Times as large as it may be: the audit's turnover holds losses too, and so is larger."""

OVERLAP = 1e-3
"""Largest part of a body that may lie in another: springs of 10 E give by 1e-4 in an impact."""

THINNEST = 0.02
"""Smallest area of an element in its squared diameter: what is thinner is held to that."""

STRETCH = 1e-3
"""Largest change of all areas, in their sum: at 1 m/s rock is strained by 4e-4."""

SQUEEZE = 0.05
"""Largest change of one body's area: a sliver between corners is strained by 2 %."""

FRAMES = 12
"""Frames whose bodies are intersected."""


@dataclass(frozen=True)
class Ran:
    """A run and the energy it started with (J)."""

    run: "Run"
    start: float


def ran(scene: Document) -> Ran:
    """Run a scene of tables."""
    from nmm.scene import parse_scene
    from nmm.stepping.run import run
    from nmm.verification.hard.cases.files import toml

    read = parse_scene(toml(scene), "hard case")
    begun = begun_energy(scene)
    return Ran(run(read), begun)


def prepared(scene: Document) -> "Simulation":
    """Return a scene of tables, compiled and not run."""
    from nmm.formulation import Formulation
    from nmm.scene import parse_scene
    from nmm.stepping.prepare import prepare
    from nmm.verification.hard.cases.files import toml

    read = parse_scene(toml(scene), "hard case")
    return prepare(read, read.formulation or Formulation())


def begun_energy(scene: Document) -> float:
    """Kinetic energy of the start (J)."""
    if not scene.get("initial_velocities"):
        return 0.0
    ready = prepared(scene)
    return float(ready.stepper.plan.energy("inertia", ready.start))


def energies(found: Ran) -> Floats:
    """Stored energy less the work of loads (J), the start and every step."""
    h = found.run.history
    stored = sum(column for name, column in h.items() if name.endswith("_energy"))
    return np.concatenate([[found.start], np.asarray(stored - h["external_work"])])


def turnover(found: Ran) -> float:
    """Largest of what was done by loads, moved and stored (J)."""
    h = found.run.history
    names = ("kinetic_energy", "strain_energy", "contact_energy")
    stored = [float(h[name].max()) for name in names]
    return max(found.start, float(np.abs(h["external_work"]).max()), *stored)


def energy_checks(found: Ran) -> Checks:
    """Energy is never made, and where it is the run says so."""
    energy, size = energies(found), max(turnover(found), 1e-300)
    lowest = np.minimum.accumulate(energy)
    rise, climb = np.diff(energy).max(initial=0.0), (energy - lowest).max(initial=0.0)
    reason = "energy that nobody brought"
    small = rise <= UNTOLD * STEP_RISE * size and climb <= UNTOLD * RUN_RISE * size
    told = any("energy_made" in warning for warning in found.run.summary.warnings)
    return {
        "rise in a step": limit(float(rise / size), STEP_RISE, reason),
        "rise in the run": limit(float(climb / size), RUN_RISE, reason),
        "a rise is told": holds(small or told, "a warning of the audit of energy"),
    }


def overlap(points: Floats, found: "Run") -> float:
    """Largest part of an element that lies in an element of another body, by shapely.

    Bodies lie in each other by what the run tells in its audit `penetration`: a strip of that depth
    along the smaller of both does not count.
    """
    topology = found.topologies[0]
    elements = topology.elements.with_points(points)
    shapes = shapely.make_valid(elements.to_shapely())
    one, other = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    body = found.manifold.element_body
    apart = (one < other) & (body[one] != body[other])
    one, other = one[apart], other[apart]
    if not len(one):
        return 0.0
    shared = shapely.area(shapely.intersection(shapes[one], shapes[other]))
    across = diameters(elements)
    size = np.maximum(shapely.area(shapes), THINNEST * across**2)
    measured = found.summary.audits.get("penetration", 0.0)
    area = found.manifold.body_area[body]
    deep = measured * np.sqrt(np.minimum(area[one], area[other]))
    told = deep * np.minimum(across[one], across[other])
    untold = np.maximum(shared - told, 0.0)
    return float((untold / np.minimum(size[one], size[other])).max())


def body_checks(found: Ran) -> Checks:
    """Nobody through anybody, and bodies keep their area."""
    run = found.run
    chosen = np.unique(np.linspace(1, len(run.frames) - 1, FRAMES).astype(int))
    deep = max(overlap(run.frames[index].points, run) for index in chosen)
    elements = run.topologies[0].elements
    change = np.abs(elements.with_points(run.frames[-1].points).areas - elements.areas)
    return {
        "overlap of bodies": limit(
            deep, OVERLAP, "part of the smaller body, shapely, beyond penetration"
        ),
        "change of area": limit(
            float(change.sum() / elements.areas.sum()), STRETCH, "strain of an impact"
        ),
        "change of one area": limit(
            float((change / elements.areas).max()), SQUEEZE, "strain of a sliver"
        ),
    }


def momentum_checks(
    scene: Document,
    found: Ran,
    to: float = 1e-9,
    reason: str = "rounding of the solver over hundreds of steps",
) -> Checks:
    """Without loads and supports momentum stays as it began, ``to`` a share for a ``reason``."""
    from types import SimpleNamespace
    from typing import cast

    from nmm.verification.reading import momentum

    ready = prepared(scene)
    first = momentum(cast("Run", SimpleNamespace(state=ready.start, stepper=ready.stepper)))
    last, run = momentum(found.run), found.run
    mass = float(np.sum(run.manifold.elements.areas)) * run.stepper.model.density.max()
    speed = np.sqrt(2 * found.start / mass)
    scale = mass * speed * np.array([1.0, 1.0, run.stepper.size])
    off = np.abs(last - first) / scale
    return {
        name: Check(float(error), 0.0, to, reason, 1.0)
        for name, error in zip(("momentum x", "momentum y", "angular momentum"), off, strict=True)
    }


def ended(found: Ran) -> Checks:
    """The run came to its end, or says why not."""
    summary = found.run.summary
    return {"converged": holds(summary.status == "converged", summary.sentence)}


def moving(scene: Document) -> Checks:
    """All that must hold of bodies that move and touch under weight or none."""
    found = ran(scene)
    checks = ended(found)
    if found.run.summary.steps:
        checks |= energy_checks(found) | body_checks(found)
    return checks


def flying(scene: Document) -> Checks:
    """`moving` for bodies that nothing holds and no load acts on: momentum too."""
    found = ran(scene)
    checks = ended(found)
    if found.run.summary.steps:
        checks |= energy_checks(found) | body_checks(found) | momentum_checks(scene, found)
    return checks
