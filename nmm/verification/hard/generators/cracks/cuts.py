"""Interfaces and edges that lie next to lines of the net: slivers down to 1e-14 of a cell."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from covers.mathematical.base import Cover
from covers.mathematical.registry import cover_class
from integration.arrays import Floats
from nmm.verification.base import Check, Checks
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import glue_methods, meshes, support_methods, with_parts
from nmm.verification.hard.cases.writing import block
from nmm.verification.hard.oracles.motion import ended, ran
from nmm.verification.text import rectangle

AWAY = (0.0, 1e-14, -1e-12, 1e-10, -1e-9, 1e-6, -1e-4, 1e-2)
SIZE = 0.3
BOX = np.array([[0.0, 0.0], [2.0, 1.0]])


def laid(cover: Document, box: Floats) -> Cover:
    """Return the net of a cover's table over a box."""
    chosen: dict[str, Any] = {key: cover[key] for key in ("size", "angle", "shift") if key in cover}
    kind: Any = cover_class(cover["type"])
    made: Cover = kind.regular(box, **chosen, **cover.get("options", {}))
    return made


def net_point(cover: Document, box: Floats) -> Floats:
    """Return the corner (2,) of the net of a cover over a box that is nearest to its middle."""
    vertices = laid(cover, box).vertices
    off = np.linalg.norm(vertices - box.mean(axis=0), axis=1)
    return np.asarray(vertices[off.argmin()])


class Cuts(HardClass):
    """Two glued blocks whose common edge runs through or beside a corner of the net."""

    name = "cuts"
    title = "two glued blocks, their edge 0 to 1e-2 of a cell beside a corner of the net"
    oracle = "uniform stress under uniform tension, energy sigma^2 A / 2 E"
    share = 4

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield every cover and degree, with one of each method and distance."""
        random = np.random.default_rng([seed, 61])
        for number, (name, cover) in enumerate(meshes(SIZE).items()):
            away = AWAY[(seed + number) % len(AWAY)]
            angle = float(random.choice([0.0, 0.0, 0.3, np.pi / 4]))
            table = {**cover, "angle": angle}
            glue = glue_methods()[(seed + number) % 3]
            support = support_methods()[(seed + number // 3) % 3]
            scene = with_parts(_bar(table, away), {"glue.method": glue, "supports.method": support})
            parts = {"cover": name, "glue": glue, "supports": support}
            label = (
                f"{away:g} of a cell, net at {angle:.3g}, seed {seed}, {name}, {support}, {glue}"
            )
            yield HardCase(label, scene, _uniform, parts)


def _bar(cover: Document, away: float) -> Document:
    """Return the tables of a bar of two blocks under unit tension."""
    edge = float(net_point(cover, BOX)[0] + away * SIZE)
    strong = {"friction_angle": 0.0, "bonded": True, "cohesion": 1e9, "tensile_strength": 1e9}
    return {
        "plane": "stress",
        "materials": {"m": {"young_modulus": 1e3, "poisson_ratio": 0.3}},
        "interfaces": {"glue": strong},
        "blocks": [
            block("left", rectangle((0, 0), (edge, 1)), "m"),
            block("right", rectangle((edge, 0), (2, 1)), "m"),
        ],
        "supports": [
            {"name": "wall", "segment": [[0, 0], [0, 1]], "fix": ["x"]},
            {"name": "floor", "segment": [[0, 0], [2, 0]], "fix": ["y"]},
        ],
        "loads": [
            {"name": "pull", "kind": "edge", "segment": [[2, 0], [2, 1]], "traction": [1.0, 0.0]}
        ],
        "formulation": {"cover": cover},
    }


def _uniform(scene: Document) -> Checks:
    found = ran(scene)
    checks = ended(found)
    if not found.run.summary.steps:
        return checks
    exact = laid(scene["formulation"]["cover"], BOX).weight_degree is not None
    # Weights that are no polynomials are not integrated exactly: the patch test to 1e-2 only.
    tolerance = 1e-6 if exact else 1e-2
    off = np.abs(found.run.stress - np.array([1.0, 0.0, 0.0]))
    areas = found.run.manifold.elements.areas
    slivers = areas < 1e-9 * areas.max()
    energy = float(found.run.history["strain_energy"][-1])
    reason = "uniform tension is in every cover"
    largest = float(off[slivers].max(initial=0.0))
    return checks | {
        "stress": Check(float(off[~slivers].max()), 0.0, tolerance, reason, 1.0),
        # What a sliver of 1e-14 of a cell does is felt by nobody.
        "stress of slivers": Check(largest, 0.0, max(tolerance, 1e-4), reason, 1.0),
        "energy": Check(energy, 1e-3, tolerance, "sigma^2 A / 2 E"),
        "area": Check(float(areas.sum()), 2.0, 1e-12, "kept by the cut"),
    }
