"""Contact points that search finds, from step to step: what they keep of those they continue."""

from collections.abc import Callable
from typing import Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.contraction import contract, every
from nmm.contact.detection.face_contacts import FaceContacts
from nmm.contact.detection.narrow_phase import Contacts
from nmm.contact.detection.surface import Surface
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import BONDED, BROKEN, OPEN, StepAnswer
from nmm.frozen import with_parts
from nmm.interfaces.history import History

# From points to where their sides a are from their sides b (m, 2).
Apart = Callable[[ContactPoints], Floats]

# What a contact that goes on keeps.
CARRIED = ("slip", "state", "normal_force", "shear_force")


def searched_points(
    found: Contacts, interface: Ints, history: History, surface: Surface | None = None
) -> ContactPoints:
    """Return found contacts as points that remember what contacts without bond do at first.

    Those that stand for a stretch of a face are as stiff as that is long: as stiff as a vertex of
    the body with the shorter edges on ``surface`` when it is half of such an edge.
    """
    m = len(found.gap)
    zeros = np.zeros(m)
    length, parameter_a, factor = zeros, zeros, np.ones(m)
    if isinstance(found, FaceContacts) and surface is not None:
        length, parameter_a = found.length, found.parameter_a
        grain = np.minimum(surface.grain[found.vertex], surface.grain[found.edge])
        factor = np.where(length > 0, length / grain, 1.0)
    return ContactPoints.unloaded(
        edge_a=found.vertex,
        parameter_a=parameter_a,
        edge_b=found.edge,
        parameter_b=found.parameter,
        normal=found.normal,
        gap=found.gap,
        length=length,
        spring_factor=factor,
        interface=interface,
        key=found.key,
        state=np.full(m, int(OPEN)),
        history=history,
    )


def remember(new: ContactPoints, old: ContactPoints, predecessor: Ints) -> ContactPoints:
    """Return the new points with state, forces, slip and history of the old ones they continue.

    A point that goes on under another interface keeps no history.
    """
    if len(old) == len(new) and np.array_equal(predecessor, np.arange(len(new))):
        return with_parts(
            new, history=old.history, **{name: getattr(old, name) for name in CARRIED}
        )
    if not len(old):
        return new
    known = predecessor >= 0
    source = np.where(known, predecessor, 0)
    kept: dict[str, Any] = {
        name: np.where(known, getattr(old, name)[source], getattr(new, name)) for name in CARRIED
    }
    return with_parts(new, history=new.inherited(old, predecessor), **kept)


def pushing_on(
    new: ContactPoints, old: ContactPoints, predecessor: Ints, surface: Surface, lasting: Bools
) -> tuple[ContactPoints, Ints]:
    """Return new points with those that push as stiff as they were, inside faces also in place.

    Springs of stretches are as stiff as these are long, and points inside a stretch move with its
    ends. Both change as bodies turn and slide, with no work that pays for it. So a spring that
    pushes and is ``lasting`` (m,) is one of the material until it opens, and inside a face it
    continues (m,) nothing that was open.
    """
    source = np.where(predecessor >= 0, predecessor, 0)
    pushes = (predecessor >= 0) & ((old.gap < 0) | (old.normal_force != 0))[source] & lasting
    factor = np.where(pushes, old.spring_factor[source], new.spring_factor)
    if not np.array_equal(factor, new.spring_factor):
        new = with_parts(new, spring_factor=factor)
    within = new.parameter_a > 0
    predecessor = np.where(within & ~pushes & lasting, -1, predecessor)
    inside = np.flatnonzero(within & pushes & (old.key[source] == new.key))
    if not len(inside):
        return new, predecessor
    edges = new.edge_a[inside], new.edge_b[inside]
    last = old.parameter_a[source[inside]], old.parameter_b[source[inside]]
    # Both sides go half of the way that they have slid, and the gap is across the line between.
    middle = (surface.at(edges[0], last[0]) + surface.at(edges[1], last[1])) / 2
    on_a, on_b = (_foot(surface, edge, middle) for edge in edges)
    over = (np.minimum(on_a, on_b) >= 0) & (np.maximum(on_a, on_b) <= 1)
    return _placed(new, surface, inside[over], (on_a[over], on_b[over])), predecessor


def _foot(surface: Surface, edge: Ints, place: Floats) -> Floats:
    """Parameters (m,) on edges of the points nearest to places (m, 2)."""
    along = contract("mi,mi->m", place - surface.start[edge], surface.direction[edge])
    return np.asarray(along / surface.length[edge])


def _placed(
    points: ContactPoints, surface: Surface, which: Ints, parameters: tuple[Floats, Floats]
) -> ContactPoints:
    """Return points of which some are at other parameters on both sides."""
    on_a, on_b, gap = points.parameter_a.copy(), points.parameter_b.copy(), points.gap.copy()
    on_a[which], on_b[which] = parameters
    apart = surface.at(points.edge_a[which], on_a[which])
    apart -= surface.at(points.edge_b[which], on_b[which])
    gap[which] = contract("mi,mi->m", apart, points.normal[which])
    return with_parts(points, parameter_a=on_a, parameter_b=on_b, gap=gap)


def continues(old: Contacts | None, new: Contacts) -> bool:
    """Whether search has found the pairs of the last step, corners before edges alone."""
    if old is None or type(old) is not Contacts or type(new) is not Contacts:
        return False
    return len(old.key) == len(new.key) and bool(every(old.key == new.key))


def continued(old: ContactPoints, found: Contacts) -> ContactPoints:
    """Return the points of the last step where search finds them now, gaps as measured.

    All else are the same objects, which tells that nothing made of them alone has changed.
    """
    return with_parts(old, parameter_b=found.parameter, normal=found.normal, gap=found.gap)


def answered(points: ContactPoints, answer: StepAnswer, once_bonded: Bools) -> ContactPoints:
    """Return the points as an answer leaves them; ``once_bonded`` (m,) had a bond at the start."""
    parted = once_bonded & points.is_joint & (answer.state == OPEN)
    state = np.where(parted, int(BROKEN), answer.state)
    return with_parts(
        points,
        gap=answer.gap,
        slip=answer.slip,
        state=np.where(points.bonded, int(BONDED), state),
        normal_force=answer.normal_force,
        shear_force=answer.shear_force,
    )


def apart_on(surface: Surface, points: ContactPoints) -> Floats:
    """Where sides a of points are from sides b (m, 2), on the chords of the edges."""
    one, other = (surface.at(*side) for side in points.sides)
    return np.asarray(one - other)
