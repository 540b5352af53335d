"""Wedges in narrow cracks, down to half angles of a thousandth."""

from collections.abc import Iterator

import numpy as np

from nmm.verification.base import Check, Checks, holds
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import enforcements, over_parts, with_parts
from nmm.verification.hard.cases.writing import block, in_time, rock, supported
from nmm.verification.hard.oracles.motion import body_checks, ended, energy_checks, ran

HALF_ANGLES = (1e-3, 5e-3, 0.0175, 0.05, 0.1, 0.3)
FRICTIONS = (0.0, 10.0, 30.0)


class Wedges(HardClass):
    """A wedge between two held faces that meet at the foot of their crack."""

    name = "wedges"
    title = "a wedge in a crack of half angle 0.001 to 0.3, its faces meeting in one point"
    oracle = "both faces press by W / (2 (sin a + mu cos a)), more where wedged in; W is carried"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield every half angle in statics, and one in time."""
        random = np.random.default_rng([seed, 23])
        for number, half in enumerate(HALF_ANGLES):
            friction = FRICTIONS[(seed + number) % len(FRICTIONS)]
            scene = crack(half, friction, random)
            for name in enforcements():
                made = with_parts(scene, {"contact.enforcement": name})
                label = f"half angle {half:g}, {friction:g} deg, seed {seed}, {name}, statics"
                yield HardCase(label, made, _statics, {"enforcement": name})
        half = HALF_ANGLES[seed % len(HALF_ANGLES)]
        friction = FRICTIONS[seed % len(FRICTIONS)]
        for step in (1e-3, 1e-4):
            moved = in_time(crack(half, friction, random), step, 100)
            words = f"half angle {half:g}, {friction:g} deg, seed {seed}, in time"
            yield from over_parts(words, moved, step, _in_time)


def crack(half: float, friction: float, random: np.random.Generator) -> Document:
    """Tables of two held blocks with a crack between them and a wedge that fits it."""
    tangent = np.tan(half)
    low, high = random.uniform(0.2, 0.5), random.uniform(0.8, 1.1)
    wedge = [[-low * tangent, low], [low * tangent, low]]
    wedge += [[high * tangent, high], [-high * tangent, high]]
    left = [[-1.0, 0.0], [0.0, 0.0], [-1.2 * tangent, 1.2], [-1.2, 1.2]]
    right = [[0.0, 0.0], [1.0, 0.0], [1.2, 1.2], [1.2 * tangent, 1.2]]
    return {
        **rock(friction=friction),
        "blocks": [block("left", left), block("right", right), block("wedge", wedge)],
        "supports": supported("left", "right"),
        "gravity": {"acceleration": [0.0, -9.81]},
        "monitors": [{"name": "foot", "point": wedge[0], "block": "wedge"}],
        "formulation": {"contact": {"normal_penalty": 100.0}},
    }


def _statics(scene: Document) -> Checks:
    """Check forces on both faces by the closed form; the wedge sinks next to nothing."""
    found = ran(scene)
    checks = ended(found)
    if not found.run.summary.steps:
        return checks
    frame = found.run.frames[-1]
    points = np.array(scene["blocks"][2]["vertices"])
    area = float((points[2, 0] + points[1, 0]) * (points[2, 1] - points[1, 1]))
    weight = scene["materials"]["rock"]["density"] * 9.81 * area
    half = float(np.arctan2(points[1, 0], points[1, 1]))
    friction = np.tan(scene["interfaces"]["contact"]["friction_angle"])
    right = weight / (2 * (np.sin(half) + friction * np.cos(half)))
    # The faces touch each other at their foot, below the wedge; that is no force on it.
    on_wedge = frame.contact_position[:, 1] > points[0, 1] / 2
    side = np.sign(frame.contact_position[:, 0]) * on_wedge
    forces, shear = (
        [float(np.abs(column[side == s].sum())) for s in (-1.0, 1.0)]
        for column in frame.contact_force.T
    )
    # Faces give by N / (100 E), which the wedge turns into N / (100 E sin a) of sinking.
    sunk = 20.0 * right / (100 * 20e9) / np.sin(half) + 1e-9
    down = -float(found.run.history["monitor:foot:uy"][-1])
    reason = "closed form; strains turn faces by 1e-6 / a"
    carried = sum(forces) * np.sin(half) + sum(shear) * np.cos(half)
    checks |= {
        "carried": Check(carried, weight, 1e-2, reason),
        "both alike": Check(forces[0], forces[1], 1e-2, reason),
        # Without friction the smallest half angle presses a face with 500 weights.
        "sinks": Check(down, 0.0, 1.0, "what its springs give", sunk + 1e-5),
    }
    if friction > np.tan(half):  # wedged in: any larger force is in balance too
        return checks | {"force": holds(forces[0] > 0.99 * right, f"{forces[0]:.4g} N a face")}
    return checks | {"force": Check(forces[0], right, 1e-2, reason)}


def _in_time(scene: Document) -> Checks:
    found = ran(scene)
    checks = ended(found)
    if found.run.summary.steps:
        checks |= energy_checks(found) | body_checks(found)
        fall = -float(found.run.history["monitor:foot:uy"].min())
        time = found.run.history["time"][-1]
        checks["held"] = holds(fall < 0.1 * 9.81 * time**2 / 2 + 1e-4, f"falls by {fall:.2g} m")
    return checks
