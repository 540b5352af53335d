"""The blocks of a race as rigid bodies of a game engine, where one is installed (pymunk).

Such an engine lets blocks overlap and drift a little and knows no deformation: what it leaves
stands beside its seconds. Polygons, friction, gravity and step are those of the race.
"""

from typing import Any

import numpy as np

from nmm.stepping.simulation import Simulation

ITERATIONS = 50
"""Of the engine's solver, a step."""


class Pymunk:
    """One run of pymunk, ready for its first step."""

    def __init__(self, made: Simulation, step: float, steps: int) -> None:
        import pymunk

        scene, model = made.scene, made.stepper.model
        assert scene.gravity is not None
        self.space: Any = pymunk.Space()
        self.space.iterations = ITERATIONS
        self.space.gravity = tuple(scene.gravity.acceleration)
        self.step, self.steps = step, steps
        manifold = model.manifold
        held = {support.block for support in scene.supports}
        friction = next(iter(scene.interfaces.values())).friction_angle
        rock = next(iter(scene.materials.values()))
        self.shapes = []
        rings = [np.array(p.exterior.coords)[:-1] for p in manifold.elements.to_shapely()]
        for name, ring in zip(made.regions.name, rings, strict=True):
            still = name in held
            centre = ring.mean(axis=0)
            kind = pymunk.Body.STATIC if still else pymunk.Body.DYNAMIC
            body = pymunk.Body(body_type=kind)
            body.position = tuple(centre)
            shape = pymunk.Poly(body, [tuple(p) for p in ring - centre])
            shape.density = float(rock.density)
            # the engine multiplies the coefficients of both
            shape.friction = float(np.sqrt(np.tan(friction)))
            self.space.add(body, shape)
            self.shapes.append(shape)

    def run(self) -> None:
        """Take all steps."""
        for _ in range(self.steps):
            self.space.step(self.step)

    def rings(self) -> list[np.ndarray]:
        """Return the corners (k, 2) of each block where it is."""
        return [
            np.array([p.rotated(s.body.angle) + s.body.position for p in s.get_vertices()])
            for s in self.shapes
        ]
