"""Random elastic bodies, held and loaded, glued of pieces: statics without contact."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import shapely

from integration.arrays import Floats
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import (
    BLOCKS,
    glue_methods,
    meshes,
    support_methods,
    with_parts,
)
from nmm.verification.hard.cases.writing import block
from nmm.verification.hard.oracles.linear import judge_linear

MODULI = (1.0, 1e6, 3e10)
RATIOS = (1.0, 1.0, 10.0, 1e3)


class Solids(HardClass):
    """Random bodies with random supports and loads, over every cover, support and glue."""

    name = "solids"
    title = "random elastic bodies of one to three glued pieces, all keys of statics"
    oracle = (
        "equilibrium, work = energy, linearity, reciprocity, invariance under shift to 1e6, "
        "turn, units, order of blocks and corners, neutral effects"
    )
    share = 5

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield one random body under each cover, with a support and glue method drawn."""
        random = np.random.default_rng([seed, 53])
        scene, size = solid(random)
        cell = size * float(random.uniform(0.15, 0.4))
        covers = {**BLOCKS, **meshes(cell), **_varied(cell)}
        for number, (name, cover) in enumerate(covers.items()):
            table = dict(cover)
            if name not in BLOCKS and name != "sub-blocks" and seed % 3:
                table["angle"] = float(random.uniform(-0.7, 0.7))
                table["shift"] = random.uniform(0, 1, 2).tolist()
            support, glue = _method(support_methods(), seed + number), _method(glue_methods(), seed)
            if (
                name in BLOCKS or name == "sub-blocks"
            ):  # they are held by springs; what has no strain is glued so too
                support = "penalty"
                glue = "spring" if name == "rigid" else glue
            made = with_parts(
                scene, {"cover": table, "supports.method": support, "glue.method": glue}
            )
            parts = {"cover": name, "supports": support, "glue": glue}
            label = f"seed {seed}, {name}, {support}, glue {glue}"
            yield HardCase(label, made, judge_linear, parts)


def _varied(cell: float) -> dict[str, Document]:
    """Tables of covers that differ from block to block: in degree, in net, and sub-blocks."""
    mesh = {"type": "triangles", "size": cell, "functions": "monomials", "degree": 1}
    own = {"block": "b0", "size": 0.7 * cell, "angle": 0.3, "shift": [0.3, 0.2]}
    options = {"mesh": "triangles", "glue": "nitsche"}
    return {
        "degree 2 in a block": {**mesh, "regions": [{"block": "b0", "degree": 2}]},
        "a net of its own": {**mesh, "nets": [own]},
        "sub-blocks": {"type": "sub_blocks", "size": cell, "options": options},
    }


def solid(random: np.random.Generator) -> tuple[Document, float]:
    """Return the tables of a random body with what acts on it, and its size (m)."""
    size = float(10.0 ** random.uniform(-1, 1.5))
    outline, hole = _outline(random, size)
    whole = shapely.Polygon(outline, [hole] if hole is not None else [])
    pieces = pieces_of(whole, random, size)
    modulus = float(random.choice(MODULI))
    names = ["soft", "hard"][: 1 + int(len(pieces) > 1)]
    materials = {
        name: {
            "young_modulus": modulus * (float(random.choice(RATIOS)) if name == "hard" else 1.0),
            "poisson_ratio": float(random.choice([0.0, 0.2, 0.3, 0.45])),
            "density": 2000.0,
        }
        for name in names
    }
    blocks = [_block(f"b{n}", piece, names[n % len(names)]) for n, piece in enumerate(pieces)]
    edges = np.stack([outline, np.roll(outline, -1, axis=0)], axis=1)
    chosen = random.permutation(len(edges))
    scene: Document = {
        "plane": str(random.choice(["strain", "stress"])),
        "thickness": float(random.choice([1.0, 0.1])),
        "materials": materials,
        "interfaces": {"glue": {"friction_angle": 0.0, "bonded": True, **_strong()}},
        "blocks": blocks,
        "supports": [
            {"name": "held", "segment": edges[chosen[0]].tolist(), "fix": ["x", "y"]},
        ],
        "loads": _loads(random, edges[chosen[1:]], modulus, size),
        "monitors": _monitors(random, pieces),
    }
    if random.random() < 0.3:
        scene["gravity"] = {"acceleration": (modulus / 2e3 / size * _vector(random, 1e-3)).tolist()}
    return scene, size


