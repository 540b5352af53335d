"""Joints that reach their strength in the same instant."""

from collections.abc import Iterator

import numpy as np

from nmm.verification.base import Check, Checks, holds
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import enforcements, with_parts
from nmm.verification.hard.cases.transforms import listed_anew
from nmm.verification.hard.cases.writing import block, rock, supported
from nmm.verification.hard.oracles.motion import ended, ran
from nmm.verification.text import rectangle

STRENGTH = 2e6


class Events(HardClass):
    """Equal blocks on a held base, pulled off it by equal loads until their bonds fail."""

    name = "events"
    title = "two to seven equal bonds that fail in the same instant, or differ by 1e-15 to 1e-6"
    oracle = "failure at the strength of the weakest, whatever the increment, order and numbers"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield one row of blocks with every enforcement."""
        random = np.random.default_rng([seed, 89])
        count = int(random.integers(2, 8))
        apart = float(random.choice([0.0, 1e-15, 1e-12, 1e-6]))
        increment = float(random.choice([0.1, 0.03, 0.37]))
        scene = _row(count, apart, increment)
        for name in enforcements():
            made = with_parts(scene, {"contact.enforcement": name})
            label = f"{count} bonds apart by {apart:g}, increments of {increment:g}, seed {seed}"
            yield HardCase(f"{label}, {name}", made, _failed, {"enforcement": name})


def _row(count: int, apart: float, increment: float) -> Document:
    scene = rock(friction=30.0)
    scene["interfaces"]["contact"] |= {
        "bonded": True,
        "cohesion": 10 * STRENGTH,
        "tensile_strength": STRENGTH,
    }
    tables, loads = [block("base", rectangle((-1, -1), (2.0 * count, 0)))], []
    for number in range(count):
        low = 2.0 * number
        tables.append(block(f"b{number}", rectangle((low, 0), (low + 1, 1))))
        pull = STRENGTH * (1.0 - apart * number)
        loads.append(
            {
                "name": f"pull {number}",
                "kind": "edge",
                "segment": [[low, 1], [low + 1, 1]],
                "traction": [0.0, pull],
            }
        )
    return scene | {
        "blocks": tables,
        "supports": supported("base"),
        "loads": loads,
        "loading": {"until": "failure", "maximum_factor": 3.0},
        "formulation": {"loading": {"increment": increment, "tolerance": 1e-4}},
    }


def _failed(scene: Document) -> Checks:
    found, other = ran(scene).run, ran(listed_anew(scene, 1)).run
    factor, again = found.summary.failure_factor, other.summary.failure_factor
    if factor is None or again is None:
        return ended(ran(scene))
    allowed = scene["formulation"]["loading"]["tolerance"]
    return {
        "failure factor": Check(factor, 1.0, 1.1 * allowed, "strength over load; as asked for"),
        "after other numbers": Check(again, factor, 1e-9, "no number counts"),
        "told as failure": holds(found.summary.status != "failed", found.summary.sentence),
    }
