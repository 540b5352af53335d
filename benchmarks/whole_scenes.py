"""Scenes of many blocks for whole runs: a wall of bricks, and a pile of Voronoi cells in a box."""

from itertools import pairwise

import numpy as np
import shapely
from shapely.affinity import scale

from integration.polygons import Polygons
from nmm.geometry.tessellation.voronoi import tessellate
from nmm.scene.model import Scene

FRICTION = 0.6
BOX = ("floor", "left", "right")
"""Blocks that hold a pile."""
THICK = 1.0
"""Thickness of the box (m)."""


def wall(n_blocks: int, duration: float) -> Scene:
    """Running bond on a held base: bricks 0.5 m x 0.25 m, half bricks at alternate ends."""
    courses = max(2, round(np.sqrt(n_blocks)))
    width = max(2, round(n_blocks / courses))
    bricks = []
    for course in range(courses):
        cuts = np.arange(width + 1) * 0.5
        if course % 2:
            cuts = np.r_[0, 0.25 + np.arange(width) * 0.5, 0.5 * width]
        low, high = 0.25 * course, 0.25 * (course + 1)
        bricks += [_box(left, low, right, high) for left, right in pairwise(cuts.tolist())]
    base = {"base": _box(-0.5, -0.25, 0.5 * width + 0.5, 0.0)}
    return _scene("wall", duration, base, {"blocks": [_block(ring) for ring in bricks]})


def pile(
    n_blocks: int, duration: float, *, height: float = 0.0, gap: float = 0.0, seed: int = 1
) -> Scene:
    """Voronoi cells, 1 m2 each in the mean, between a floor and two walls, open above.

    Parameters
    ----------
    n_blocks
        Number of cells.
    duration
        s.
    height
        Depth of the pile (m); 0: as deep as it is wide.
    gap
        By what share of its size each cell is shrunk; at 0 cells touch along whole edges.
    seed
        Of the tessellation.
    """
    height = height or float(np.sqrt(n_blocks))
    width = n_blocks / height
    around = (
        _box(-THICK, -THICK, width + THICK, 0.0),
        _box(-THICK, 0.0, 0.0, 1.2 * height),
        _box(width, 0.0, width + THICK, 1.2 * height),
    )
    box, region = dict(zip(BOX, around, strict=True)), _box(0.0, 0.0, width, height)
    if gap:
        whole = Polygons.from_shapely([shapely.Polygon(region)])
        cells = tessellate(whole, n_blocks, seed=seed).to_shapely()
        rings = [scale(c, 1 - gap, 1 - gap, origin=c.centroid).exterior.coords for c in cells]
        solids = {"blocks": [_block([list(at) for at in ring[:-1]]) for ring in rings]}
    else:
        cells = {"name": "cell", "material": "rock", "region": region, "seed": seed}
        solids = {"tessellations": [cells | {"blocks": n_blocks}]}
    return _scene("pile", duration, box, solids)


SCENES = {"wall": wall, "pile": pile}


def _scene(title: str, duration: float, held: dict[str, list], solids: dict[str, list]) -> Scene:
    """Gravity, inertia and contact; the named blocks are held."""
    blocks = [_block(ring, name=name) for name, ring in held.items()]
    return Scene.model_validate(
        {
            "title": title,
            "plane": "strain",
            "duration": duration,
            "materials": {"rock": {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 2000.0}},
            "interfaces": {"dry": {"friction_angle": float(np.arctan(FRICTION))}},
            "supports": [{"name": name, "block": name, "fix": ["x", "y"]} for name in held],
            "gravity": {},
            "inertia": {},
            "contact": {},
            **solids,
            "blocks": blocks + solids.get("blocks", []),
        }
    )


def _block(ring: list, **more: str) -> dict:
    return {"material": "rock", "vertices": ring, **more}


def _box(left: float, low: float, right: float, high: float) -> list[list[float]]:
    return [[left, low], [right, low], [right, high], [left, high]]
