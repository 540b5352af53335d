"""Cracks that cross, meet and end: which pieces a body falls into, and how large they are."""

from collections.abc import Iterator

import numpy as np
import shapely

from integration.arrays import Floats
from nmm.verification.base import Check, Checks
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import meshes, with_parts
from nmm.verification.hard.cases.writing import block
from nmm.verification.hard.oracles.motion import prepared

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
FIVE = (
    ((-1, 0.1), (2, 0.7)),
    ((0.2, -1), (0.6, 2)),
    ((-1, 1.3), (2, -0.5)),
    ((0.85, -1), (0.75, 2)),
    ((-1, 0.45), (2, 0.4)),
)
DANGLING = (
    ((0, 0.3), (0.7, 0.3)),
    ((0.5, 0), (0.5, 0.8)),
    ((0.2, 0.3), (0.2, 1)),
    ((0.2, 0.7), (0.5, 0.7)),
    ((0.7, 0.3), (0.7, 0.6)),
    ((0.6, 0.9), (0.9, 0.9)),
)


class PieceCases(HardClass):
    """Networks of cracks in a unit square, over every cover that cracks can cut."""

    name = "pieces"
    title = "networks of cracks: five lines, dead ends, T and X, two to five branches at a point"
    oracle = "number and areas of pieces by polygon arithmetic (shapely)"
    share = 3

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield four networks with every cover."""
        random = np.random.default_rng([seed, 67])
        networks = {
            "five lines": np.array(FIVE, dtype=float),
            "dead ends": np.array(DANGLING, dtype=float),
            f"{2 + seed % 4} branches": _branches(2 + seed % 4, random),
            "random": _random(random),
        }
        covers = meshes(float(random.choice([0.09, 0.25, 0.7])), (1,))
        for words, lines in networks.items():
            for name, cover in covers.items():
                table = {**cover, "angle": float(random.choice([0.0, 0.4]))}
                label = f"{words}, size {cover['size']:g}, seed {seed}, {name}"
                yield HardCase(label, _network(lines, table), _counted, {"cover": name})


def _branches(count: int, random: np.random.Generator) -> Floats:
    """Rays from one point to beyond the square."""
    middle = random.choice([np.array([0.5, 0.5]), random.uniform(0.3, 0.7, 2)])
    angles = 2 * np.pi * (np.arange(count) + random.uniform(0, 0.6, count)) / count
    ends = middle + 2.0 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return np.stack([np.broadcast_to(middle, ends.shape), ends], axis=1)


def _random(random: np.random.Generator) -> Floats:
    """Three to seven segments, some through the corners of others."""
    lines = random.uniform(-0.3, 1.3, (int(random.integers(3, 8)), 2, 2))
    lines[1, 0] = lines[0].mean(axis=0)  # a T
    lines[2] = lines[2] - lines[2].mean(axis=0) + lines[0, 0]  # through the end of another
    # A crack that meets no block is refused.
    meets = shapely.intersects(shapely.linestrings(lines), shapely.Polygon(SQUARE))
    return np.asarray(lines[meets])


def _network(lines: Floats, cover: Document) -> Document:
    scene: Document = {
        "plane": "strain",
        "materials": {"m": {"young_modulus": 1.0, "poisson_ratio": 0.3, "density": 1.0}},
        "blocks": [block("square", SQUARE, "m")],
        "cracks": [
            {"name": f"c{number}", "points": line.tolist()} for number, line in enumerate(lines)
        ],
        "inertia": {},
        "duration": 1.0,
    }
    return with_parts(scene, {"cover": cover})


def _counted(scene: Document) -> Checks:
    """Compare the bodies of the manifold with what shapely makes of the lines."""
    manifold = prepared(scene).stepper.model.manifold
    found = np.sort(np.bincount(manifold.element_body, manifold.elements.areas))
    lines = [shapely.LineString(crack["points"]) for crack in scene["cracks"]]
    edge = shapely.Polygon(scene["blocks"][0]["vertices"])
    # On a grid, since ends that lie on other cracks do so to rounding only.
    noded = shapely.union_all([*lines, edge.boundary], grid_size=1e-10)
    parts = shapely.get_parts(shapely.polygonize([noded]))
    right = np.sort([p.area for p in parts if edge.contains(p.representative_point())])
    checks = {"pieces": Check(float(len(found)), float(len(right)), 0.0, "polygon arithmetic")}
    if len(found) == len(right):
        off = float(np.abs(found - right).max())
        checks["areas"] = Check(off, 0.0, 1e-9, "crossings are rounded", 1.0)
    return checks
