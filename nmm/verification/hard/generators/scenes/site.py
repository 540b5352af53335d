"""What random tables are made to measure by: sizes, stresses and times of the scene they join."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.verification.hard.cases.base import Document

DENSITY = 2000.0
"""Of all matter of random scenes (kg/m3)."""


@dataclass(frozen=True)
class Site:
    """A wall and its measures.

    Attributes
    ----------
    random
        What everything is drawn from.
    width, height
        Of the wall (m).
    modulus
        Young's modulus (Pa).
    step
        Of time (s).
    kind
        How the scene runs: "rest", "time", "creep", "failure", "safety" or "stages".
    blocks
        Names of the blocks.
    corners
        Of them, those at the upper left and the upper right corner.
    """

    random: np.random.Generator
    width: float
    height: float
    modulus: float
    step: float
    kind: str
    blocks: tuple[str, ...]
    corners: tuple[str, str]

    @property
    def top(self) -> list[list[float]]:
        """The upper edge of the wall."""
        return [[0.0, self.height], [self.width, self.height]]

    @property
    def left(self) -> list[list[float]]:
        """The left edge of the wall."""
        return [[0.0, 0.0], [0.0, self.height]]

    @property
    def right(self) -> list[list[float]]:
        """The right edge of the wall."""
        return [[self.width, 0.0], [self.width, self.height]]

    @property
    def stress(self) -> float:
        """A stress that strains by 1e-5 to 1e-3 (Pa)."""
        return self.modulus * float(10.0 ** self.random.uniform(-5, -3))

    @property
    def moves(self) -> bool:
        """Whether it has inertia."""
        return self.kind == "time"

    def seldom(self, share: float) -> bool:
        """Draw whether something is there."""
        return bool(self.random.random() < share)

    def one_of(self, *choices: str) -> str:
        """Draw one of several words."""
        return str(self.random.choice(choices))

    def vector(self, size: float) -> list[float]:
        """Draw a vector of about a size."""
        drawn: Floats = size * self.random.normal(size=2)
        return [float(drawn[0]), float(drawn[1])]

    def history(self) -> list[list[float]]:
        """Draw factors over the time of the run, or over the load factor."""
        end = 8 * self.step if self.moves else 1.0
        middle = float(self.random.uniform(0.2, 0.8))
        return [[0.0, 0.0], [middle * end, float(self.random.uniform(-1, 1))], [end, 1.0]]


def merged(scene: Document, tables: Document) -> Document:
    """Return a scene with further tables; lists of tables grow, others are taken."""
    made = dict(scene)
    for key, value in tables.items():
        both = isinstance(value, list) and key in made
        made[key] = [*made[key], *value] if both else value
    return made