def _method(names: list[str], number: int) -> str:
    return names[number % len(names)]


def _strong() -> dict[str, Any]:
    return {"cohesion": 1e20, "tensile_strength": 1e20}


def _vector(random: np.random.Generator, scale: float) -> Floats:
    return np.asarray(random.normal(0, scale, 2))


def _outline(random: np.random.Generator, size: float) -> tuple[Floats, Floats | None]:
    """Return the corners of a body and those of a hole in it, or None."""
    kind = random.choice(["rectangle", "ell", "convex", "hole"])
    width, height = size * random.uniform(0.5, 1.0, 2)
    box = np.array([[0, 0], [width, 0], [width, height], [0, height]])
    if kind == "ell":
        a, b = random.uniform(0.3, 0.7, 2) * (width, height)
        return np.array([[0, 0], [width, 0], [width, b], [a, b], [a, height], [0, height]]), None
    if kind == "convex":
        count = int(random.integers(3, 8))
        angles = 2 * np.pi * (np.arange(count) + random.uniform(-0.3, 0.3, count)) / count
        return 0.5 * size * np.stack([np.cos(angles), np.sin(angles)], axis=1), None
    if kind == "hole":
        angles = 2 * np.pi * np.arange(8) / 8 + random.uniform(0, 1)
        circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        return box, 0.2 * min(width, height) * circle + box.mean(axis=0)
    return box, None


def pieces_of(
    whole: shapely.Polygon, random: np.random.Generator, size: float
) -> list[shapely.Polygon]:
    """Cut a body by up to two lines; slivers are among what comes out."""
    parts = [whole]
    for _ in range(int(random.choice([0, 1, 2]))):
        through = np.array(whole.centroid.coords[0]) + 0.15 * size * random.normal(size=2)
        angle = random.uniform(0, np.pi)
        way = 10 * size * np.array([np.cos(angle), np.sin(angle)])
        line = shapely.LineString([through - way, through + way])
        lines = shapely.union_all([line, *(part.boundary for part in parts)])
        parts = [
            part
            for part in shapely.get_parts(shapely.polygonize([lines]))
            if whole.contains(part.representative_point())
        ]
    return parts


def _block(name: str, piece: shapely.Polygon, material: str) -> Document:
    table = block(name, np.asarray(piece.exterior.coords)[:-1], material)
    if piece.interiors:
        table["holes"] = [np.asarray(ring.coords)[:-1].tolist() for ring in piece.interiors]
    return table


def _loads(
    random: np.random.Generator, edges: Floats, modulus: float, size: float
) -> list[Document]:
    """Tables of one to three loads that strain the body by about a thousandth."""
    loads: list[Document] = []
    for number, edge in enumerate(edges[: int(random.integers(1, 3))]):
        traction = _vector(random, 1e-3 * modulus).tolist()
        loads.append(
            {
                "name": f"edge {number}",
                "kind": "edge",
                "segment": edge.tolist(),
                "traction": traction,
            }
        )
    if random.random() < 0.4:
        density = _vector(random, 1e-3 * modulus / size).tolist()
        loads.append({"name": "body", "kind": "body", "block": "b0", "density": density})
    return loads


def _monitors(random: np.random.Generator, pieces: list[shapely.Polygon]) -> list[Document]:
    """Tables of two monitors a piece, well inside it."""
    tables = []
    for number, piece in enumerate(pieces):
        inside = np.array(piece.representative_point().coords[0])
        tables.append({"name": f"m{number}", "point": inside.tolist(), "block": f"b{number}"})
    return tables
