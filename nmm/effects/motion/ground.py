"""Prescribed displacement of supports: constant, by a field, by a history, or by records."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.places import Place
from nmm.effects.base import Instant, Setup
from nmm.effects.loading.load_factor import displacement_factor

if TYPE_CHECKING:
    from nmm.effects.motion.record import GroundMotion
    from nmm.scene.actions import SupportTable


INSTANTS = 4
"""Instants at which a field is kept: a step asks at both of its ends, over and over."""


@dataclass(frozen=True)
class Ground:
    """Prescribed displacement of the ground at a support, as a function of the instant.

    Attributes
    ----------
    way, factor
        Displacement at factor 1 as a function of time, (2,) or (m, 2) (m), and its factor.
    motions
        Records along x (0) and y (1).
    still
        Whether it does not move in dynamics.
    """

    way: Callable[[float], Floats]
    factor: Callable[[Instant], float]
    motions: Mapping[int, "GroundMotion"]
    still: bool

    @classmethod
    def of(cls, setup: Setup, support: "SupportTable", place: Place) -> Self:
        """Return the ground at a support of the scene."""
        motions = _motions(setup, support)
        moves = any(support.displacement) or support.field is not None
        way, varies = _way(setup, support, place)
        moves = bool(motions) or varies or (moves and support.history is not None)
        return cls(way, displacement_factor(setup, support), motions, not moves)

    def __call__(self, end: Instant) -> Floats:
        """Return the displacement (2,) or (m, 2) at an instant (m)."""
        found = self.factor(end) * self.way(end.time)
        for axis, motion in self.motions.items():
            found[..., axis] += motion.displacement_at(end.time)
        return np.asarray(found)

    @property
    def step(self) -> float | None:
        """Shortest interval between samples of its records (s); None without records."""
        return min((one.shortest_step for one in self.motions.values()), default=None)


def _way(
    setup: Setup, support: "SupportTable", place: Place
) -> tuple[Callable[[float], Floats], bool]:
    """Return the displacement at factor 1 as a function of time, and whether it varies."""
    if support.field is None:
        way = np.array(support.displacement)
        return (lambda time: way), False
    from nmm.effects.loading.fields import ValueField

    field = ValueField.named(setup, support.field, f"[[supports]] {support.name}")
    field.checked(place.position, setup)
    kept = lru_cache(INSTANTS)(lambda time: field.values(place.position, time))
    return kept, field.varies


def _motions(setup: Setup, support: "SupportTable") -> "dict[int, GroundMotion]":
    if not support.motion or setup.scene.inertia is None:  # records act in dynamics alone
        return {}
    from nmm.effects.motion.record import motions_of

    return motions_of(setup.scene, support.motion)
