"""Identities of pairs as single numbers, made in one place: vertex and edge, or two of a kind."""

import numpy as np

from integration.arrays import Ints
from nmm.contact.detection.surface import Surface


def pair_key(surface: Surface, vertex: Ints, edge: Ints) -> Ints:
    """Identity (m,) of pairs of a vertex and an edge: ``vertex * n + edge``."""
    return vertex * len(surface) + edge


def unordered_key(one: Ints, other: Ints, n: int) -> Ints:
    """Identity (m,) of pairs of two edges, or two bodies, of ``n`` in all, in either order."""
    return np.minimum(one, other) * n + np.maximum(one, other)
