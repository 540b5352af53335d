"""Whole runs that are raced: walls, the same sliding, piles, a jointed slope, an arch, two blocks.

Each is a scene and the step of its run. A few have a smaller sibling whose counted work is held by
a test.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from whole_scenes import pile, wall

import nmm
from nmm.formulation import Formulation
from nmm.scene.model import Scene

EXAMPLES = Path(__file__).parents[1] / "examples"
GRAVITY = 9.80665


@dataclass(frozen=True)
class Race:
    """A scene to its end.

    Attributes
    ----------
    scene
        Makes the scene of a run of so many steps.
    step
        Length of its steps (s); None where loads drive it.
    steps
        How many are raced.
    formulation
        What the formulation says besides.
    """

    scene: Callable[[float], Scene]
    step: float | None
    steps: int
    formulation: Mapping[str, object] = field(default_factory=dict)

    def made(self) -> tuple[Scene, Formulation]:
        """Return the scene as long as its steps, and its formulation."""
        if self.step is None:
            scene = self.scene(0.0)
            return scene, Formulation.model_validate(scene.formulation or {})
        given = {"integrator": {"step": self.step}, **self.formulation}
        formulation = Formulation.model_validate(given)
        return self.scene(self.steps * self.step), formulation


def sliding_wall(n_blocks: int, duration: float, angle: float = 35.0) -> Scene:
    """Return a wall whose weight pulls at ``angle`` (degrees) to its courses: all of it slides.

    Friction holds 31 degrees.
    """
    scene, at = wall(n_blocks, duration), np.deg2rad(angle)
    pull = [GRAVITY * float(np.sin(at)), -GRAVITY * float(np.cos(at))]
    return _with(scene, gravity={"acceleration": pull})


def two_blocks(duration: float) -> Scene:
    """Return a block that slides down another one."""
    slope = nmm.read_scene(EXAMPLES / "incline" / "slide.toml")
    return _with(slope, duration=duration)


def arch(duration: float) -> Scene:
    """Return an arch under a horizontal share of its weight that it carries, in time."""
    scene = nmm.read_scene(EXAMPLES / "arch" / "shaken.toml")
    pull = [0.2 * GRAVITY, -GRAVITY]
    given = scene.model_dump(exclude_unset=True)
    for name in ("loads", "loading", "references", "reference", "formulation"):
        given.pop(name, None)
    return Scene.model_validate(
        given | {"inertia": {}, "duration": duration, "gravity": {"acceleration": pull}}
    )


def slope(spacing: float, duration: float) -> Scene:
    """Return a rock slope cut by two joint sets ``spacing`` (m) apart; at 2.6 m 407 blocks."""
    joints = [
        {
            "name": name,
            "block": "slope",
            "dip": float(np.deg2rad(dip)),
            "spacing": spacing,
            "spacing_scatter": 0.3 * spacing / 2.6,
        }
        for name, dip in (("bedding", 35.0), ("cross", 115.0))
    ]
    outline = [[0, 0], [80, 0], [80, 40], [40, 40], [20, 10], [0, 10]]
    return Scene.model_validate(
        {
            "title": "jointed slope",
            "plane": "strain",
            "duration": duration,
            "seed": 3,
            "materials": {
                "rock": {"young_modulus": 1e10, "poisson_ratio": 0.25, "density": 2600.0}
            },
            "interfaces": {"joint": {"friction_angle": float(np.deg2rad(20.0))}},
            "blocks": [{"name": "slope", "material": "rock", "vertices": outline}],
            "joint_sets": joints,
            "supports": [
                {"name": "bottom", "segment": [[0, 0], [80, 0]], "fix": ["x", "y"]},
                {"name": "right", "segment": [[80, 0], [80, 40]], "fix": ["x"]},
                {"name": "left", "segment": [[0, 0], [0, 10]], "fix": ["x"]},
            ],
            "gravity": {},
            "inertia": {},
            "contact": {},
        }
    )


def kitoh(blocks: int) -> Scene:
    """Return the beam of Kitoh up to its failure load."""
    return nmm.read_scene(EXAMPLES / "kitoh_beam" / f"kitoh_{blocks}.toml")


def _with(scene: Scene, **changed: object) -> Scene:
    return Scene.model_validate(scene.model_dump(exclude_unset=True) | changed)


RACES = {
    "two blocks": Race(two_blocks, 1e-3, 200),
    "arch of 9": Race(arch, 1e-3, 100),
    "wall of 100": Race(lambda t: wall(100, t), 1e-3, 100),
    "wall of 1000": Race(lambda t: wall(1000, t), 1e-3, 40),
    "wall of 10000": Race(lambda t: wall(10000, t), 1e-3, 7),
    "sliding wall of 100": Race(lambda t: sliding_wall(100, t), 1e-3, 60),
    "sliding wall of 1000": Race(lambda t: sliding_wall(1000, t), 1e-3, 20),
    "pile of 100": Race(lambda t: pile(100, t), 1e-3, 60),
    "pile of 1000": Race(lambda t: pile(1000, t), 1e-3, 20),
    "slope of 407": Race(lambda t: slope(2.6, t), 5e-3, 20),
    "slope of 407, 2 ms": Race(lambda t: slope(2.6, t), 2e-3, 20),
    "slope of 4000": Race(lambda t: slope(0.8, t), 2e-3, 4),
    "Kitoh 130": Race(lambda t: kitoh(130), None, 0),
    "Kitoh 455": Race(lambda t: kitoh(455), None, 0),
}
"""All that are raced, by name."""

SMALL = {
    "two blocks": Race(two_blocks, 1e-3, 20),
    "arch of 9": Race(arch, 1e-3, 10),
    "wall of 25": Race(lambda t: wall(25, t), 1e-3, 20),
    "sliding wall of 25": Race(lambda t: sliding_wall(25, t), 1e-3, 20),
    "pile of 25": Race(lambda t: pile(25, t), 1e-3, 20),
    "slope of 40": Race(lambda t: slope(9.0, t), 5e-3, 8),
}
"""Those whose counted work a test holds: together a second or two."""
