"""Corner on corner, and edges that open from nothing."""

from collections.abc import Iterator

import numpy as np

from integration.arrays import Floats
from nmm.verification.hard.cases.base import HardCase, HardClass
from nmm.verification.hard.cases.parts import over_parts
from nmm.verification.hard.cases.writing import block, in_time, rock, supported
from nmm.verification.hard.generators.crossings import GAPS, STEPS, steps_of
from nmm.verification.hard.oracles.motion import flying, moving
from nmm.verification.text import turned

ASIDE = (0.0, 1e-12, -1e-9, 1e-6, -1e-4, 5e-5, 1e-3)
OPENINGS = (1e-3, 1e-2, 1e-4, 5e-2, 1e-6, 0.2)
LEAF = 0.25


def tip(angle: float, length: float = 1.0) -> Floats:
    """Kite with its sharp corner of ``angle`` at the origin, standing on it."""
    side = length * np.array([np.sin(angle / 2), np.cos(angle / 2)])
    return np.array([[0, 0], side, [0, 1.6 * length], [-side[0], side[1]]])


class Corners(HardClass):
    """Two bodies thrown at each other corner first."""

    name = "corners"
    title = "corner on corner, off by 0 and 1e-12 to 1e-3 of a block, angles of 20 to 150 degrees"
    oracle = "energy never rises, nobody through anybody, area and momentum kept"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield three pairs of corners."""
        for index in range(3):
            random = np.random.default_rng([seed, index])
            angles = np.deg2rad(random.uniform(20, 150, 2))
            aside, step = ASIDE[(3 * seed + index) % len(ASIDE)], STEPS[(seed + index) % len(STEPS)]
            lower = turned(tip(float(angles[0])), np.pi + float(random.normal(0, 0.1)))
            gap = max(2e-3, 0.2 * step)
            upper = turned(tip(float(angles[1])), float(random.normal(0, 0.1)))
            scene = {
                **rock(modulus=5e9, friction=float(random.choice([0.0, 30.0]))),
                "blocks": [block("low", lower), block("high", upper + np.array([aside, gap]))],
                "initial_velocities": [
                    {
                        "block": "high",
                        "velocity": [float(random.normal(0, 0.1)), -1.0],
                        "angular_velocity": float(random.normal(0, 0.2)),
                    }
                ],
            }
            steps = int(np.clip(round(0.02 / step), 20, 200))
            words = f"seed {seed}.{index}, off by {aside:g}"
            yield from over_parts(words, in_time(scene, step, steps, None), step, flying)


class Fans(HardClass):
    """Leaves that share an edge and open about one of its ends."""

    name = "fans"
    title = "edges that touch at one end and open by 1e-6 to 0.2 rad, and gaps of 0 to 1e-3"
    oracle = "energy never rises, nobody through anybody, area kept"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield two fans of leaning leaves and two stacks with gaps."""
        for index in range(2):
            random = np.random.default_rng([seed, index, 7])
            friction = float(random.choice([0.0, 15.0, 35.0]))
            step = STEPS[(seed + index + 1) % len(STEPS)]
            opening = OPENINGS[(seed + 3 * index) % len(OPENINGS)]
            leaves = [
                block(f"leaf{number}", turned(_leaf(), -(LEAF + opening) * number - opening))
                for number in range(3)
            ]
            floor = block("floor", [[-4, -1], [4, -1], [4, 0], [-4, 0]])
            wall = block("wall", [[-2, 0], [0, 0], [0, 3], [-2, 3]])
            scene = {
                **rock(friction=friction),
                "blocks": [floor, wall, *leaves],
                "supports": supported("floor", "wall"),
            }
            made = in_time(scene, step, steps_of(step))
            if seed % 2 == 0:  # the book closes against the wall; otherwise it falls open
                made["gravity"] = {"acceleration": [-8.0, -5.0]}
            words = f"leaves, seed {seed}, opening {opening:g}, {friction:g} deg"
            yield from over_parts(words, made, step, moving)
            gap = GAPS[(seed + index) % len(GAPS)]
            yield from over_parts(
                f"stack, seed {seed}, gap {gap:g}, {friction:g} deg",
                in_time(_stack(gap, friction, random), step, steps_of(step)),
                step,
                moving,
            )


def _leaf() -> Floats:
    """A sector of ``LEAF`` rad on its point, one face upright: turned leaves share the point."""
    far = 2.0 * np.array([np.sin(LEAF), np.cos(LEAF)])
    return np.array([[0.0, 0.0], far, [0.0, 2.0]])


def _stack(gap: float, friction: float, random: np.random.Generator) -> dict[str, object]:
    low, tables = 0.0, []
    for number in range(4):
        low += gap
        width, height = random.uniform(0.6, 1.4), random.uniform(0.3, 1.0)
        left = random.uniform(-0.15, 0.15) - width / 2
        points = [[left, low], [left + width, low], [left + width, low + height]]
        tables.append(block(f"b{number}", [*points, [left, low + height]]))
        low += height
    floor = block("floor", [[-4, -1], [4, -1], [4, 0], [-4, 0]])
    scene = rock(friction=friction)
    return {**scene, "blocks": [floor, *tables], "supports": supported("floor")}
