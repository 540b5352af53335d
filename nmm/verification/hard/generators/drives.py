"""Blocks on joints of every kind, driven by loads and ground that change in time."""

from collections.abc import Iterator

import numpy as np

from nmm.verification.base import Checks, limit
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import over_parts
from nmm.verification.hard.cases.writing import block, in_time, rock
from nmm.verification.hard.oracles.motion import (
    RUN_RISE,
    STEP_RISE,
    body_checks,
    ended,
    ran,
)
from nmm.verification.text import rectangle

DURATION, STEPS = 0.08, 80
STRENGTH = 1e4
"""Cohesion (Pa) that the larger pushes overcome."""

JOINTS: dict[str, Document] = {
    "dry": {},
    "damped": {"damping": 0.3},
    "dilating": {"dilation_angle": 0.14, "dilation_slip": 0.02},
    "bonded": {"bonded": True, "cohesion": STRENGTH, "tensile_strength": STRENGTH / 2},
    "of its own stiffness": {"normal_stiffness": 1e10, "shear_stiffness": 5e9},
}
"""Keys of an interface. Bonds that soften are none of these: they act as at the end of a step."""


class Drives(HardClass):
    """Two blocks on a floor, each joint with each drive; work, stores and losses add up."""

    name = "drives"
    title = "two blocks on joints that rub, damp, dilate or break, under loads and ground in motion"
    oracle = "work is stored or lost to what the scene names, nobody through anybody, area kept"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield every joint with one drive, the next one with the next seed."""
        for number, joint in enumerate(JOINTS):
            random = np.random.default_rng([seed, number, 23])
            drive = list(DRIVES)[(seed + number) % len(DRIVES)]
            scene = in_time(_blocks(joint, random), DURATION / STEPS, STEPS)
            scene |= DRIVES[drive](random)
            words, kinds = f"seed {seed}, {joint}, {drive}", {"joint": joint, "drive": drive}
            yield from over_parts(words, scene, DURATION / STEPS, driven, kinds=kinds)


def _blocks(joint: str, random: np.random.Generator) -> Document:
    """Two blocks on a floor, the lower one wider; what drives them is still missing."""
    low, high, shift = random.uniform(0.5, 0.9), random.uniform(0.4, 0.8), random.uniform(0, 0.3)
    tables = rock(modulus=5e9, friction=float(random.uniform(15, 35)))
    tables["interfaces"]["contact"] |= JOINTS[joint]
    return tables | {
        "blocks": [
            block("floor", rectangle((-3, -1), (5, 0))),
            block("low", rectangle((0, 0), (1.2, low))),
            block("high", rectangle((shift, low), (shift + 0.8, low + high))),
        ],
        "supports": [{"name": "ground", "block": "floor", "fix": ["x", "y"]}],
    }


def _wave(random: np.random.Generator) -> list[list[float]]:
    """Pairs of time (s) and factor of a wave of 8 to 20 Hz."""
    times, pulse = np.linspace(0.0, DURATION, 33), 2 * np.pi * random.uniform(8, 20)
    return [[time, float(np.sin(pulse * time))] for time in times.tolist()]


def _pushed(random: np.random.Generator) -> Document:
    force = float(random.uniform(1e4, 6e4))
    load = {"name": "push", "kind": "body", "block": "high", "density": [force, 0.0]}
    return {"loads": [{**load, "history": _wave(random)}]}


def _pressed(random: np.random.Generator) -> Document:
    load = {"name": "jack", "kind": "pressure", "block": "high"}
    return {
        "loads": [{**load, "pressure": float(random.uniform(1e4, 1e5)), "history": _wave(random)}]
    }


def _shaken(random: np.random.Generator) -> Document:
    quake = {"samples": _wave(random), "scale": float(random.uniform(2, 8))}
    ground = {"name": "ground", "block": "floor", "fix": ["x", "y"], "motion": {"x": "quake"}}
    return {"records": {"quake": quake}, "supports": [ground]}


def _displaced(random: np.random.Generator) -> Document:
    ground = {"name": "ground", "block": "floor", "fix": ["x", "y"], "history": _wave(random)}
    return {"supports": [{**ground, "displacement": [float(random.uniform(2e-3, 1e-2)), 1e-3]}]}


DRIVES = {
    "force on volume": _pushed,
    "pressure": _pressed,
    "shaken ground": _shaken,
    "displaced ground": _displaced,
}
"""What drives them, by name."""


def driven(scene: Document) -> Checks:
    """Return what must hold: the audits of energy are those of work, stores and losses together."""
    found = ran(scene)
    checks, audits = ended(found), found.run.summary.audits
    reason = "work that is neither stored nor lost to friction, dampers and bonds"
    rises = ("energy_made_in_step", STEP_RISE), ("energy_made_in_run", RUN_RISE)
    for name, allowed in rises:
        checks[name.replace("_", " ")] = limit(float(audits.get(name, 0.0)), allowed, reason)
    return checks | body_checks(found)
