"""Bodies that driven ground carries along: how far, to the last digit of where the ground is.

A stiff spring between two places that went half a metre together feels the rounding of both: a
millinewton of 10 GPa, more than the friction of what is light. So the way of a body counts from the
ground that drives it, and steps of statics are solved for what is left once this has carried it on.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.state import State
from nmm.constraints.imposition import Imposition
from nmm.effects.base import Instant


@dataclass(frozen=True)
class DrivenBodies:
    """How ground carries bodies in a step.

    Attributes
    ----------
    ground
        (B, 2) from where the ways of bodies count at its end (m).
    way
        (B, 2) how far they are carried in it (m).
    beside
        (B, 2) by how much their ways beside the ground change by that (m).
    """

    ground: Floats
    way: Floats
    beside: Floats


def driven(
    ties: Sequence[Imposition], jumps: Sequence[Floats], state: State, end: Instant
) -> DrivenBodies | None:
    """Return how supports carry bodies to the ``end`` of a step; None where they do not.

    An axis along which supports drive a body apart stays. Ground goes on with what it carries, and
    fetches what it has not driven before.

    Parameters
    ----------
    ties, jumps
        Supports, and the jump (m, 2) of each where the step begins (m).
    """
    frames = state.frames
    had = np.zeros_like(frames.centre) if frames.carried is None else frames.carried
    found, way, beside = had.copy(), np.zeros_like(had), np.zeros_like(had)
    for axis in (0, 1):
        held = [(tie, jump) for tie, jump in zip(ties, jumps, strict=True) if _holds(tie, axis)]
        if not held:
            continue
        body = np.concatenate([tie.interface.first.points.body for tie, _ in held])
        jump = np.concatenate([one[:, axis] for _, one in held])
        start, last = (
            np.concatenate([_ground(tie, at, axis) for tie, _ in held])
            for at in (Instant.of(state), end)
        )
        lag = start - had[body, axis]
        fetched = np.where(np.abs(jump + lag) < np.abs(jump), lag, 0.0)
        rows = _alike(body, np.stack([start, last, fetched]), len(had))
        at = body[rows]
        found[at, axis] = last[rows]
        way[at, axis] = (last - start + fetched)[rows]
        beside[at, axis] = (fetched - lag)[rows]
    return None if np.array_equal(found, had) else DrivenBodies(found, way, beside)


def _holds(tie: Imposition, axis: int) -> bool:
    """Whether a support holds an axis of points from where they were laid."""
    laid = not np.broadcast_to(tie.interface.anchor, (len(tie.interface), 2))[:, axis].any()
    return bool(len(tie.interface) and tie.interface.held[axis] and laid)


def _ground(tie: Imposition, at: Instant, axis: int) -> Floats:
    """Return the displacement (m,) of the ground at the points of a support."""
    points = len(tie.interface)
    return np.broadcast_to(tie.interface.displacement(at), (points, 2))[:, axis]


def _alike(body: Ints, values: Floats, count: int) -> Ints:
    """Return a row of each body all of whose rows (k, m) have the same values."""
    alike = np.ones(count, dtype=bool)
    for value in values:
        low, high = np.full(count, np.inf), np.full(count, -np.inf)
        np.minimum.at(low, body, value)
        np.maximum.at(high, body, value)
        alike &= low == high
    bodies, first = np.unique(body, return_index=True)
    return np.asarray(first[alike[bodies]])
