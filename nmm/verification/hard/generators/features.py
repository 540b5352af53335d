"""Small scenes of single features, each of which has one answer wherever it is seen from."""

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial

from nmm.verification.hard.cases.base import HardCase, HardClass
from nmm.verification.hard.generators.scenes.feature_texts import (
    bars,
    blocks,
    joints,
    matter,
    motion,
)
from nmm.verification.hard.oracles.images import seen_alike


@dataclass(frozen=True)
class Feature:
    """A scene and how it may be seen.

    Attributes
    ----------
    name, text
        What it is of, and its file.
    ways
        Names of images: nets lie otherwise when they are turned a little.
    allowed
        Differences that are known, by image.
    """

    name: str
    text: str
    ways: tuple[str, ...]
    allowed: Mapping[str, float] = field(default_factory=dict)


UNITS = ("mm, N, s", "powers of two", "order", "shift")
ANY = (*UNITS, "shift up", "mirror", "turn by 37 deg")
NET = (*UNITS, "shift up", "turn by 180 deg")
LEVEL = (*UNITS, "shift up")
FREE = (*UNITS, "shift up", "turn by 37 deg")


def _features() -> Iterator[Feature]:
    """Yield one scene of each."""
    top = [[0, 1], [1, 1]]
    see, seen = blocks.monitor("o", [1, 1], "b"), blocks.monitor("o", [0.9, 1.9], "c")
    bent = blocks.rock(blocks.SOFT) + blocks.FLOOR + blocks.pulled_edge(top, [2e8, 1e8]) + see
    yield Feature("finite strain", bent + motion.FINITE, FREE)
    flying = (
        "duration = 0.04\n"
        + blocks.rock(blocks.SOFT)
        + blocks.box("c", 0, 0, 1, 2)
        + motion.FLIGHT
        + blocks.INERTIA
    )
    yield Feature("finite strain in flight", flying + seen + motion.CONSERVING, FREE)
    meeting = (
        "duration = 0.04\n"
        + blocks.rock(blocks.SOFT)
        + blocks.FLOOR
        + blocks.box("c", 0.2, 1.05, 0.9, 1.8)
    )
    meeting += (
        motion.FLIGHT
        + joints.DRY
        + blocks.INERTIA
        + blocks.monitor("o", [0.5, 1.5], "c")
        + motion.CONSERVING
    )
    yield Feature("finite strain and contact", meeting, FREE)
    yield Feature("opening", joints.CONTROLLED + joints.OPENED, ANY)
    yield Feature("displacement", joints.CONTROLLED + joints.MOVED, ANY)
    yield Feature(
        "dissipation",
        joints.CONTROLLED.replace(joints.STIFF, "") + joints.BONDS + joints.DISSIPATED,
        ANY,
    )
    brittle = joints.CONTROLLED.replace("linear_softening", "mohr_coulomb")
    yield Feature("events", brittle.replace("fracture_energy = 1e4\n", "") + joints.EVENTS, ANY)
    bolted = (
        blocks.rock()
        + blocks.TWO
        + joints.DRY
        + blocks.pulled_edge([[0, 2], [1, 2]], [4e4, 3e4])
        + seen
    )
    yield Feature("bars with slip", bolted + bars.BOLT.format(bond=bars.BOND), ANY, {"order": 1e-5})
    yield Feature("bars without bond", bolted + bars.BOLT.format(bond=""), ANY, {"order": 1e-5})
    members = (
        motion.MOVING
        + blocks.rock()
        + blocks.TWO.replace(blocks.HELD_BELOW, "")
        + joints.DRY
        + blocks.INERTIA
        + blocks.WEIGHT
        + seen
    )
    yield Feature("members in time", members + bars.MEMBERS + motion.NEWMARK, ANY, {"order": 1e-5})
    yield Feature(
        "factor of safety",
        blocks.rock()
        + blocks.SLOPE
        + joints.DRY.replace("0.4", "0.7")
        + blocks.WEIGHT
        + joints.FACTOR,
        ANY,
    )
    soil = (
        blocks.rock(matter.SOIL)
        + blocks.box("b", 0, 0, 4, 4)
        + blocks.fixed_edge([[0, 0], [4, 0]], "b")
        + blocks.WEIGHT
        + joints.FACTOR
    )
    yield Feature("factor of safety of soil", soil + blocks.quads(2.0), NET)
    yield Feature(
        "seasons",
        blocks.rock(matter.WARM) + blocks.FLOOR + see + matter.SEASONS + blocks.quads(0.5),
        LEVEL,
    )
    yield Feature(
        "standing reactions",
        blocks.rock() + blocks.FLOOR + see + motion.STANDING + blocks.quads(0.5),
        NET,
    )
    built = blocks.rock() + blocks.TWO + joints.HOLDS + blocks.INERTIA + motion.BUILT + see
    yield Feature("stages", built, ANY)
    pulled = blocks.rock() + blocks.FLOOR + blocks.CRACK + see
    grows = pulled + blocks.pulled_edge(top, [5e4, 1e6]) + matter.GROWS + blocks.quads(0.125)
    turned = {"turn by 180 deg": 1e-5}  # functions of tips are integrated to that
    yield Feature("growth", grows + "[formulation.loading]\nincrement = 0.25\n", NET, turned)
    yield Feature(
        "growth in time",
        "duration = 2e-3\n" + grows + blocks.INERTIA + motion.IN_TIME,
        NET,
        dict.fromkeys(NET, 1e-7) | turned,
    )
    zone = (
        pulled
        + joints.SOFTENS
        + blocks.pulled_edge(top, [1e4, 1e6])
        + matter.ZONE
        + blocks.quads(0.25)
    )
    yield Feature("cohesive zones", zone, LEVEL)
    falling = (
        "duration = 0.01\n"
        + blocks.rock()
        + blocks.FLOOR
        + blocks.box("c", 0.2, 1.0, 0.8, 1.5)
        + joints.DRY
    )
    falling += (
        '[[initial_velocities]]\nblock = "c"\nvelocity = [0, -5]\n'
        + blocks.INERTIA
        + matter.FALL
        + motion.NEWMARK
    )
    yield Feature("splitting", falling + blocks.monitor("o", [0.5, 0.2], "b"), FREE)


FEATURES = {one.name: one for one in _features()}


class Features(HardClass):
    """Single features, seen from elsewhere."""

    name = "features"
    title = "one small scene of each feature: finite strain, growth, stages, bars, control of paths"
    oracle = "the same history in other units, listed in another order, shifted, turned, mirrored"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield each feature; they draw nothing from ``seed``."""
        for one in FEATURES.values() if seed == 0 else ():
            judge = partial(seen_alike, ways=one.ways, allowed=one.allowed)
            yield HardCase(one.name, tomllib.loads(one.text), judge, {"feature": one.name})
