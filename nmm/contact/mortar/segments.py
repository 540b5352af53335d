"""Contact over whole faces: what two edges press on each other where they run side by side.

The search finds corners before edges. Where two edges face each other within the angle of the
search, those corners are the ends of the *overlap* of the two edges, and a pressure on it acts at
the points of a Lobatto rule: two that integrate the linear traces of linear fields, three or four
for fields that bend. Points of neighbouring overlaps that are one corner are one contact, whose
length is the sum of its shares. Thus a uniform pressure is in balance at every choice of covers on
either side (the patch test of Taylor and Papadopoulos 1991; El-Abbasi and Bathe 2001 for
integration over the overlaps), and a body that tilts still turns about its corner.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import cross, dot
from nmm.contact.detection.contacts import (
    FACE,
    VERTEX_EDGE,
    VERTEX_VERTEX,
    Contacts,
    FaceContacts,
    joined,
)
from nmm.contact.detection.joints import between, interval
from nmm.contact.detection.measures import rules_of
from nmm.contact.detection.surface import Surface, pair_key, unordered_key
from nmm.contact.detection.tolerances import ANGLE, FACE_WALK, KINK, SAME_POINT

# Nodes in [0, 1] and weights of Lobatto's rules: exact to degree 1, 3 and 5.
LOBATTO = {
    2: ((0.0, 1.0), (1 / 2, 1 / 2)),
    3: ((0.0, 0.5, 1.0), (1 / 6, 4 / 6, 1 / 6)),
    4: (
        (0.0, 0.5 - 0.5 / np.sqrt(5), 0.5 + 0.5 / np.sqrt(5), 1.0),
        (1 / 12, 5 / 12, 5 / 12, 1 / 12),
    ),
}


@dataclass(frozen=True, eq=False)
class Overlaps:
    """Mortar segments: along which two edges face each other.

    Attributes
    ----------
    a, b
        (k,) edges, that of the body with the lower number first.
    on_a, on_b
        (k, 2) ends as fractions of either edge; those on b fall as those on a rise.
    length
        (k,) m.
    """

    a: Ints
    b: Ints
    on_a: Floats
    on_b: Floats
    length: Floats


def face_points(manifold: Manifold, wanted: str, conserves: bool = False) -> int:
    """Points an overlap that integrate a uniform pressure on the traces of fields exactly.

    0 where corners carry contact: ``wanted`` is "vertices", or "auto" and every block has covers of
    its own, or springs are to keep energy (``conserves``): the stiffness of segments changes as
    bodies slide, with no work that pays for it. Edges of meshes are short and many.
    """
    if wanted == "vertices" or (wanted == "auto" and (conserves or not manifold.shared_covers)):
        return 0
    degree = manifold.trace_degree
    if degree is None:
        return max(LOBATTO)
    return int(np.clip((max(degree, 1) + 4) // 2, 2, max(LOBATTO)))


def faced(
    surface: Surface,
    found: Contacts,
    points: int = 2,
    joints: Ints | None = None,
    whole: bool = False,
) -> FaceContacts:
    """Return contacts with those at overlaps of edges replaced by the points of the overlaps.

    Parameters
    ----------
    surface, found
        Where the edges are, and what the search found.
    points
        Points an overlap: a key of `LOBATTO`.
    joints
        Pairs of edges, ``a * n + b`` with ``a < b``, whose overlaps something else carries.
    whole
        Whether faces count as far as they go on side by side, and not as far as the search found
        corners: a mean over a part of a face must not depend on the reach of the search.
    """
    n = max(len(surface), 1)
    pairs, own = _edge_pairs(surface, found)
    overlaps, is_overlap = _overlaps(surface, *np.divmod(pairs, n), joints)
    for _ in range(FACE_WALK if whole else 0):  # neighbours of all overlaps at once
        more = np.setdiff1d(_beside(surface, overlaps), pairs)
        if not len(more):
            break
        pairs = np.union1d(pairs, more)
        overlaps, is_overlap = _overlaps(surface, *np.divmod(pairs, n), joints)
    replaced = np.isin(own, pairs[is_overlap]).any(axis=0)
    rest = found.take(np.flatnonzero(~replaced))
    zero = np.zeros(len(rest))
    parts = [FaceContacts(**vars(rest), parameter_a=zero, length=zero)]
    if len(overlaps.a):
        parts += [_ends(surface, overlaps, points), _inside(surface, overlaps, points)]
    return joined(parts)


def _edge_pairs(surface: Surface, found: Contacts) -> tuple[Ints, Ints]:
    """Pairs of edges that may overlap, sorted, and those (4, m) that hold each contact.

    A corner on a corner stands for all edges that end there, whichever of them the search named.
    In a kink it stands for the one named: each of the two edges there bounds its way.
    """
    n = len(surface)
    v, e = found.vertex, found.edge
    before = surface.previous[v]

    corner = found.corner
    across = np.where(corner == e, surface.previous[corner], corner)
    other = np.where(found.kind == VERTEX_VERTEX, across, e)
    ends = ((v, e), (before, e), (v, other), (before, other))
    own = np.stack([unordered_key(one, facing, n) for one, facing in ends])
    arriving, leaving = surface.direction[surface.previous[corner]], surface.direction[corner]
    kink = (cross(arriving, leaving) < 0.0) & (dot(arriving, leaving) < np.cos(KINK))
    return np.unique(own), np.where(kink, np.tile(own[:2], (2, 1)), own)


def _beside(surface: Surface, overlaps: Overlaps) -> Ints:
    """Pairs of edges where faces go on beyond overlaps."""
    n, a, b = len(surface), overlaps.a, overlaps.b
    after, before = surface.next, surface.previous
    one = np.concatenate([a, a, after[a], before[a], after[a], before[a]])
    other = np.concatenate([after[b], before[b], b, b, before[b], after[b]])
    return np.unique(unordered_key(one, other, n))


def _overlaps(surface: Surface, a: Ints, b: Ints, joints: Ints | None) -> tuple[Overlaps, Bools]:
    """Overlaps of pairs of edges, and which pairs have one."""
    size = max(SAME_POINT * float(surface.length.mean()), 4 * rules_of(surface, 0.0).rounding)
    opposite = dot(surface.direction[a], surface.direction[b]) <= -np.cos(ANGLE)
    if joints is not None:
        opposite &= ~np.isin(a * len(surface) + b, joints)
    rows = np.flatnonzero(opposite)
    swap = surface.body[a] > surface.body[b]
    a, b = np.where(swap, b, a), np.where(swap, a, b)
    on_a, on_b = interval(surface, a[rows], b[rows], size)
    length = (on_a[:, 1] - on_a[:, 0]) * surface.length[a[rows]]
    length = (length + (on_b[:, 0] - on_b[:, 1]) * surface.length[b[rows]]) / 2
    long = length > size
    rows = rows[long]
    has = np.zeros(len(a), dtype=bool)
    has[rows] = True
    return Overlaps(a[rows], b[rows], on_a[long], on_b[long], length[long]), has


def _ends(surface: Surface, overlaps: Overlaps, points: int) -> FaceContacts:
    """Points at the ends of overlaps: a corner of one edge before the other edge."""
    a, b, on_a, on_b = overlaps.a, overlaps.b, overlaps.on_a, overlaps.on_b
    corner_a = np.stack([a, surface.next[a]], axis=1)
    corner_b = np.stack([surface.next[b], b], axis=1)
    at_a, at_b = on_a == [0.0, 1.0], on_b == [1.0, 0.0]
    vertex = np.where(at_a, corner_a, corner_b).ravel()
    edge = np.where(at_a, b[:, None], a[:, None]).ravel()
    parameter = np.where(at_a, on_b, on_a).ravel()
    kind = np.where(at_a & at_b, VERTEX_VERTEX, VERTEX_EDGE).ravel()
    share = LOBATTO[points][1][0] * np.repeat(overlaps.length, 2)

    # A corner before a corner of an even face is one contact, with the edge that starts there.
    corner = np.where(at_a, corner_b, corner_a).ravel()
    even = (at_a & at_b).ravel() & _even(surface, corner)
    edge, parameter = np.where(even, corner, edge), np.where(even, 0.0, parameter)
    keys = pair_key(surface, vertex, edge)
    key, first, which = np.unique(keys, return_index=True, return_inverse=True)
    length = np.asarray(np.bincount(which, share, len(first)), dtype=float)
    v, e, t = vertex[first], edge[first], parameter[first]
    return _measured(
        surface, (v, np.zeros(len(v))), (e, t), surface.normal[e], kind[first], key, length
    )


def _even(surface: Surface, corner: Ints) -> Bools:
    """Whether the edges that meet at corners (m,) go on in one direction."""
    turn = dot(surface.direction[surface.previous[corner]], surface.direction[corner])
    return np.asarray(turn >= np.cos(ANGLE))


def _inside(surface: Surface, overlaps: Overlaps, points: int) -> FaceContacts:
    """Points inside overlaps; the key counts them after all pairs of a vertex and an edge."""
    places, weights = (np.array(part[1:-1]) for part in LOBATTO[points])
    inner, n = len(places), len(surface)
    a, b = np.repeat(overlaps.a, inner), np.repeat(overlaps.b, inner)
    s, t = (
        (on[:, :1] + places * (on[:, 1:] - on[:, :1])).ravel()
        for on in (overlaps.on_a, overlaps.on_b)
    )
    which = np.tile(np.arange(inner), len(overlaps.a))
    key = n * n + (a * n + b) * 2 + which
    length = (weights * overlaps.length[:, None]).ravel()
    normal = between(surface, a, b)
    return _measured(surface, (a, s), (b, t), normal, np.full(len(a), FACE), key, length)


def _measured(
    surface: Surface,
    side_a: tuple[Ints, Floats],
    side_b: tuple[Ints, Floats],
    normal: Floats,
    kind: Ints,
    key: Ints,
    length: Floats,
) -> FaceContacts:
    """Contacts of two places, with gaps where the surface is."""
    (v, s), (e, t) = side_a, side_b
    apart = surface.at(v, s) - surface.at(e, t)
    return FaceContacts(
        vertex=v,
        edge=e,
        parameter=t,
        normal=normal,
        gap=dot(apart, normal),
        kind=kind,
        key=key,
        body=surface.body[e],
        corner=np.where(t > 0.5, surface.next[e], e),
        parameter_a=s,
        length=length,
    )
