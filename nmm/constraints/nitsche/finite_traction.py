"""Tractions on held edges of bodies that bend by any angle, and how they change.

On an edge with the normal ``N`` as it was the traction is ``P N`` of the first Piola-Kirchhoff
stress, a function of the gradient there; its slope is the tangent of the law, the turn of the
stress included. Slivers take the traction of a larger neighbour (`donors`). A ghost term would hold
what turns within a cell: it makes the end of an elastica on splines rise by 1.3 % less.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Floats, Ints
from integration.contraction import contract
from nmm.assembly.finite_strain.finite_matter import FiniteMatter
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.stress_points import gradients
from nmm.assembly.tractions.average import direct_modulus
from nmm.assembly.tractions.donors import donors, traction_rows
from nmm.assembly.tractions.element_bounds import element_bounds
from nmm.constraints.imposition import Method

# Multiples of the least penalty with which the form is positive where nothing has moved: twice that
# of linear matter, for matter that is five times as stiff where it is strained.
SAFETY_FINITE = 10.0


@dataclass(frozen=True)
class FiniteTraction:
    """Matter beside the points of an edge.

    Attributes
    ----------
    matter
        Asked at the points (m, 2), which are not its own.
    points
        (m, 2) as they were (m).
    law
        (m,) the law of each.
    unknowns, rows
        (m, L) and (m, 4, L) of the gradients (xx, xy, yx, yy).
    normal
        (m, 2) out of the body, as it was.
    """

    matter: FiniteMatter
    points: Floats
    law: Ints
    unknowns: Ints
    rows: Floats
    normal: Floats

    @classmethod
    def of(cls, model: Model, place: Place) -> Self:
        """Return that of a model's place on edges."""
        assert place.normal is not None
        assert model.law is not None
        served = donors(model, place.elements)
        unknowns, rows = model.manifold.gradient_rows(served, place.position)
        matter, law = model.finite_matter, model.law[served]
        return cls(matter, place.position, law, unknowns, gradients(rows), place.normal)

    def traction(self, deformation: Floats) -> Floats:
        """Return tractions (m, 2) on the edge as it was, in global axes (Pa)."""
        stress = self.matter.asked(self._gradient(deformation), self.points, self.law).stress
        return contract("mcd,md->mc", stress.reshape(-1, 2, 2), self.normal)

    def slopes(self, deformation: Floats) -> Floats:
        """Return their slopes (m, 2, L) by the unknowns."""
        found = self.matter.asked(self._gradient(deformation), self.points, self.law)
        change = np.asarray(found.tangent @ self.rows)
        change = change.reshape(len(change), 2, 2, change.shape[2])
        return contract("mcdl,md->mcl", change, self.normal)

    def _gradient(self, deformation: Floats) -> Floats:
        return contract("mil,ml->mi", self.rows, deformation[self.unknowns])


def finite_penalty(model: Model, place: Place, area: Floats, method: Method) -> Floats:
    """Return Nitsche's penalty (m,) at points of edges that stand for an ``area`` (m,) each."""
    assert place.normal is not None
    if method.gamma is not None and method.size is not None:
        return np.asarray(method.gamma * direct_modulus(model)[place.elements] / method.size)
    served = donors(model, place.elements)
    _, rows = traction_rows(model, served, place.position, place.normal)
    return np.asarray(SAFETY_FINITE * element_bounds(model, [served], [rows], area)[0])
