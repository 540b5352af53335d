"""Which place is nearest to where a crack begins, and the crack that does.

At a place the criterion has reached the smaller of two shares: of the strength by the largest
principal stress there, and of what it takes by the stress along a line. The line runs in the plane
that the mean along it opens.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from integration.arrays import Bools, Floats, Ints
from integration.rules import PointRule
from nmm.assembly.model import Model
from nmm.fracture.acting_stress import StressOn
from nmm.fracture.clear_way import LIGAMENT, clear_length
from nmm.fracture.nucleation.line_stress import LineStress
from nmm.fracture.nucleation.places import NucleationPlaces, outline
from nmm.fracture.nucleation.reached import SHARES, OpeningLines
from nmm.fracture.nucleation.rule import NucleationRule
from nmm.fracture.principal import LargestPrincipal
from nmm.geometry.geometry import Geometry

# Times that lines are turned into the planes which their means open, and the turn (rad) that is
# left as it is: the mean across is stationary there.
TURNS, STILL = 4, 1e-3
# Shares that differ by less are one: of places in even stress the middle one counts.
EVEN = 1e-6
# Places whose lines are looked at together.
CHUNK = 128


@dataclass(frozen=True)
class Nucleus:
    """The place that is nearest to where a crack begins.

    Attributes
    ----------
    share
        Of what it takes that the criterion has reached there.
    point
        (2,) where it is (m).
    way
        (2,) direction of the crack, from an edge inwards.
    body
        In which it lies.
    inside
        Whether it is on no edge.
    length
        Of the crack (m), as long both ways inside.
    """

    share: float
    point: Floats
    way: Floats
    body: int
    inside: bool
    length: float


@dataclass(frozen=True)
class Nuclei:
    """All places of a model at which cracks may begin by a rule."""

    model: Model
    rule: NucleationRule
    places: NucleationPlaces

    @classmethod
    def of(cls, model: Model, geometry: Geometry, rule: NucleationRule) -> "Nuclei":
        """Return those of a model on a geometry."""
        return cls(
            model, rule, NucleationPlaces.of(model.cut, geometry, rule.deep, rule.away, rule.tough)
        )

    def nearest(self, stress: StressOn) -> Nucleus | None:
        """Return the place that has reached most of the strength under a stress; None without any.

        Places are looked at in the order of the stress at each, which no share exceeds.
        """
        places = self.places
        if not len(places):
            return None
        rule = PointRule(places.point, np.ones(len(places)), places.element)
        pulled = LargestPrincipal.of(stress(rule))
        order = self._order(pulled.size)
        best: Nucleus | None = None
        for first in range(0, len(order), CHUNK):  # until no stress is as large as the best mean
            rows = order[first : first + CHUNK]
            bound = float(pulled.size[rows].max()) / self.rule.strength
            if best is not None and bound <= best.share * (1 + EVEN):
                break
            found = self._best(stress, rows, pulled)
            if found is not None and (best is None or found.share > best.share * (1 + EVEN)):
                best = found
        return best

    def largest(self, stress: StressOn) -> float:
        """Largest share of the strength at any place, whatever lines fit there."""
        places = self.places
        if not len(places):
            return 0.0
        rule = PointRule(places.point, np.ones(len(places)), places.element)
        return float(LargestPrincipal.of(stress(rule)).size.max()) / self.rule.strength

    def _order(self, stress: Floats) -> Ints:
        """Places by falling stress (k,); of even ones those on edges first, then the middle one."""
        level = _levels(stress)
        most = self.places.point[level == level.max()]
        middle = (most.min(axis=0) + most.max(axis=0)) / 2
        away = np.hypot(*(self.places.point - middle).T)
        return np.lexsort((away, self.places.inside, -level))

    def _best(self, stress: StressOn, rows: Ints, pulled: LargestPrincipal) -> Nucleus | None:
        """Return the best of some places (k,), the first of even ones."""
        places = self.places.take(rows)
        inside, body = places.inside, self.model.manifold.element_body[places.element]
        way = _inwards(pulled.plane[rows], places.inward)
        for _ in range(TURNS):
            lines = OpeningLines(places.point, way, body, inside, places.notched)
            found = self.rule.criterion.reached(self._lines, stress, lines)
            last, known = way, found.known
            way = _inwards(LargestPrincipal.of(found.mean).plane, places.inward)
            turned = np.abs(last[:, 0] * way[:, 1] - last[:, 1] * way[:, 0])
            if float(turned[known].max(initial=0.0)) < STILL:
                break
        known &= inside | self._ends_deep(places.point + found.length[:, None] * last)
        if not known.any():
            return None
        share = np.minimum(found.share, pulled.size[rows] / self.rule.strength)
        one = np.flatnonzero(known)[np.argmax(_levels(share[known]))]
        length = self.rule.crack_length or float(found.length[one])
        where = places.point[one], way[one], int(body[one]), bool(inside[one])
        return Nucleus(float(share[one]), *where, length)

    def _ends_deep(self, points: Floats) -> Bools:
        """Which ends (k, 2) leave a ligament."""
        near = LIGAMENT * self.rule.length
        return np.asarray(~shapely.dwithin(shapely.points(points), self._outline, near))

    def laid(self, nucleus: Nucleus) -> Floats:
        """Return the polyline (2, 2) of the crack from an edge, or (3, 2) of one inside."""
        ahead, back = (self._end(nucleus, to * nucleus.way) for to in (1.0, -1.0))
        return np.array([*([back] if nucleus.inside else []), nucleus.point, ahead])

    def _end(self, nucleus: Nucleus, way: Floats) -> Floats:
        edges, one = self.model.cut.boundary, nucleus.point
        near = edges.body == nucleus.body
        whole = clear_length(one, way, edges.start[near], edges.end[near], nucleus.length)
        return one + whole * way

    @property
    def fits(self) -> bool:
        """Whether any line across an edge stays in its body."""
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
    """Stresses (k,) in steps of `EVEN` of the largest."""
    return np.round(stress / max(float(np.abs(stress).max()), 1e-300) / EVEN)


def _inwards(way: Floats, inward: Floats) -> Floats:
    """Return directions (k, 2), turned round where they lead out of the material."""
    out = np.einsum("ki,ki->k", way, inward) < 0
    return np.where(out[:, None], -way, way)
