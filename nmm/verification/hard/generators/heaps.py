"""Piles, walls and arches that settle, fall and slide."""

from collections.abc import Iterator

import numpy as np

from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import over_parts
from nmm.verification.hard.cases.writing import block, in_time, rock, supported
from nmm.verification.hard.oracles.motion import moving
from nmm.verification.text import rectangle

FRICTIONS = (30.0, 0.0, 15.0, 45.0)
STEPS = (1e-3, 2e-4, 5e-3, 1e-4)


class Heaps(HardClass):
    """A pile of Voronoi blocks, a brick wall and an arch, each let go."""

    name = "heaps"
    title = "piles of Voronoi blocks, brick walls and arches that settle, fall and slide"
    oracle = "energy never rises, nobody through anybody, area kept"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield one of each."""
        for number, (kind, make) in enumerate(KINDS.items()):
            random = np.random.default_rng([seed, number, 41])
            friction = FRICTIONS[(seed + number) % len(FRICTIONS)]
            step = STEPS[(seed + number) % len(STEPS)]
            scene = {**rock(friction=friction), **make(random, seed)}
            made = in_time(scene, step, int(np.clip(round(0.05 / step), 25, 60)))
            words = f"{kind}, seed {seed}, {friction:g} deg"
            yield from over_parts(words, made, step, moving, slow=True)


def pile(random: np.random.Generator, seed: int) -> Document:
    """Tables of a column of 25 to 60 Voronoi blocks that nothing holds at its sides."""
    width, height = random.uniform(2, 4), random.uniform(2, 4)
    return {
        "tessellations": [
            {
                "name": "pile",
                "material": "rock",
                "region": rectangle((0, 0), (width, height)).tolist(),
                "blocks": int(random.integers(25, 60)),
                "seed": seed,
            }
        ],
        "blocks": [block("floor", [[-10, -1], [14, -1], [14, 0], [-10, 0]])],
        "supports": supported("floor"),
    }


def wall(random: np.random.Generator, seed: int) -> Document:
    """Tables of a wall of bricks in running bond whose floor sinks away under its right half."""
    tables = []
    rows, long, high = 6, 1.0, 0.5
    for row in range(rows):
        shift = -0.5 * long * (row % 2)
        for column in range(6):
            low = (column * long + shift, row * high)
            tables.append(block(f"b{row}_{column}", rectangle(low, (low[0] + long, low[1] + high))))
    edge = float(random.uniform(2.0, 5.0))
    floor = block("floor", rectangle((-4, -1), (edge, 0)))
    deep = block("deep", rectangle((edge, -3), (12, -2)))
    return {"blocks": [*tables, floor, deep], "supports": supported("floor", "deep")}


def arch(random: np.random.Generator, seed: int) -> Document:
    """Tables of a semicircular arch of voussoirs on a floor, thinner or thicker than it needs."""
    count = int(random.integers(7, 20))
    thick = float(random.uniform(0.08, 0.25))
    angles = np.linspace(0, np.pi, count + 1)
    inner = np.stack([np.cos(angles), np.sin(angles)], axis=1) * (2.0 - thick)
    outer = np.stack([np.cos(angles), np.sin(angles)], axis=1) * (2.0 + thick)
    inner[[0, -1], 1] = outer[[0, -1], 1] = 0.0
    tables = [
        block(f"v{i}", [inner[i], outer[i], outer[i + 1], inner[i + 1]]) for i in range(count)
    ]
    floor = block("floor", [[-6, -1], [6, -1], [6, 0], [-6, 0]])
    return {"blocks": [*tables, floor], "supports": supported("floor")}


KINDS = {"pile": pile, "wall": wall, "arch": arch}
