"""Scenes of squares and other outlines of one material, blocks named b0, b1 and so on."""

from typing import Any

from nmm.scene import Scene, build_scene

ROCK = {"young_modulus": 1e9, "poisson_ratio": 0.2}
SQUARE = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]


def square_at(x: float, y: float, size: float = 1.0) -> list[list[float]]:
    """Return the corners of a square whose lowest left one is given (m)."""
    return [[x + size * a, y + size * b] for a, b in SQUARE]


def scene_of(*outlines: Any, **tables: Any) -> Scene:
    """Return a scene in plane strain of blocks with outlines (n, 2), and other tables."""
    blocks = [{"name": f"b{k}", "material": "rock", "vertices": v} for k, v in enumerate(outlines)]
    return build_scene(
        {"plane": "strain", "materials": {"rock": ROCK}, "blocks": blocks, **tables}, "s.toml"
    )
