"""Joints: the stretches of boundary that two bodies share, and the points that stand for them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely
from numpy.polynomial.legendre import leggauss

from covers.concatenate import some_of
from integration.arrays import Bools, Floats, Ints
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import JOINT
from nmm.errors import FormulationError

# Where the points of a joint stand, and why: at the corners the bond opens where an open-close
# iteration looks; at two Gauss points a linear stress is exact.
_RULES = ("corners", "gauss")
_TWO = np.array([0.5 - 0.5 / np.sqrt(3.0), 0.5 + 0.5 / np.sqrt(3.0)])


@dataclass(frozen=True, eq=False)
class Joints:
    """Overlapping intervals of two opposite collinear edges, in the order of ``edge_a, edge_b``.

    Attributes
    ----------
    edge_a, edge_b
        (j,) the two edges, ``edge_a < edge_b``.
    start, end
        (j, 2) ends of the shared interval, ordered along edge a (m).
    parameter_a, parameter_b
        (j, 2) the same two ends as fractions of edge a and of edge b.
    normal
        (j, 2) half way between those of both edges, from side b to side a.
    """

    edge_a: Ints
    edge_b: Ints
    start: Floats
    end: Floats
    parameter_a: Floats
    parameter_b: Floats
    normal: Floats

    def __len__(self) -> int:
        return len(self.edge_a)

    def take(self, index: Ints | Bools) -> Joints:
        """Return some of the joints."""
        return some_of(self, index)

    @property
    def length(self) -> Floats:
        """(j,) lengths of the shared intervals (m)."""
        return np.asarray(np.hypot(*(self.end - self.start).T))


@dataclass(frozen=True, eq=False)
class JointPoints:
    """Points of joints, those of one after those of another.

    Attributes
    ----------
    joint
        (p,) joint of each point.
    edge_a, parameter_a, edge_b, parameter_b
        (p,) the point on either side as edge and fraction of it.
    position, normal
        (p, 2) where it is and the normal from side b to side a.
    gap
        (p,) distance of side a from side b along the normal (m): rounding, for joints that fit.
    length
        (p,) tributary length (m); together that of the joint.
    """

    joint: Ints
    edge_a: Ints
    parameter_a: Floats
    edge_b: Ints
    parameter_b: Floats
    position: Floats
    normal: Floats
    gap: Floats
    length: Floats

    def __len__(self) -> int:
        return len(self.joint)


def find_joints(surface: Surface, within_bodies: bool = False) -> Joints:
    """Intervals along which edges of two bodies run opposite to each other and coincide.

    Parameters
    ----------
    surface
        The edges.
    within_bodies
        Also pair edges of one body: the two faces of a crack.

    Notes
    -----
    The largest distance (m) between the two edges over the interval, and the length that an
    interval must exceed, are `JOINT` of the mean edge. The distance is measured at both ends of the
    interval, so the allowed angle shrinks with its length. Ends of edges within it of each other
    are taken as the same point.
    """
    tolerance = JOINT * float(surface.length.mean()) if len(surface) else 0.0
    a, b = _pairs(surface, tolerance)
    keep = np.einsum("ij,ij->i", surface.direction[a], surface.direction[b]) < 0.0
    if not within_bodies:
        keep &= surface.body[a] != surface.body[b]
    a, b = a[keep], b[keep]

    on_a, on_b = interval(surface, a, b, tolerance)
    at_a, at_b = _at(surface, a, on_a), _at(surface, b, on_b)
    apart = np.hypot(*np.moveaxis(at_a - at_b, -1, 0)).max(axis=1, initial=0.0)
    long = (on_a[:, 1] - on_a[:, 0]) * surface.length[a] > tolerance
    keep = long & (apart <= tolerance)
    a, b, on_a, on_b = a[keep], b[keep], on_a[keep], on_b[keep]
    middle = 0.5 * (at_a[keep] + at_b[keep])
    return Joints(a, b, middle[:, 0], middle[:, 1], on_a, on_b, between(surface, a, b))


def joint_points(
    surface: Surface,
    joints: Joints,
    joint_rule: Literal["corners", "gauss"] | str = "corners",
    count: int = 2,
) -> JointPoints:
    """Points of each joint, at its two corners or ``count`` Gauss points, on the surface as it is.

    Raises
    ------
    FormulationError
        Unknown name of the rule.
    """
    if joint_rule not in _RULES:
        raise FormulationError(
            f"contact.joint_points: {joint_rule!r}: expected one of {', '.join(_RULES)}: "
            "correct the name"
        )
    at, weight = np.array([0.0, 1.0]), np.array([0.5, 0.5])
    if joint_rule == "gauss":
        roots, weights = leggauss(count)
        at, weight = (_TWO if count == 2 else 0.5 + 0.5 * roots), 0.5 * weights
    joint = np.repeat(np.arange(len(joints)), len(at))
    a, b = joints.edge_a[joint], joints.edge_b[joint]
    s, t = (
        (p[:, :1] * (1.0 - at) + p[:, 1:] * at).ravel()
        for p in (joints.parameter_a, joints.parameter_b)
    )
    side_a, side_b = _at(surface, a, s[:, None])[:, 0], _at(surface, b, t[:, None])[:, 0]
    normal = between(surface, a, b)
    return JointPoints(
        joint=joint,
        edge_a=a,
        parameter_a=s,
        edge_b=b,
        parameter_b=t,
        position=0.5 * (side_a + side_b),
        normal=normal,
        gap=np.einsum("ij,ij->i", side_a - side_b, normal),
        length=np.outer(joints.length, weight).ravel(),
    )


def joint_ends(surface: Surface, joints: Joints) -> tuple[Ints, Ints, Ints]:
    """Vertex-edge pairs that stand at an end of a joint, with the joint: (vertex, edge, joint).

    Contact search reports them besides the joint's own points: a step that lets the joint carry
    both drops contacts with these pairs. Where two vertices meet at the end, their pairs with both
    edges of each other count.
    """
    a, b = joints.edge_a, joints.edge_b
    after_a, after_b = surface.next[a], surface.next[b]
    start_a, end_a = joints.parameter_a[:, 0] == 0.0, joints.parameter_a[:, 1] == 1.0
    end_b, start_b = joints.parameter_b[:, 0] == 1.0, joints.parameter_b[:, 1] == 0.0
    found = (
        (a, b, start_a),
        (after_a, b, end_a),
        (b, a, start_b),
        (after_b, a, end_b),
        (a, after_b, start_a & end_b),
        (after_b, surface.previous[a], start_a & end_b),
        (after_a, surface.previous[b], end_a & start_b),
        (b, after_a, end_a & start_b),
    )
    vertex = np.concatenate([vertex[there] for vertex, _, there in found])
    edge = np.concatenate([edge[there] for _, edge, there in found])
    return vertex, edge, np.concatenate([np.flatnonzero(there) for _, _, there in found])


def _pairs(surface: Surface, tolerance: float) -> tuple[Ints, Ints]:
    """Pairs a < b of edges whose boxes come within the tolerance of each other."""
    low = np.minimum(surface.start, surface.end) - 0.5 * tolerance
    high = np.maximum(surface.start, surface.end) + 0.5 * tolerance
    boxes = np.atleast_1d(np.asarray(shapely.box(*low.T, *high.T), dtype=object))
    a, b = shapely.STRtree(boxes).query(boxes)
    once = a < b
    a, b = a[once], b[once]
    order = np.lexsort((b, a))
    return a[order].astype(np.int64), b[order].astype(np.int64)


def interval(surface: Surface, a: Ints, b: Ints, tolerance: float) -> tuple[Floats, Floats]:
    """Parameters (m, 2) of the overlap's ends on a and on b; those on b fall as those on a rise.

    Ends of the two edges within the tolerance (m) of each other are one point. What lies before
    what is seen along the direction half way between both: neither edge is the first.
    """
    middle = surface.direction[a] - surface.direction[b]
    middle /= np.hypot(*middle.T)[:, None]
    on_a = np.empty((len(a), 2))
    on_b = np.empty((len(a), 2))
    for k, (near_b, near_a) in enumerate(
        ((surface.end, surface.start), (surface.start, surface.end))
    ):
        # End k of the overlap is the end of b that faces end k of a, or else the end of a itself.
        inward = 1.0 - 2.0 * k
        offset = near_b[b] - near_a[a]
        along = inward * np.einsum("ij,ij->i", offset, middle)
        same = np.abs(along) <= tolerance
        from_b = np.where(same | (along < 0.0), 0.0, along) / surface.length[a]
        from_a = np.where(same | (along > 0.0), 0.0, -along) / surface.length[b]
        on_a[:, k] = from_b if k == 0 else 1.0 - from_b
        on_b[:, k] = 1.0 - from_a if k == 0 else from_a
    return on_a, on_b


def between(surface: Surface, a: Ints, b: Ints) -> Floats:
    """Unit normals (m, 2) half way between those of two edges, out of b."""
    normal = surface.normal[b] - surface.normal[a]
    return np.asarray(normal / np.hypot(*normal.T)[:, None])


def _at(surface: Surface, edge: Ints, parameter: Floats) -> Floats:
    """Points (m, k, 2) at parameters (m, k); exact at both ends."""
    start, end = surface.start[edge][:, None], surface.end[edge][:, None]
    s = parameter[:, :, None]
    return np.where(s < 0.5, start + s * (end - start), end - (1.0 - s) * (end - start))
