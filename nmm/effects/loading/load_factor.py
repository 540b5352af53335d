"""Factors of loads and displacements of a scene at an instant."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.effects.base import Instant, Setup

if TYPE_CHECKING:
    from nmm.scene.actions import PlacedTable, SupportTable


def load_factor(setup: Setup, load: "PlacedTable") -> Callable[[Instant], float]:
    """Return the factor of a load: its history, times the load factor if it is scaled.

    Without ``[loading]`` all loads are scaled: by 0 to 1 in statics, by 1 in dynamics.
    """
    loading, acting = setup.scene.loading, setup.acting
    course = course_of(load.history)
    if acting is not None:
        return lambda end: course(end.time) * acting.share(load.name, end.load_factor)
    scaled = loading is None or loading.scaled == "all" or load.name in loading.scaled
    return lambda end: course(end.time) * (end.load_factor if scaled else 1.0)


def displacement_factor(setup: Setup, support: "SupportTable") -> Callable[[Instant], float]:
    """Return the factor of a prescribed displacement: its history, times any load factor.

    It is scaled if ``[loading]`` names it, or scales "all" in a scene without loads and the
    displacement has no history. Supports that are new in a stage are driven from where they stand:
    what their displacement is at its start grows with the load factor.
    """
    acting, course = setup.acting, course_of(support.history)
    if acting is not None:

        def driven(end: Instant) -> float:
            lacks, begin = acting.left_behind(support.name, end.time, end.load_factor)
            return course(end.time) - lacks * course(begin)

        return driven
    loading, alone = setup.scene.loading, not setup.scene.loads and support.history is None
    scaled = loading is not None and (
        alone if loading.scaled == "all" else support.name in loading.scaled
    )
    return lambda end: course(end.time) * (end.load_factor if scaled else 1.0)


def course_of(history: Sequence[tuple[float, float]] | None) -> Callable[[float], float]:
    """Return the factor over time of (time, factor) pairs, linear between, constant beyond.

    It is `steadily` without a history.
    """
    if history is None:
        return steadily
    times, factors = np.array(history, dtype=float).T.copy()
    return partial(_between, times, factors)


def steadily(time: float) -> float:
    """Return 1: the factor of what is given without a history."""
    return 1.0


def _between(times: Floats, factors: Floats, time: float) -> float:
    return float(np.interp(time, times, factors))
