"""The place that is nearest to nucleation, and the crack that nucleates there.

The utilisation of a place is the smaller of two ratios: largest principal stress to strength at the
place itself, and the ratio of the criterion along a line from it. The line lies in the plane on
which the largest principal value of its mean stress acts.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import cross
from integration.rules import PointRule
from nmm.assembly.model import Model
from nmm.fracture.acting_stress import StressField
from nmm.fracture.free_length import LIGAMENT, free_length
from nmm.fracture.nucleation.line_criterion import SHARES, OpeningLines
from nmm.fracture.nucleation.line_stress import LineStress
from nmm.fracture.nucleation.places import NucleationPlaces, outline
from nmm.fracture.nucleation.rule import NucleationRule
from nmm.geometry.geometry import Geometry
from nmm.materials.principal_stresses import PrincipalStresses

# Iterations on the direction of lines, and the turn (rad) below which a direction has converged:
# the mean stress across is stationary there.
DIRECTION_STEPS, CONVERGED_TURN = 4, 1e-3
# Relative difference below which ratios are equal: in uniform stress the place in the middle
# counts.
EVEN = 1e-6
# Places whose lines are evaluated together.
CHUNK = 128


@dataclass(frozen=True)
class Nucleus:
    """The place that is nearest to nucleation.

    Attributes
    ----------
    share
        Ratio of the criterion there: the crack nucleates at 1.
    point
        (2,) its place (m).
    way
        (2,) unit direction of the crack, from an edge inwards.
    body
        The body in which it lies.
    inside
        Whether it lies inside, not on an edge.
    length
        Of the crack (m); both ways from a place inside.
    """

    share: float
    point: Floats
    way: Floats
    body: int
    inside: bool
    length: float


@dataclass(frozen=True)
class Nuclei:
    """All places of a model at which cracks may nucleate by a rule."""

    model: Model
    rule: NucleationRule
    places: NucleationPlaces

    @classmethod
    def of(cls, model: Model, geometry: Geometry, rule: NucleationRule) -> "Nuclei":
        """Return the places of a model of a geometry."""
        return cls(
            model,
            rule,
            NucleationPlaces.of(
                model.cut, geometry, rule.inside_distance, rule.crack_distance, rule.critical_length
            ),
        )

    def nearest(self, stress: StressField) -> Nucleus | None:
        """Return the place of the largest ratio under a stress; None where there is no place.

        Places are evaluated in the order of the stress at each, which bounds their ratio.
        """
        places = self.places
        if not len(places):
            return None
        rule = PointRule(places.point, np.ones(len(places)), places.element)
        principal = PrincipalStresses.of(stress(rule))
        order = self._order(principal.larger)
        best: Nucleus | None = None
        for first in range(0, len(order), CHUNK):  # until no bound exceeds the best ratio
            rows = order[first : first + CHUNK]
            bound = float(principal.larger[rows].max()) / self.rule.strength
            if best is not None and bound <= best.share * (1 + EVEN):
                break
            found = self._best(stress, rows, principal)
            if found is not None and (best is None or found.share > best.share * (1 + EVEN)):
                best = found
        return best

    def largest(self, stress: StressField) -> float:
        """Largest ratio of stress to strength at any place, whether a line fits there or not."""
        places = self.places
        if not len(places):
            return 0.0
        rule = PointRule(places.point, np.ones(len(places)), places.element)
        return float(PrincipalStresses.of(stress(rule)).larger.max()) / self.rule.strength

    def _order(self, stress: Floats) -> Ints:
        """Places (k,) by decreasing stress; of equal ones those on edges first, from the middle."""
        level = _levels(stress)
        most = self.places.point[level == level.max()]
        middle = (most.min(axis=0) + most.max(axis=0)) / 2
        away = np.hypot(*(self.places.point - middle).T)
        return np.lexsort((away, self.places.inside, -level))

    def _best(
        self, stress: StressField, rows: Ints, principal: PrincipalStresses
    ) -> Nucleus | None:
        """Return the place of the largest ratio among ``rows`` (k,), the first of equal ones."""
        places = self.places.take(rows)
        inside, body = places.inside, self.model.manifold.element_body[places.element]
        way = _inwards(principal.plane[rows], places.inward)
        for _ in range(DIRECTION_STEPS):
            lines = OpeningLines(places.point, way, body, inside, places.notched)
            found = self.rule.criterion.evaluate(self._lines, stress, lines)
            last, known = way, found.known
            way = _inwards(PrincipalStresses.of(found.mean).plane, places.inward)
            turned = np.abs(cross(last, way))
            if float(turned[known].max(initial=0.0)) < CONVERGED_TURN:
                break
        known &= inside | self._ends_deep(places.point + found.length[:, None] * last)
        if not known.any():
            return None
        share = np.minimum(found.share, principal.larger[rows] / self.rule.strength)
        one = np.flatnonzero(known)[np.argmax(_levels(share[known]))]
        length = self.rule.crack_length or float(found.length[one])
        where = places.point[one], way[one], int(body[one]), bool(inside[one])
        return Nucleus(float(share[one]), *where, length)

    def _ends_deep(self, points: Floats) -> Bools:
        """Which ends (k, 2) of lines leave a ligament before the next edge."""
        near = LIGAMENT * self.rule.length
        return np.asarray(~shapely.dwithin(shapely.points(points), self._outline, near))

    def line_of(self, nucleus: Nucleus) -> Floats:
        """Return the polyline of the crack: (2, 2) from an edge, (3, 2) inside."""
        ahead, back = (self._end(nucleus, to * nucleus.way) for to in (1.0, -1.0))
        return np.array([*([back] if nucleus.inside else []), nucleus.point, ahead])

    def _end(self, nucleus: Nucleus, way: Floats) -> Floats:
        edges, one = self.model.cut.boundary, nucleus.point
        near = edges.body == nucleus.body
        whole = free_length(one, way, edges.start[near], edges.end[near], nucleus.length)
        return one + whole * way

    @property
    def fits(self) -> bool:
        """Whether any line from an edge stays in its body."""
        edges = self.places.take(~self.places.inside)
        inward = edges.inward / np.maximum(np.hypot(*edges.inward.T), 1e-300)[:, None]
        body = self.model.manifold.element_body[edges.element]
        ends = edges.point + self.rule.length * inward
        stays = self._lines.stays(edges.point, self.rule.length * inward, body, SHARES)
        return bool((stays & self._ends_deep(ends)).any())

    @cached_property
    def _lines(self) -> LineStress:
        return LineStress(self.model)

    @cached_property
    def _outline(self) -> shapely.MultiLineString:
        return outline(self.model.cut)


def _levels(stress: Floats) -> Floats:
    """Stresses (k,) rounded to steps of `EVEN` of the largest."""
    return np.round(stress / max(float(np.abs(stress).max()), 1e-300) / EVEN)


def _inwards(way: Floats, inward: Floats) -> Floats:
    """Return directions (k, 2), reversed where they lead out of the material."""
    out = np.einsum("ki,ki->k", way, inward) < 0
    return np.where(out[:, None], -way, way)
