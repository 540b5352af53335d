"""Contact points on new edges that continue those on old ones, when a model has changed.

Edges are numbered anew, and other cells divide them otherwise. What lasts is where a contact is on
the material: the two bodies, and its place on each in the reference configuration. A new point
continues the nearest old one between the same bodies, or those that they come from. Where both
coincide it takes over all that is known; elsewhere the forces of the old points are divided among
those that continue them, by length, and springs are stretched as these forces ask.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from covers.approximation.manifold import Manifold
from covers.change.parentage import Parentage
from integration.arrays import Bools, Floats, Ints
from nmm.contact.detection.surface import unordered_key
from nmm.contact.detection.tolerances import SAME_PLACE
from nmm.contact.points.contact_points import TIED, ContactPoints, concatenate
from nmm.contact.points.joint_book import JointBook, given_up


@dataclass(frozen=True)
class PointHeirs:
    """Which old contact points new ones continue.

    Attributes
    ----------
    parent, child
        The nearest old point of each new one, and the nearest new one of each old one; -1 without
        any between the same bodies.
    same
        (m,) new points that are where their parents are, one for one.
    """

    parent: Ints
    child: Ints
    same: Bools

    def only_same(self, chosen: Bools) -> "PointHeirs":
        """Return the heirs but for those of ``chosen`` (m,) that lie beside their parents.

        What a crack has grown by continues nothing, however near its old end is.
        """
        beside = chosen & ~self.same
        if not beside.any():
            return self
        lost = beside[np.maximum(self.child, 0)] & (self.child >= 0)
        return PointHeirs(
            np.where(beside, -1, self.parent), np.where(lost, -1, self.child), self.same
        )

    def shared(self, values: Floats, length: Floats) -> Floats:
        """Divide sums (k,) of the old points among the new ones (m,) by ``length`` (m,)."""
        found, known = np.zeros(len(self.parent)), self.parent >= 0
        weight = np.where(length > 0, length, 1.0)
        total = np.bincount(self.parent[known], weight[known], minlength=len(values))
        parent = self.parent[known]
        found[known] = values[parent] * weight[known] / total[parent]
        orphans = np.flatnonzero((total == 0) & (self.child >= 0))
        np.add.at(found, self.child[orphans], values[orphans])
        return found

    def kept(self, values: Floats | Ints, fallback: Floats | Ints) -> Any:
        """Values (m,) of the parents; of ``fallback`` where there are none."""
        if not len(values):
            return fallback
        return np.where(self.parent >= 0, values[np.maximum(self.parent, 0)], fallback)


def heirs(kin: Parentage, new: ContactPoints, old: ContactPoints) -> PointHeirs:
    """Find the nearest points between the same bodies, or bodies that come from them."""
    from scipy.spatial import KDTree

    every = np.arange(kin.old.n_bodies)
    pair_new, place_new = _places(kin.new, new, kin.bodies.main, len(every))
    pair_old, place_old = _places(kin.old, old, every, len(every))
    size = kin.new.elements.extent
    if not len(pair_new) or not len(pair_old):
        none = np.full(len(pair_new), -1), np.full(len(pair_old), -1)
        return PointHeirs(*none, np.zeros(len(pair_new), dtype=bool))
    # Pairs of bodies lie further apart than any two points of one pair.
    number = np.unique(np.concatenate([pair_new, pair_old]), return_inverse=True)[1].ravel()
    apart = 10 * size * number[:, None]
    of_new = np.hstack([place_new, apart[: len(pair_new)]])
    of_old = np.hstack([place_old, apart[len(pair_new) :]])
    far, parent = KDTree(of_old).query(of_new, distance_upper_bound=5 * size)
    _, child = KDTree(of_new).query(of_old, distance_upper_bound=5 * size)
    parent, child = (
        np.where(found < n, found, -1) for found, n in ((parent, len(of_old)), (child, len(of_new)))
    )
    known = parent >= 0
    same = (
        known
        & (far <= SAME_PLACE * size)
        & (child[np.maximum(parent, 0)] == np.arange(len(parent)))
    )
    return PointHeirs(parent, child, same)


def continued(
    new: ContactPoints, old: ContactPoints, line: PointHeirs, springs: tuple[Floats, Floats] | None
) -> ContactPoints:
    """Return found points with what the old ones leave them.

    ``springs`` are the normal and shear stiffness (m,) of the new points (N/m) as long as materials
    are what they were; None where contact has none.
    """
    measured = new.distance
    normal, shear = (
        line.shared(getattr(old, name), new.length) for name in ("normal_force", "shear_force")
    )
    gap, slip = new.gap, line.kept(old.slip, new.slip)
    if springs is not None:
        stiff, soft = springs
        pressed = normal < 0
        gap = np.where(pressed, normal / np.where(pressed, stiff, 1.0), gap)
        slip = np.where(line.same, slip, shear / np.where(soft > 0, soft, 1.0))
    gap = np.where(line.same, line.kept(old.gap, gap), gap)
    most = np.maximum(line.kept(old.reference, np.zeros_like(gap)), 0.0)
    reference = np.minimum(measured - gap, most)
    return replace(
        new,
        gap=measured - reference,
        reference=reference,
        slip=slip,
        state=line.kept(old.state, new.state).astype(new.state.dtype),
        history=new.inherited(old, line.parent),
        normal_force=normal,
        shear_force=shear,
    )


def continued_joints(new: JointBook, old: JointBook, line: PointHeirs) -> tuple[JointBook, Bools]:
    """Return the book of joints with damage and slip of the old one; and which points are new.

    ``line`` is of ``new.points`` and of `known_joints` of the old one: joints that were given up
    stay given up.
    """
    was, p = known_joints(old), new.points
    history = p.inherited(was, line.parent)
    if TIED in history:  # how firmly terms hold what turns is of the new model
        history[TIED] = np.where(history[TIED] > 0, p.history[TIED], 0.0)
    # Bonds that consistent terms held and hold no longer keep the springs that followed.
    released = p.tied & ~replace(p, history=history).tied
    stiff = p.length * line.kept(was.spring_factor / was.length, p.spring_factor / p.length)
    points = replace(
        p,
        gap=line.kept(was.gap, p.gap),
        slip=line.kept(was.slip, p.slip),
        spring_factor=np.where(released, stiff, p.spring_factor),
        state=line.kept(was.state, p.state).astype(p.state.dtype),
        reference=line.kept(was.reference, p.reference),
        history=history,
        normal_force=line.shared(was.normal_force, p.length),
        shear_force=line.shared(was.shear_force, p.length),
    )
    gone = line.parent >= len(old.points)
    last = line.parent >= len(was) - len(old.left)
    book = replace(
        new,
        points=points.take(~gone),
        joint=new.joint[~gone],
        lost=given_up(points.take(gone)),
        left=points.take(last),
    )
    return book, (line.parent < 0)[~gone]


def placed(book: JointBook, now: ContactPoints, fresh: Bools) -> JointBook:
    """Return the book with bonds that are ``fresh`` (m,) free of stress as they stand ``now``."""
    held = fresh & now.bonded
    history = book.points.history
    points = replace(
        book.points,
        reference=np.where(held, now.gap, book.points.reference),
        history={**history, "plastic_slip": np.where(held, now.slip, history["plastic_slip"])},
    )
    return replace(book, points=points)


def known_joints(book: JointBook) -> ContactPoints:
    """Points of joints that are followed, then those that were given up, the last ones last."""
    earlier = book.lost.take(np.arange(len(book.lost) - len(book.left)))
    return concatenate([book.points, earlier, book.left])


def within_one(kin: Parentage, points: ContactPoints) -> Bools:
    """Which points (m,) of the new model lie between parts of one old body."""
    parent = kin.bodies.main[kin.new.boundary.body]
    one, other = parent[points.edge_a], parent[points.edge_b]
    return np.asarray((one == other) & (one >= 0))


def _places(
    manifold: Manifold, points: ContactPoints, named: Ints, count: int
) -> tuple[Ints, Floats]:
    """Pair (m,) of bodies, and places (m, 4) on the lower and the higher of them.

    ``named`` (B,) are the numbers of the bodies, of which there are ``count``; those of bodies that
    come from none are below zero, and make no pair.
    """
    edges = manifold.boundary
    one, two = (named[edges.body[edge]] for edge, _ in points.sides)
    at_one, at_two = (edges.at(*side) for side in points.sides)
    swap = one > two
    place = np.where(swap[:, None], np.hstack([at_two, at_one]), np.hstack([at_one, at_two]))
    pair = unordered_key(one, two, count)
    return np.where(np.minimum(one, two) >= 0, pair, -1), place
