"""Factors of loads and displacements of a scene at an instant."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from nmm.effects.base import Instant, Setup

if TYPE_CHECKING:
    from nmm.scene.actions import PlacedTable, SupportTable


def load_factor(setup: Setup, load: "PlacedTable") -> Callable[[Instant], float]:
    """Return the factor of a load: its history, times the load factor if it is scaled.

    Without ``[loading]`` all loads are scaled: by 0 to 1 in statics, by 1 in dynamics.
    """
    loading, acting = setup.scene.loading, setup.acting
    if acting is not None:
        return lambda end: (
            factor_of(load.history, end.time) * acting.share(load.name, end.load_factor)
        )
    scaled = loading is None or loading.scaled == "all" or load.name in loading.scaled
    return lambda end: factor_of(load.history, end.time) * (end.load_factor if scaled else 1.0)


def displacement_factor(setup: Setup, support: "SupportTable") -> Callable[[Instant], float]:
    """Return the factor of a prescribed displacement: its history, times any load factor.

    It is scaled if ``[loading]`` names it, or scales "all" in a scene without loads and the
    displacement has no history. Supports that are new in a stage are driven from where they stand:
    what their displacement is at its start grows with the load factor.
    """
    acting, course = setup.acting, support.history
    if acting is not None:

        def driven(end: Instant) -> float:
            lacks, begin = acting.left_behind(support.name, end.time, end.load_factor)
            return factor_of(course, end.time) - lacks * factor_of(course, begin)

        return driven
    loading, alone = setup.scene.loading, not setup.scene.loads and support.history is None
    scaled = loading is not None and (
        alone if loading.scaled == "all" else support.name in loading.scaled
    )
    return lambda end: factor_of(support.history, end.time) * (end.load_factor if scaled else 1.0)


def factor_of(history: Sequence[tuple[float, float]] | None, time: float) -> float:
    """Return the factor of a history of (time, factor) pairs, linear between, constant beyond."""
    if history is None:
        return 1.0
    times, factors = np.transpose(history)
    return float(np.interp(time, times, factors))
