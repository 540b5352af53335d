"""Singular functions about a point, in global axes and on a branch of the angle."""

from dataclasses import dataclass

import numpy as np

from covers.local_functions.singular_functions import SingularFunctions
from integration.arrays import Floats


@dataclass(frozen=True)
class Enrichment:
    """Singular functions about one point.

    Attributes
    ----------
    functions
        The functions.
    point, direction
        (2,) singular point (m) and unit vector of the bisector: ahead of a crack, into the
        material at a corner.
    radius
        Covers whose centre is within it are enriched (m); those of elements that touch the point
        always are.
    body
        Body whose covers are enriched; None for all.
    """

    functions: SingularFunctions
    point: Floats
    direction: Floats
    radius: float = 0.0
    body: int | None = None


def polar(item: Enrichment, points: Floats) -> tuple[Floats, Floats]:
    """Return distance (m,) from the singular point (m) and angle (m,) from its bisector (rad)."""
    along, across = _local(item, points).T
    return np.hypot(along, across), np.arctan2(across, along)


def near(angle: Floats, bearing: Floats) -> Floats:
    """Return ``angle`` plus whole turns, so that it is within pi of ``bearing`` (rad)."""
    return np.asarray(bearing + np.mod(angle - bearing + np.pi, 2 * np.pi) - np.pi)


def singular_fields(item: Enrichment, points: Floats, bearing: Floats) -> tuple[Floats, Floats]:
    """Return values (m, n, 2) and gradients (m, n, 2, 2) of singular functions in global axes.

    ``bearing`` (m,) selects the branch of the angle: the one within pi of it (rad, from the
    bisector). The two faces of a crack lie on different branches.
    """
    turn = _turn(item)
    value, gradient = item.functions.evaluate(*_branch(item, points, bearing))
    # One product for all points: numpy multiplies small matrices pair by pair, ten times slower.
    turned = gradient.reshape(-1, 4) @ np.kron(turn, turn).T
    return (value.reshape(-1, 2) @ turn.T).reshape(value.shape), turned.reshape(gradient.shape)


def singular_values(item: Enrichment, points: Floats, bearing: Floats) -> Floats:
    """Return the values (m, n, 2) of `singular_fields` alone."""
    value = item.functions.values(*_branch(item, points, bearing))
    return np.asarray((value.reshape(-1, 2) @ _turn(item).T).reshape(value.shape))


def _branch(item: Enrichment, points: Floats, bearing: Floats) -> tuple[Floats, Floats]:
    """Distance (m,) from the singular point (m), nowhere zero, and angle (m,) on a branch (rad)."""
    radius, angle = polar(item, points)
    return np.maximum(radius, 1e-30), near(angle, bearing)


def _local(item: Enrichment, points: Floats) -> Floats:
    return np.asarray((points - item.point) @ _turn(item))


def _turn(item: Enrichment) -> Floats:
    """Matrix (2, 2) from the axes of the bisector to global ones."""
    d = np.asarray(item.direction, dtype=float)
    return np.array([[d[0], -d[1]], [d[1], d[0]]])
