"""Quadrature that resolves a field: parts are halved until halves have the same integrals.

Gauss points are exact for polynomials. A field that jumps, bends or waves within a cell has other
integrals, of which nothing else would tell: all that acts and all that is checked sees the field at
these points alone.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from integration import gauss
from integration.arrays import Floats, Ints
from integration.segments import segment_rule
from integration.triangulation import triangle_areas

# A part is halved where the integrals of the field and of its moments differ by more than this
# share of what the whole load holds: on edges, where a jump costs one part a halving, and within
# elements, where it costs all parts that it crosses.
EDGE_SHARE, VOLUME_SHARE = 1e-9, 1e-6
# Halvings of a part, and number of parts, beyond which none is halved further.
MOST_HALVINGS, MOST_PARTS = 40, 4096
# Into how many parts segments and triangles are cut.
_NUMBER = {2: 2, 3: 4}
# Share of a segment that is no part of it.
NO_PART = 1e-9
# Generations of halves that a part is compared with: what is narrower than their points is missed.
LOOK = {2: 3, 3: 1}
# Parts whose values are held at a time.
AT_ONCE = 4096

Sampled = Callable[[Floats], Floats]
"""Values (m, c) of a field at points (m, 2), those of several instants beside one another."""


@dataclass(frozen=True)
class ResolvedParts:
    """Parts of edges or of elements on which a Gauss rule integrates a field.

    Attributes
    ----------
    corners
        (k, n, 2) ends of segments (n = 2) or corners of triangles (n = 3).
    owner
        (k,) which of the first parts each is a part of; sorted.
    left
        What the integrals of all may be off by, over that of the size of the field.
    """

    corners: Floats
    owner: Ints
    left: float


def resolved(corners: Floats, order: int, sampled: Sampled) -> ResolvedParts:
    """Return parts whose integrals of a field, by a rule exact to a degree, are those of halves.

    Parameters
    ----------
    corners
        (k, n, 2) segments (n = 2) or triangles (n = 3).
    order
        Degree of the rule.
    sampled
        The field.
    """
    share = EDGE_SHARE if corners.shape[1] == 2 else VOLUME_SHARE
    owner = np.arange(len(corners))
    error, size = _compared(corners, order, sampled)
    total, kept, more = float(size.sum()), list[tuple[Floats, Ints]](), 0
    for _ in range(MOST_HALVINGS):
        wrong = error > share * total
        more += int(wrong.sum())
        if not wrong.any() or more > MOST_PARTS:
            break
        kept.append((corners[~wrong], owner[~wrong]))
        corners, owner = _halves(corners[wrong]), np.repeat(owner[wrong], _NUMBER[corners.shape[1]])
        error, _ = _compared(corners, order, sampled)
    kept.append((corners, owner))
    left = float(error.sum())
    found, owners = (np.concatenate(some) for some in zip(*kept, strict=True))
    sorted_by = np.argsort(owners, kind="stable")
    return ResolvedParts(found[sorted_by], owners[sorted_by], left / total if total else 0.0)


def cut_at(corners: Floats, places: Floats) -> tuple[Floats, Ints]:
    """Return parts of segments (k, 2, 2) between places (k, n) along each, and their segments.

    Places count from 0 to 1; those that are not within are left out.
    """
    within = np.where((places > 0) & (places < 1), places, np.nan)
    ends = np.zeros((len(corners), 1))
    ordered = np.sort(np.concatenate([ends, within, ends + 1], axis=1), axis=1)
    owner, number = np.nonzero(np.diff(ordered, axis=1) > NO_PART)
    start, way = corners[owner, 0], corners[owner, 1] - corners[owner, 0]
    parts = [start + ordered[owner, number + i, None] * way for i in (0, 1)]
    return np.stack(parts, axis=1), owner


def unresolved(corners: Floats, order: int, sampled: Sampled) -> float:
    """Return what integrals on parts may be off by, over that of the size of a field."""
    error, size = _compared(corners, order, sampled)
    return float(error.sum() / size.sum()) if size.any() else 0.0


def rule(corners: Floats, order: int) -> tuple[Floats, Floats]:
    """Return points (k, q, 2) and weights (k, q) on segments or triangles, exact to a degree."""
    if corners.shape[1] == 2:
        return segment_rule(corners[:, 0], corners[:, 1], order)
    barycentric, weights = gauss.triangle(order)
    return np.matmul(barycentric, corners), np.outer(np.abs(triangle_areas(corners)), weights)


def _halves(corners: Floats) -> Floats:
    """Return the two halves of segments, or the four triangles between middles of sides."""
    if corners.shape[1] == 2:
        a, b = np.moveaxis(corners, 1, 0)
        m = (a + b) / 2
        parts = [[a, m], [m, b]]
    else:
        a, b, c = np.moveaxis(corners, 1, 0)
        m, n, o = (a + b) / 2, (b + c) / 2, (c + a) / 2
        parts = [[a, m, o], [m, b, n], [o, n, c], [m, n, o]]
    made = np.stack([np.stack(part, axis=1) for part in parts], axis=1)
    return made.reshape(-1, *corners.shape[1:])


def _compared(corners: Floats, order: int, sampled: Sampled) -> tuple[Floats, Floats]:
    """Return the errors of integrals on parts (k,), by those of their halves, and sizes (k,)."""
    found = [
        _of_some(corners[first : first + AT_ONCE], order, sampled)
        for first in range(0, len(corners), AT_ONCE)
    ]
    return tuple(np.concatenate(some) for some in zip(*found, strict=True))  # type: ignore[return-value]


def _of_some(corners: Floats, order: int, sampled: Sampled) -> tuple[Floats, Floats]:
    about = corners.mean(axis=1)
    extent = np.abs(corners - about[:, None]).max(axis=(1, 2))
    halves = corners
    for _ in range(LOOK[corners.shape[1]]):
        halves = _halves(halves)
    whole, _ = _moments(corners, about, extent, order, sampled)
    fine, size = _moments(halves, about, extent, order, sampled)
    return np.abs(whole - fine).max(axis=(1, 2)), size


def _moments(
    corners: Floats, about: Floats, extent: Floats, order: int, sampled: Sampled
) -> tuple[Floats, Floats]:
    """Return integrals (k, 3, c) of a field, and times x and y about k places, and sizes (k,)."""
    points, weights = (
        part.reshape(len(about), -1, *part.shape[2:]) for part in rule(corners, order)
    )
    values = sampled(points.reshape(-1, 2)).reshape(*weights.shape, -1)
    from_middle = (points - about[:, None]) / extent[:, None, None]
    tests = np.concatenate([np.ones((*weights.shape, 1)), from_middle], axis=2)
    found = np.einsum("kq,kqi,kqc->kic", weights, tests, values)
    return found, np.einsum("kq,kqc->kc", weights, np.abs(values)).max(axis=1)
