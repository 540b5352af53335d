"""Bodies that differ by millions: mass, stiffness, size, slenderness, edges hardly parallel."""

from collections.abc import Iterator

import numpy as np

from nmm.verification.base import Check, Checks
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import enforcements, with_parts
from nmm.verification.hard.cases.transforms import turned
from nmm.verification.hard.cases.writing import block, rock, supported
from nmm.verification.hard.oracles.motion import ended, ran
from nmm.verification.text import rectangle

KINDS = ("mass", "stiffness", "size", "strip", "tilt")


class Ratios(HardClass):
    """A block at rest on another on a held floor, one of them out of all proportion."""

    name = "ratios"
    title = "mass ratio 1e6, stiffness 1e9, size 1e4, strips of 1e4 to 1, tilts of 1e-14 to 1e-4"
    oracle = "the floor carries both weights, the lower block the upper one's; nothing sinks in"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield each ratio, upright or upside down, with every enforcement."""
        random = np.random.default_rng([seed, 83])
        for kind in KINDS:
            upper = bool(random.integers(2))
            scene = stacked(kind, upper, random)
            for name in enforcements():
                made = with_parts(scene, {"contact.enforcement": name})
                label = f"{kind} of the {'upper' if upper else 'lower'}, seed {seed}, {name}"
                yield HardCase(label, made, _carried, {"enforcement": name})


def stacked(kind: str, upper: bool, random: np.random.Generator) -> Document:
    """Tables of two blocks on a floor; the ``upper`` one or the lower differs in ``kind``."""
    scene = rock(friction=30.0)
    scene["materials"]["odd"] = dict(scene["materials"]["rock"])
    widths, heights = [1.0, 1.0], [0.6, 0.6]
    odd = int(upper)
    if kind == "mass":
        scene["materials"]["odd"]["density"] *= float(10.0 ** random.uniform(3, 6))
    elif kind == "stiffness":
        scene["materials"]["odd"]["young_modulus"] *= float(10.0 ** random.uniform(3, 9))
    elif kind == "size":
        odd, shrunk = 1, float(10.0 ** -random.uniform(2, 4))
        widths[1], heights[1] = shrunk, shrunk
    elif kind == "strip":
        heights[odd] = float(10.0 ** -random.uniform(2, 4))
    tilt = float(10.0 ** -random.uniform(4, 14)) if kind == "tilt" else 0.0
    low = rectangle((-widths[0] / 2, 0), (widths[0] / 2, heights[0]))
    high = rectangle((-widths[1] / 2, heights[0]), (widths[1] / 2, heights[0] + heights[1]))
    if kind == "tilt":
        high = high + np.array([[0, 0], [0, tilt], [0, tilt], [0, 0]])
    names = ["odd" if number == odd and kind != "size" else "rock" for number in range(2)]
    scene |= {
        "blocks": [
            block("floor", rectangle((-2, -1), (2, 0))),
            block("low", low, names[0]),
            block("high", high, names[1]),
        ],
        "supports": supported("floor"),
        "gravity": {"acceleration": [0.0, -9.81]},
        "monitors": [{"name": "top", "point": high[3].tolist(), "block": "high"}],
    }
    return turned(scene, float(random.choice([0.0, 0.0, 0.7, -2.0])))


def _carried(scene: Document) -> Checks:
    """Compare contact forces with weights."""
    found = ran(scene)
    checks = ended(found)
    if not found.run.summary.steps:
        return checks
    frame, areas = found.run.frames[-1], found.run.manifold.elements.areas
    weights = [
        9.81 * float(areas[number]) * scene["materials"][table["material"]]["density"]
        for number, table in enumerate(scene["blocks"])
    ]
    down = np.array(scene["gravity"]["acceleration"]) / 9.81
    height = frame.contact_position @ -down
    along = np.abs(frame.contact_normal @ down) > 0.9
    middle = float(np.mean([np.array(p) @ -down for p in scene["blocks"][1]["vertices"]]))
    under = -float(frame.contact_force[along & (height < middle), 0].sum())
    between = -float(frame.contact_force[along & (height > middle), 0].sum())
    reason = "weights; residual of the step"
    return checks | {
        "force on the floor": Check(under, weights[1] + weights[2], 1e-4, reason),
        "force between": Check(between, weights[2], 1e-3, reason),
    }
