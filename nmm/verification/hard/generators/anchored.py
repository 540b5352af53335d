"""Blocks on rough floors that members with limits hold, pushed until they slide."""

from collections.abc import Callable, Iterator

import numpy as np

from nmm.verification.base import Check, Checks, holds, limit
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import enforcements, with_parts
from nmm.verification.hard.cases.transforms import turned
from nmm.verification.hard.cases.writing import block, rock, supported
from nmm.verification.hard.oracles.motion import ran
from nmm.verification.hard.oracles.whole import GAVE_UP
from nmm.verification.text import rectangle

WIDE, LOW, APART = 2.0, 0.5, 3.0
"""Of the blocks, and from one to the next (m): wide ones slide before they tip."""

TOLERANCE = 2e-3
"""Of the load that fails, relative to it."""

STIFF = 1e9
"""Of members (N/m): none is longer by more than 0.1 mm where it yields."""

LACKING = 0.05
"""Of the turnover: what slides within an increment of loads is booked by means of its ends."""

UNITS = 1e4
"""Forces (N), near the weight of a block."""

Table = tuple[str, Document]


class Anchored(HardClass):
    """One or two blocks behind each other, on one to three members of any kind."""

    name = "anchored"
    title = "blocks on rough floors held by cables, springs, struts, bolts and foundations"
    oracle = (
        "no failure load above the bound of the static theorem, nor below it where nothing has a "
        "choice; work is stored or lost to what yields and rubs"
    )

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield one scene with every enforcement."""
        random = np.random.default_rng([seed, 101])
        scene, words = _scene(random)
        for name in enforcements():
            made = with_parts(scene, {"contact.enforcement": name})
            parts = {"enforcement": name, "members": words}
            yield HardCase(f"seed {seed}, {words}, {name}", made, _bounded, parts)


def _scene(random: np.random.Generator) -> tuple[Document, str]:
    """Return tables, and the kinds of the members."""
    scene = rock(friction=float(random.uniform(5, 40)))
    count, kinds = int(random.integers(1, 3)), list(KINDS)
    chosen = [kinds[at] for at in random.choice(len(kinds), size=random.integers(1, 4))]
    tables = [block("floor", rectangle((-9, -1), (9, 0)))]
    for one in range(count):
        left = -APART * one
        tables.append(block(f"b{one}", rectangle((left, 0), (left + WIDE, LOW))))
    for number, kind in enumerate(chosen):
        table, member = KINDS[kind](random)
        scene.setdefault(table, []).append({"name": f"{kind} {number}", **member})
    if count > 1:
        scene.setdefault("springs", []).append(_tie(random))
        chosen.append("tie")
    push = {"name": "push", "kind": "point", "point": [0.0, LOW / 2], "block": "b0"}
    scene |= {
        "blocks": tables,
        "supports": supported("floor"),
        "gravity": {"acceleration": [0.0, -9.81]},
        "loads": [{**push, "force": [UNITS, 0.0]}],
        "loading": {"until": "failure", "maximum_factor": 50.0},
    }
    scene["formulation"] = {
        "loading": {"increment": float(random.choice([0.2, 1.0])), "tolerance": TOLERANCE}
    }
    return turned(scene, float(random.uniform(-np.pi, np.pi))), ", ".join(chosen)


def _force(random: np.random.Generator) -> float:
    return float(UNITS * 10.0 ** random.uniform(-1, 0.5))


def _behind(random: np.random.Generator, carries: str) -> Table:
    """A member to the ground behind, level or down to it."""
    start = [0.0, float(random.uniform(0.2, 0.8)) * LOW]
    end = [-float(random.uniform(1, 4)), start[1] - float(random.choice([0.0, 0.3, 1.0]))]
    member: Document = {"points": [start, end], "blocks": ["b0", "ground"], "stiffness": STIFF}
    return "springs", {**member, "carries": carries, "yield_force": _force(random)}


def _cable(random: np.random.Generator) -> Table:
    table, made = _behind(random, "tension")
    if random.random() < 0.5:
        made["force"] = float(random.choice([-0.5, 0.5])) * made["yield_force"]
    return table, made


def _spring(random: np.random.Generator) -> Table:
    return _behind(random, "both")


def _idle(random: np.random.Generator) -> Table:
    return _behind(random, "compression")


def _strut(random: np.random.Generator) -> Table:
    """A strut before the block."""
    height = float(random.uniform(0.2, 0.8)) * LOW
    points = [[WIDE, height], [WIDE + float(random.uniform(1, 4)), height]]
    member: Document = {"points": points, "blocks": ["b0", "ground"], "stiffness": STIFF}
    return "springs", {**member, "carries": "compression", "yield_force": _force(random)}


def _bolt(random: np.random.Generator) -> Table:
    """A bolt to the ground behind, with bond in the block, that slides or yields first."""
    height = float(random.uniform(0.2, 0.8)) * LOW
    area, force = 1e-4, _force(random)
    length = float(random.uniform(0.3, 1.5))
    return "bars", {
        "points": [[length, height], [-1.0, height]],
        "blocks": ["b0", "ground"],
        **{"area": area, "perimeter": 0.1, "young_modulus": 2e11, "ends": ["free", "ground"]},
        "yield_stress": force / area * float(random.uniform(0.5, 2)),
        "bond": {"law": "plastic", "stiffness": 1e10, "strength": force / (0.1 * length)},
    }


def _foundation(random: np.random.Generator) -> Table:
    """A bed behind the block, which it leaves."""
    made = {"segment": [[0.0, LOW], [0.0, 0.0]], "block": "b0", "carries": "compression"}
    return "foundations", {**made, "normal_stiffness": STIFF}


def _tie(random: np.random.Generator) -> Document:
    points = [[0.0, LOW / 2], [WIDE - APART, LOW / 2]]
    tie: Document = {"name": "tie", "points": points, "blocks": ["b0", "b1"], "stiffness": STIFF}
    tie["carries"] = str(random.choice(["both", "tension"]))
    return {**tie, "yield_force": _force(random)}


KINDS: dict[str, Callable[[np.random.Generator], Table]] = {
    **{"cable": _cable, "spring": _spring, "idle strut": _idle, "strut": _strut},
    **{"bolt": _bolt, "foundation": _foundation},
}
"""Members by name."""


def _bounded(scene: Document) -> Checks:
    """Compare the largest load in equilibrium with the bound: what has a limit is at it there."""
    said = ran(scene).run.summary
    factor, bound = said.failure_factor, said.failure_bound
    if factor is None or bound is None:
        return {"failure load and its bound": holds(False, said.sentence)}
    gave_up = {GAVE_UP: limit(1.0, 1.0, said.sentence)} if said.status == "failed" else {}
    longer = "members are longer by 1e-4 where they yield"
    lacking = float(said.audits.get("energy_released", 0.0))
    return gave_up | {
        "over the bound": Check(factor, bound, 1e-3, longer, bound="at_most"),
        "under the bound": Check(
            factor, bound, 1.1 * TOLERANCE + 1e-3, f"the search; {longer}", bound="at_least"
        ),
        "work = stored + lost": limit(lacking, LACKING, "turnover"),
    }
