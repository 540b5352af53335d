"""Seeds of the random parts of a scene."""

from __future__ import annotations

from nmm.scene.model import Scene
from nmm.scene.solids import JointSet, Tessellation


def seed_of(item: Tessellation | JointSet, scene: Scene, index: int) -> int | tuple[int, ...]:
    """A part's own seed, else the scene's, made different for each part after the first."""
    if item.seed is not None:
        return item.seed
    return (scene.seed, index) if index else scene.seed
