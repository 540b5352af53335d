"""Small scenes of single features, each of which has one answer wherever it is seen from."""

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial

from nmm.verification.hard.cases.base import HardCase, HardClass
from nmm.verification.hard.generators.scenes import feature_texts as texts
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
    see, seen = texts.monitor("o", [1, 1], "b"), texts.monitor("o", [0.9, 1.9], "c")
    bent = texts.rock(texts.SOFT) + texts.FLOOR + texts.pulled_edge(top, [2e8, 1e8]) + see
    yield Feature("finite strain", bent + texts.FINITE, FREE)
    flying = (
        "duration = 0.04\n"
        + texts.rock(texts.SOFT)
        + texts.box("c", 0, 0, 1, 2)
        + texts.FLIGHT
        + texts.INERTIA
    )
    yield Feature("finite strain in flight", flying + seen + texts.CONSERVING, FREE)
    meeting = (
        "duration = 0.04\n"
        + texts.rock(texts.SOFT)
        + texts.FLOOR
        + texts.box("c", 0.2, 1.05, 0.9, 1.8)
    )
    meeting += (
        texts.FLIGHT
        + texts.DRY
        + texts.INERTIA
        + texts.monitor("o", [0.5, 1.5], "c")
        + texts.CONSERVING
    )
    yield Feature("finite strain and contact", meeting, FREE)
    yield Feature("opening", texts.CONTROLLED + texts.OPENED, ANY)
    yield Feature("displacement", texts.CONTROLLED + texts.MOVED, ANY)
    yield Feature(
        "dissipation",
        texts.CONTROLLED.replace(texts.STIFF, "") + texts.BONDS + texts.DISSIPATED,
        ANY,
    )
    brittle = texts.CONTROLLED.replace("linear_softening", "mohr_coulomb")
    yield Feature("events", brittle.replace("fracture_energy = 1e4\n", "") + texts.EVENTS, ANY)
    bolted = (
        texts.rock()
        + texts.TWO
        + texts.DRY
        + texts.pulled_edge([[0, 2], [1, 2]], [4e4, 3e4])
        + seen
    )
    yield Feature(
        "bars with slip", bolted + texts.BOLT.format(bond=texts.BOND), ANY, {"order": 1e-5}
    )
    yield Feature("bars without bond", bolted + texts.BOLT.format(bond=""), ANY, {"order": 1e-5})
    members = (
        texts.MOVING
        + texts.rock()
        + texts.TWO.replace(texts.HELD_BELOW, "")
        + texts.DRY
        + texts.INERTIA
        + texts.WEIGHT
        + seen
    )
    yield Feature("members in time", members + texts.MEMBERS + texts.NEWMARK, ANY, {"order": 1e-5})
    yield Feature(
        "factor of safety",
        texts.rock() + texts.SLOPE + texts.DRY.replace("0.4", "0.7") + texts.WEIGHT + texts.FACTOR,
        ANY,
    )
    soil = (
        texts.rock(texts.SOIL)
        + texts.box("b", 0, 0, 4, 4)
        + texts.fixed_edge([[0, 0], [4, 0]], "b")
        + texts.WEIGHT
        + texts.FACTOR
    )
    yield Feature("factor of safety of soil", soil + texts.quads(2.0), NET)
    yield Feature(
        "seasons",
        texts.rock(texts.WARM) + texts.FLOOR + see + texts.SEASONS + texts.quads(0.5),
        LEVEL,
    )
    yield Feature(
        "standing reactions",
        texts.rock() + texts.FLOOR + see + texts.STANDING + texts.quads(0.5),
        NET,
    )
    built = texts.rock() + texts.TWO + texts.HOLDS + texts.INERTIA + texts.BUILT + see
    yield Feature("stages", built, ANY)
    pulled = texts.rock() + texts.FLOOR + texts.CRACK + see
    grows = pulled + texts.pulled_edge(top, [5e4, 1e6]) + texts.GROWS + texts.quads(0.125)
    turned = {"turn by 180 deg": 1e-5}  # functions of tips are integrated to that
    yield Feature("growth", grows + "[formulation.loading]\nincrement = 0.25\n", NET, turned)
    yield Feature(
        "growth in time",
        "duration = 2e-3\n" + grows + texts.INERTIA + texts.IN_TIME,
        NET,
        dict.fromkeys(NET, 1e-7) | turned,
    )
    zone = (
        pulled + texts.SOFTENS + texts.pulled_edge(top, [1e4, 1e6]) + texts.ZONE + texts.quads(0.25)
    )
    yield Feature("cohesive zones", zone, LEVEL)
    falling = (
        "duration = 0.01\n"
        + texts.rock()
        + texts.FLOOR
        + texts.box("c", 0.2, 1.0, 0.8, 1.5)
        + texts.DRY
    )
    falling += (
        '[[initial_velocities]]\nblock = "c"\nvelocity = [0, -5]\n'
        + texts.INERTIA
        + texts.FALL
        + texts.NEWMARK
    )
    yield Feature("splitting", falling + texts.monitor("o", [0.5, 0.2], "b"), FREE)


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
