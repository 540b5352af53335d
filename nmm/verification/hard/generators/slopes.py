"""Slopes of two and three joint sets that slide, from 40 to 400 blocks."""

from collections.abc import Iterator

import numpy as np

from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import over_parts
from nmm.verification.hard.cases.writing import block, in_time, rock
from nmm.verification.hard.oracles.motion import moving

FRICTIONS = (15.0, 0.0, 30.0, 5.0, 45.0)
STEPS = (5e-4, 5e-3, 2e-4, 1e-3, 1e-4)
SIZES = (40, 40, 80, 40, 150, 40, 400)


class Slopes(HardClass):
    """Rock slopes cut by joint sets, let go under their weight."""

    name = "slopes"
    title = "slopes of two and three joint sets, 40 to 400 blocks, friction 0 to 45 degrees"
    oracle = "energy never rises, nobody through anybody, area kept"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield a slope of two sets and one of three."""
        for sets in (2, 3):
            random = np.random.default_rng([seed, sets, 31])
            count = SIZES[(seed + sets) % len(SIZES)]
            friction, step = FRICTIONS[(seed + sets) % 5], STEPS[(seed * 2 + sets) % 5]
            steps = int(np.clip(round(0.02 / step), 20, 60 if count < 100 else 20))
            heavy = 9.81 if step > 7e-4 else 98.1  # so that corners pass in fewer short steps
            scene = in_time(slope(sets, count, friction, seed, random), step, steps, heavy)
            words = f"{sets} sets, about {count} blocks, seed {seed}, {friction:g} deg"
            kinds = {
                **{"joint sets": f"{sets} sets", "blocks": f"{count} blocks"},
                **{"friction": f"{friction:g} deg", "step": f"{step:g} s"},
            }
            yield from over_parts(words, scene, step, moving, slow=True, kinds=kinds)


def slope(
    sets: int, count: int, friction: float, seed: int, random: np.random.Generator
) -> Document:
    """Tables of a slope of about ``count`` blocks on a held base."""
    outline = np.array([[0, 2], [30, 2], [30, 20], [16, 20], [8, 6], [0, 6]], dtype=float)
    area = 30 * 4 + 14 * 14 + 8 * 14 / 2
    spacing = float(np.sqrt(area / count) * (1.0 if sets == 2 else 1.35))
    first = random.uniform(20, 45)
    dips = [first, first + random.uniform(60, 100), first + random.uniform(115, 150)][:sets]
    return {
        **rock(modulus=10e9, friction=friction),
        "seed": seed,
        "blocks": [
            block("slope", outline),
            block("base", [[-10, 0], [34, 0], [34, 2], [-10, 2]]),
            block("back", [[30, 2], [34, 2], [34, 20], [30, 20]]),
        ],
        "joint_sets": [
            {
                "name": f"set{number}",
                "block": "slope",
                "dip": float(np.deg2rad(dip)),
                "dip_scatter": float(np.deg2rad(random.choice([0.0, 2.0]))),
                "spacing": spacing,
                "spacing_scatter": 0.15 * spacing,
                "seed": int(seed * 10 + number),
            }
            for number, dip in enumerate(dips)
        ],
        "supports": [
            {"name": f"hold {name}", "block": name, "fix": ["x", "y"]} for name in ("base", "back")
        ],
    }
