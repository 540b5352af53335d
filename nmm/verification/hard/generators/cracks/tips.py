"""Cracks whose tip or faces lie on corners and lines of the net, or next to them."""

from collections.abc import Iterator

import numpy as np

from nmm.verification.base import Check, Checks, limit
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import meshes, with_parts
from nmm.verification.hard.cases.writing import block
from nmm.verification.hard.generators.cracks.cuts import net_point
from nmm.verification.hard.oracles.motion import Ran, ended, ran

AWAY = (0.0, 1e-14, 1e-12, -1e-10, 1e-8, -1e-6, 1e-4, 1e-2, 0.1)
ANGLES = (0.0, 0.3, np.pi / 4)
SIZE = 0.1
BOX = np.array([[0.0, -1.0], [1.0, 1.0]])
# K_I / (sigma sqrt(pi a)) of an edge crack, width 1, height 2: finite elements of degree 4.
FACTORS = ((0.3, 1.66112), (0.5, 2.82546))
GAPS = (1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)


class Tips(HardClass):
    """Edge cracks in tension; the net is moved so that the tip lies at or near a corner of it."""

    name = "tips"
    title = (
        "crack tips and faces 0 to 0.1 of a cell from corners and lines of the net, three angles"
    )
    oracle = "K_I of degree-4 finite elements within 2 %, K_II below 1 % of it, one body"
    share = 2

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield every cover of degree 1 and the next, at one distance and angle each."""
        for number, (name, cover) in enumerate(meshes(SIZE, (1,)).items()):
            for way in ("tip", "face"):
                away = AWAY[(seed + 2 * number) % len(AWAY)]
                angle = ANGLES[(seed + number) % len(ANGLES)] if way == "tip" else 0.0
                length, factor = FACTORS[seed % 2]
                table = {**cover, "angle": float(angle)}
                scene, words = _plate(table, length, away, way)
                label = f"{words}, a = {length:g}, net at {angle:.3g}, seed {seed}, {name}"
                right = factor * np.sqrt(np.pi * length)
                yield HardCase(label, scene, _Intensity(right), {"cover": name})


class Ligaments(HardClass):
    """A crack that ends just short of the far edge."""

    name = "ligaments"
    title = "a crack that stops 1e-1 to 1e-12 of a cell short of the far edge"
    oracle = "either apart or held: forces finite, no more than those of a longer ligament"
    share = 3

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield every cover at one gap each."""
        for number, (name, cover) in enumerate(meshes(SIZE, (0, 1)).items()):
            gap = GAPS[(seed + number) % len(GAPS)]
            scene = _torn(cover, gap * SIZE)
            label = f"gap {gap:g} of a cell, seed {seed}, {name}"
            yield HardCase(label, scene, _held, {"cover": name})


class _Intensity:
    """Judge of an edge crack with a known K_I."""

    def __init__(self, right: float) -> None:
        self.right = right

    def __call__(self, scene: Document) -> Checks:
        from nmm.fracture.stress_intensity import stress_intensity

        found = ran(scene)
        checks = ended(found)
        if not found.run.summary.steps:
            return checks
        model = found.run.stepper.model
        kappa = 3 - 4 * 0.3
        tip = stress_intensity(model, found.run.state.deformation, 0, 0.25, kappa=kappa)
        bodies = len(np.unique(found.run.manifold.element_body))
        return checks | {
            "K_I": Check(tip.opening, self.right, 0.02, "aim; 10 cells across"),
            "K_II": Check(tip.sliding, 0.0, 0.01, "symmetry; the net has none", self.right),
            "bodies": Check(float(bodies), 1.0, 0.0, "the crack ends inside"),
        }


def _plate(cover: Document, length: float, away: float, way: str) -> tuple[Document, str]:
    """Tables of a plate in tension; the net is shifted so that a corner lies by the tip.

    With ``way`` "face" the crack runs along a line of the net, off by ``away``.
    """
    tip = np.array([length, 0.0])
    corner = net_point(cover, BOX)
    c, s = np.cos(cover["angle"]), np.sin(cover["angle"])
    off = np.array([[c, s], [-s, c]]) @ (tip - corner) / SIZE
    wanted = np.array([away, 0.0]) if way == "tip" else np.array([0.37, away])
    shift = np.mod(off - wanted, 1.0)
    placed = with_parts(_pulled(length), {"cover": {**cover, "shift": shift.tolist()}})
    return placed, f"{way} off by {away:g} of a cell"


def _pulled(length: float) -> Document:
    return {
        "plane": "strain",
        "materials": {"m": {"young_modulus": 1.0, "poisson_ratio": 0.3}},
        "blocks": [block("plate", [[0, -1], [1, -1], [1, 1], [0, 1]], "m")],
        "cracks": [{"name": "crack", "points": [[-0.1, 0.0], [length, 0.0]]}],
        "supports": [
            {"name": "pin", "point": [1.0, -1.0], "fix": ["x", "y"]},
            {"name": "roller", "point": [1.0, 1.0], "fix": ["x"]},
        ],
        "loads": [
            {"name": "up", "kind": "edge", "segment": [[0, 1], [1, 1]], "traction": [0.0, 1.0]},
            {"name": "down", "kind": "edge", "segment": [[0, -1], [1, -1]], "traction": [0, -1.0]},
        ],
    }


def _torn(cover: Document, gap: float) -> Document:
    """Tables of a square that is drawn apart about a crack that nearly parts it."""
    return {
        "plane": "strain",
        "materials": {"m": {"young_modulus": 1.0, "poisson_ratio": 0.3}},
        "blocks": [block("square", [[0, 0], [1, 0], [1, 1], [0, 1]], "m")],
        "cracks": [{"name": "crack", "points": [[-0.1, 0.513], [1.0 - gap, 0.513]]}],
        "supports": [
            {"name": "low", "segment": [[0, 0], [1, 0]], "fix": ["x", "y"]},
            {
                "name": "high",
                "segment": [[0, 1], [1, 1]],
                "fix": ["x", "y"],
                "displacement": [0, 0.01],
            },
        ],
        "formulation": {"cover": cover},
    }


def _held(scene: Document) -> Checks:
    found: Ran = ran(scene)
    checks = ended(found)
    if not found.run.summary.steps:
        return checks
    h = found.run.history
    pull = float(h["reaction:high:y"][-1])
    off = abs(pull + float(h["reaction:low:y"][-1]))
    # A whole square of height 1 carries E' strain = 0.011; drawn about one end far less.
    return checks | {
        "pull": limit(abs(pull), 0.005, "less than half of the whole square's"),
        "balance": limit(off, 1e-9, "reactions cancel"),
        "residual": limit(float(h["residual"].max()), 1e-6, "out of balance"),
    }
