"""The same scene seen from elsewhere: shifted, turned, in other units, listed in another order."""

from collections.abc import Callable
from copy import deepcopy
from typing import Any

import numpy as np

from integration.arrays import Floats
from nmm.verification.hard.cases.base import Document

POINTS = ("vertices", "region", "keep", "points", "segment", "polygon", "phreatic_line")
POINT = ("point", "origin", "about")
VECTORS = (
    *("displacement", "force", "traction", "acceleration", "velocity", "density"),
    *("gradient", "direction"),
)
LEVELS = {
    **{"heads": "head", "joint_heads": "head"},
    **{"water_pressures": "level", "initial_stresses": "surface"},
}
FORMULATION_POINTS = ("corners", "focus")

Map = Callable[[Floats], Floats]


def mapped(scene: Document, place: Map, vector: Map, turn: float = 0.0) -> Document:
    """Return a scene with every point, vector, stress and angle mapped.

    Parameters
    ----------
    scene
        Tables; they are not changed.
    place, vector
        Maps of points and of vectors (n, 2).
    turn
        Angle in radians that stresses, dips and nets turn by.
    """
    weight = {"acceleration": [0.0, -9.81], **scene["gravity"]} if "gravity" in scene else {}
    told = {**scene, "gravity": weight} if weight else scene
    return {key: _mapped(key, value, place, vector, turn) for key, value in told.items()}


def shifted(scene: Document, by: tuple[float, float]) -> Document:
    """Return a scene laid elsewhere (m), with the levels of its waters; histories scale these."""
    made = mapped(scene, lambda points: points + np.asarray(by), lambda vectors: vectors)
    tables = [(key, item) for name, key in LEVELS.items() for item in made.get(name, [])]
    heads = [("initial", made.get(name, {})) for name in ("seepage", "joint_flow")]
    for key, table in [*tables, *heads]:
        if key in table:
            table[key] += by[1]
    return made


def turned(scene: Document, angle: float) -> Document:
    """Return a scene turned about the origin (rad); supports of one axis alone cannot be."""
    c, s = np.cos(angle), np.sin(angle)
    matrix = np.array([[c, s], [-s, c]])
    return mapped(scene, lambda p: p @ matrix, lambda v: v @ matrix, angle)


def mirrored(scene: Document) -> Document:
    """Return a scene with x and -x exchanged; joint sets, nets and records are not mirrored."""
    flip = np.array([-1.0, 1.0])
    made = mapped(scene, lambda points: points * flip, lambda vectors: vectors * flip)
    for velocity in made.get("initial_velocities", []):
        if "angular_velocity" in velocity:
            velocity["angular_velocity"] *= -1.0
    for stress in made.get("initial_stresses", []):
        stress["stress"][2] *= -1.0
    for table in made.get("materials", {}).values():
        if "axis_angle" in table:
            table["axis_angle"] *= -1.0
    return made


def listed_anew(scene: Document, seed: int) -> Document:
    """Return a scene whose blocks, supports and loads stand in another order.

    Corners of blocks begin elsewhere and every second block turns the other way round.
    """
    random = np.random.default_rng(seed)
    made = deepcopy(scene)
    for name in ("blocks", "supports", "loads", "monitors", "joint_sets"):
        if name in made:
            made[name] = [made[name][i] for i in random.permutation(len(made[name]))]
    for number, table in enumerate(made.get("blocks", [])):
        ring = table["vertices"]
        start = int(random.integers(len(ring)))
        ring = ring[start:] + ring[:start]
        table["vertices"] = ring[::-1] if number % 2 else ring
    return made


def with_loads_times(scene: Document, factor: float) -> Document:
    """Return a scene with everything that acts multiplied."""
    made = deepcopy(scene)
    for table, keys in (
        ("loads", ("force", "traction", "density")),
        ("supports", ("displacement",)),
        ("initial_stresses", ("stress",)),
    ):
        for entry in made.get(table, []):
            for key in keys:
                if key in entry:
                    entry[key] = [factor * value for value in entry[key]]
    if "gravity" in made:
        acceleration = made["gravity"].get("acceleration", [0.0, -9.81])
        made["gravity"] = {"acceleration": [factor * value for value in acceleration]}
    return made


def _mapped(key: str, value: Any, place: Map, vector: Map, turn: float) -> Any:
    if isinstance(value, dict):
        return {name: _mapped(name, item, place, vector, turn) for name, item in value.items()}
    if key in (*POINTS, *FORMULATION_POINTS) and value and not isinstance(value, str):
        return place(np.asarray(value, dtype=float)).tolist()
    if key == "holes":
        return [place(np.asarray(ring, dtype=float)).tolist() for ring in value]
    if key in POINT and value:
        return place(np.asarray([value], dtype=float))[0].tolist()
    if key in VECTORS and isinstance(value, list):
        return vector(np.asarray([value], dtype=float))[0].tolist()
    if key == "stress" and turn and isinstance(value, list):
        return _turned_stress(value, turn)
    if key in ("dip", "angle", "axis_angle"):
        return value + turn
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [_mapped(key, item, place, vector, turn) for item in value]
    return deepcopy(value)


def _turned_stress(stress: list[float], angle: float) -> list[float]:
    mean, half = (stress[0] + stress[1]) / 2, (stress[0] - stress[1]) / 2
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    off = half * c - stress[2] * s
    return [float(mean + off), float(mean - off), float(half * s + stress[2] * c)]
