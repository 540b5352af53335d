"""Corners that pass one another: three to eight blocks about a crossing of joints."""

from collections.abc import Iterator
from itertools import product

import numpy as np
import shapely

from integration.arrays import Floats
from integration.plane_vectors import counterclockwise
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import over_parts
from nmm.verification.hard.cases.writing import block, in_time, rock, supported
from nmm.verification.hard.oracles.motion import flying, moving

COUNTS = (3, 4, 5, 8)
STEPS = (5e-3, 1e-3, 2e-4, 1e-4)
GAPS = (0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3)
NARROWEST = 0.15


def sectors(count: int, random: np.random.Generator, size: float = 4.0) -> list[Floats]:
    """Blocks of a square of side ``size``, cut by ``count`` rays from a point within.

    No sector is narrower than ``NARROWEST`` rad nor as wide as half a turn.
    """
    centre = random.uniform(0.35, 0.65, 2) * size
    while True:  # angles are drawn until they suit
        angles = np.sort(random.uniform(0, 2 * np.pi, count))
        between = np.diff([*angles, angles[0] + 2 * np.pi])
        if between.min() > NARROWEST and between.max() < 0.9 * np.pi:
            break
    rays = centre + 10 * size * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    whole = shapely.box(0, 0, size, size)
    following = np.roll(rays, -1, axis=0)
    parts = [
        whole.intersection(shapely.Polygon([centre, first, second]))
        for first, second in zip(rays, following, strict=True)
    ]
    # The crossing itself is the same point to the last digit in all of them.
    return [_with_point(np.asarray(shapely.get_coordinates(part)[:-1]), centre) for part in parts]


def apart(blocks: list[Floats], gap: float, random: np.random.Generator) -> list[Floats]:
    """Return blocks drawn away from their common middle by ``gap`` of it and turned as far."""
    if gap == 0.0:
        return blocks
    middle = np.concatenate(blocks).mean(axis=0)
    moved = []
    for points in blocks:
        centre = points.mean(axis=0)
        away = (centre - middle) / np.linalg.norm(centre - middle)
        turn = random.uniform(-0.1, 0.1) * gap
        arm = points - centre
        quarter = counterclockwise(arm)
        cosine, sine = np.cos(turn), np.sin(turn)
        moved.append(centre + 2.0 * gap * away + cosine * arm + sine * quarter)
    return moved


class CrossingCases(HardClass):
    """Blocks about a crossing, let go on a floor or thrown at each other."""

    name = "crossings"
    title = "three to eight blocks about a crossing of joints, closed or open by 1e-12 to 1e-3"
    oracle = "energy never rises, nobody through anybody, area and momentum kept"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield falls on a floor and blocks that fly together."""
        for (index, count), kind in product(enumerate(COUNTS), ("fall", "fly")):
            random = np.random.default_rng([seed, count, kind == "fly"])
            gap, step = GAPS[(seed + index) % len(GAPS)], STEPS[(seed + index) % len(STEPS)]
            friction = float(random.choice([0.0, 0.0, 15.0, 30.0, 45.0]))
            blocks = apart(sectors(count, random), gap * 4.0, random)
            if kind == "fall":
                scene = fall(blocks, friction, step)
            else:
                scene = fly(blocks, friction, step, random)
            words = f"{kind}, {count} blocks, seed {seed}, gap {gap:g}, {friction:g} deg"
            yield from over_parts(words, scene, step, moving if kind == "fall" else flying)


def fall(blocks: list[Floats], friction: float, step: float) -> Document:
    """Blocks on a wide held floor under their weight."""
    tables = [block(f"b{number}", points) for number, points in enumerate(blocks)]
    low = min(points[:, 1].min() for points in blocks)
    floor = block("floor", [[-20, low - 2], [24, low - 2], [24, low], [-20, low]])
    scene = {**rock(friction=friction), "blocks": [*tables, floor], "supports": supported("floor")}
    return in_time(scene, step, steps_of(step))


def fly(
    blocks: list[Floats], friction: float, step: float, random: np.random.Generator
) -> Document:
    """Blocks thrown at their common middle with a slight spin, nothing else acting."""
    tables = [block(f"b{number}", points) for number, points in enumerate(blocks)]
    middle = np.concatenate(blocks).mean(axis=0)
    speeds = []
    for number, points in enumerate(blocks):
        inward = middle - points.mean(axis=0)
        velocity = 0.5 * inward / np.linalg.norm(inward) + random.normal(0, 0.1, 2)
        spin = float(random.normal(0, 0.05))
        speeds.append(
            {"block": f"b{number}", "velocity": velocity.tolist(), "angular_velocity": spin}
        )
    scene = {**rock(friction=friction), "blocks": tables, "initial_velocities": speeds}
    return in_time(scene, step, steps_of(step), None)


def steps_of(step: float) -> int:
    """Steps enough for blocks to pass by centimetres, and not more than a hundred and fifty."""
    return int(np.clip(round(0.2 / step), 40, 150))


def _with_point(points: Floats, centre: Floats) -> Floats:
    off = np.linalg.norm(points - centre, axis=1)
    points[off < 1e-9] = centre
    return points
