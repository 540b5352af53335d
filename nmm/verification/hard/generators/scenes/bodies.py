"""Bodies of random scenes: pieces of a wall that is held below, one that falls on it, a flight."""

import numpy as np
import shapely

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.cases.writing import block
from nmm.verification.hard.generators.motions import cracked, thrown
from nmm.verification.hard.generators.random_solids import pieces_of


def wall(random: np.random.Generator) -> tuple[Document, float]:
    """Return the tables of one to five pieces of a rectangle, held below, and its height (m)."""
    height = float(10.0 ** random.uniform(-0.5, 1.0))
    width = height * float(random.uniform(0.6, 1.6))
    whole = shapely.box(0.0, 0.0, width, height)
    pieces = pieces_of(whole, random, height)
    blocks = [
        block(f"b{number}", np.asarray(piece.exterior.coords)[:-1])
        for number, piece in enumerate(pieces)
    ]
    scene: Document = {
        "plane": str(random.choice(["strain", "stress"])),
        "thickness": float(random.choice([1.0, 0.3])),
        "blocks": blocks,
        "supports": [
            {"name": "held", "segment": [[0.0, 0.0], [width, 0.0]], "fix": ["x", "y"]},
        ],
        "monitors": [_watched(f"b{number}", piece) for number, piece in enumerate(pieces)],
    }
    return scene, height


def with_a_falling_block(
    scene: Document, height: float, step: float, random: np.random.Generator
) -> Document:
    """Return a scene with a further block that comes down on the top within a few steps."""
    low = 1.01 * height
    corners = np.array([[0.1, 0.0], [0.5, 0.05], [0.55, 0.4], [0.15, 0.45]]) * height + [0, low]
    velocity = [0.0, float(-0.01 * height / (random.uniform(2, 6) * step))]
    return {
        **scene,
        "blocks": [*scene["blocks"], block("top", corners)],
        "monitors": [*scene["monitors"], _watched("top", shapely.Polygon(corners))],
        "initial_velocities": [{"block": "top", "velocity": velocity}],
    }


def with_a_crack(scene: Document, random: np.random.Generator) -> Document:
    """Return a scene whose first body has a crack from the middle of a side past its centre."""
    made = cracked(scene)
    if random.random() < 0.3:
        made["cracks"][0]["bonded"] = True
    return made


def flight(random: np.random.Generator) -> tuple[Document, float]:
    """Return the tables of bodies that fly at each other, and how large they are (m)."""
    return thrown(random)


def _watched(name: str, piece: shapely.Polygon) -> Document:
    inside = np.array(piece.representative_point().coords[0]).tolist()
    return {"name": f"at {name}", "point": inside, "block": name}
