"""Flush floors and walls made of several blocks, and a block that slides over their seams."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from nmm.verification.base import Check, Checks
from nmm.verification.hard.cases.base import Document, HardCase, HardClass, Judge
from nmm.verification.hard.cases.parts import over_parts
from nmm.verification.hard.cases.writing import block, in_time, rock
from nmm.verification.hard.generators.crossings import STEPS
from nmm.verification.hard.oracles.motion import Ran, body_checks, ended, energy_checks, ran
from nmm.verification.text import rectangle, turned

SPEED, WEIGHT = 2.0, 9.81
FRICTIONS = (0.0, 20.0, 0.0, 40.0)


class SeamCases(HardClass):
    """A block that slides over a floor of flush blocks, or up a wall of them."""

    name = "seams"
    title = "a block slides over the seams of flush floors and walls, turned by any angle"
    oracle = "v t - mu g t^2 / 2 along the floor, nothing across it, energy never rises"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield two floors."""
        for index in range(2):
            random = np.random.default_rng([seed, index, 11])
            friction = FRICTIONS[(seed + index) % len(FRICTIONS)]
            step = STEPS[(seed + 2 * index + 1) % len(STEPS)]
            angle = float(random.uniform(-np.pi, np.pi)) if index else 0.0
            steps = int(np.clip(round(0.3 / step), 40, 200))
            scene, judge = _slide(friction, angle, step, steps, random)
            words = f"seed {seed}, {friction:g} deg, turned by {angle:.3g}"
            yield from over_parts(words, scene, step, judge)


def _slide(
    friction: float, angle: float, step: float, steps: int, random: np.random.Generator
) -> tuple[Document, Judge]:
    """Scene of a sliding block, and what is right of it."""
    ends = np.cumsum([-1.2, *random.uniform(0.15, 0.7, 6)])
    floors = [
        block(f"floor{number}", turned(rectangle((low, -1.0), (high, 0.0)), angle))
        for number, (low, high) in enumerate(pairwise(ends))
    ]
    names = [table["name"] for table in floors]
    slider = turned(rectangle((-1.0, 0.0), (-0.4, 0.3)), angle)
    along = turned(np.array([1.0, 0.0]), angle)
    down = turned(np.array([0.0, -WEIGHT]), angle)
    scene = in_time(
        {
            **rock(friction=friction),
            "blocks": [*floors, block("slider", slider)],
            "supports": [
                {"name": f"hold {name}", "block": name, "fix": ["x", "y"]} for name in names
            ],
            "initial_velocities": [{"block": "slider", "velocity": (SPEED * along).tolist()}],
            "monitors": [
                {"name": "middle", "point": slider.mean(axis=0).tolist(), "block": "slider"}
            ],
        },
        step,
        steps,
    )
    scene["gravity"] = {"acceleration": down.tolist()}
    scale = float(np.tan(np.deg2rad(friction)) * WEIGHT)

    def judge(made: Document) -> Checks:
        found = ran(made)
        return ended(found) | energy_checks(found) | body_checks(found) | _way(found, angle, scale)

    return scene, judge


def _way(found: Ran, angle: float, brake: float) -> Checks:
    """Ways of the slider along and across the floor against the closed form."""
    h = found.run.history
    moved = np.stack([h["monitor:middle:ux"], h["monitor:middle:uy"]], axis=1)
    along, across = turned(moved, -angle).T
    time = h["time"]
    if brake:
        time = np.minimum(time, SPEED / brake)
    right = SPEED * time - brake * time**2 / 2
    wanted = "closed form; contact starts without load, within a few steps"
    return {
        "way along": Check(float(np.abs(along - right).max()), 0.0, 1e-2, wanted, float(right[-1])),
        "way across": Check(float(np.abs(across).max()), 0.0, 1e-5, "own settlement is 1e-7", 1.0),
    }
