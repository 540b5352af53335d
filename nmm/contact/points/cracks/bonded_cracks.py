"""Cracks whose faces hold together: which places of the material lie on them."""

from dataclasses import dataclass

import numpy as np
import shapely

from covers.approximation.manifold import Manifold
from integration.arrays import Bools, Floats
from nmm.contact.points.contact_points import ContactPoints
from nmm.errors import SceneError


@dataclass(frozen=True)
class BondedCracks:
    """Cracks that begin as whole bonds.

    Attributes
    ----------
    lines
        Polylines (n, 2) in the reference place (m).
    others
        Those of cracks beside them, whose faces are free though they part bodies.
    tolerance
        How far a cut may have moved them (m).
    """

    lines: tuple[Floats, ...] = ()
    others: tuple[Floats, ...] = ()
    tolerance: float = 0.0

    def __bool__(self) -> bool:
        return bool(self.lines)

    def hold(self, places: Floats) -> Bools:
        """Which places (m, 2) of the reference lie on them."""
        return self._on(self.lines, places)

    def part(self, places: Floats) -> Bools:
        """Which places (m, 2) of the reference lie on the others."""
        return self._on(self.others, places) & ~self.hold(places)

    def _on(self, lines: tuple[Floats, ...], places: Floats) -> Bools:
        if not lines:
            return np.zeros(len(places), dtype=bool)
        every = shapely.MultiLineString([line.tolist() for line in lines])
        return np.asarray(shapely.dwithin(shapely.points(places), every, self.tolerance))

    def points(self, manifold: Manifold, points: ContactPoints) -> Bools:
        """Which contact points (m,) lie on them."""
        return self.hold(manifold.boundary.at(points.edge_a, points.parameter_a))


def refuse_unbonded(places: Floats) -> None:
    """Refuse bonded cracks at places (k, 2) where the material has no bond with itself.

    Raises
    ------
    SceneError
        Naming the first.
    """
    if len(places):
        raise SceneError(
            f"[[cracks]] bonded at {places[0].tolist()}: the interface of the material there with "
            "itself holds nothing: expected bonded = true and a tensile_strength: add them to the "
            "interface between the two"
        )
