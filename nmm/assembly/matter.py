"""Nonlinear material: forces and stiffness of elements from laws at their material points.

Only elements whose laws are not linear have such points; the stiffness of the others is one matrix.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Self

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints
from integration.sparse import csc_array
from nmm.assembly.kept import kept_of_object
from nmm.assembly.laws_at_points import INITIAL, STRESS, SWELLING, LawsAtPoints
from nmm.assembly.stress_points import StressPoints, nearest
from nmm.assembly.unresisted_strains import resisting
from nmm.materials.base import History, Law, Response
from nmm.solvers.unchecked import product

# Tangents that differ from the elastic one by less than this share are taken for elastic.
ROUNDED_TANGENT = 16 * float(np.finfo(float).eps)


@dataclass(frozen=True)
class Matter(LawsAtPoints):
    """Material points of elements whose laws are not linear.

    Attributes
    ----------
    points
        Q points.
    thickness
        m.
    rest
        Stiffness (n, n) of all other elements.
    """

    points: StressPoints
    thickness: float
    rest: csc_array

    flows: ClassVar[bool] = True
    """Whether matter may give way without end."""

    @classmethod
    def of(
        cls,
        manifold: Manifold,
        laws: Sequence[Law],
        law: Ints,
        plane: str,
        thickness: float,
        rest: csc_array,
        size: Floats | None = None,
    ) -> Self:
        """Return the points of a manifold whose elements (E,) have each a ``law``.

        ``size`` (E,) is that of their cells (m), where a law asks for it.

        Raises
        ------
        FormulationError
            A law that has no answer with cells of their size.
        """
        bent = [number for number, one in enumerate(laws) if not one.linear]
        points = StressPoints.of(manifold, np.isin(law, bent))
        own = np.searchsorted(bent, law[points.rule.owner])
        chosen = tuple(laws[number] for number in bent)
        elastic = np.array([one.stiffness(plane) for one in chosen])[own]
        sizes = None if size is None else size[points.rule.owner]
        for number, one in enumerate(chosen):  # a handful of laws
            if sizes is not None and one.sized:
                one.check_size(sizes[own == number])
        return cls(chosen, own, elastic, plane, sizes, points, thickness, rest)

    def update(
        self, deformation: Floats, history: History, step: float, before: Floats | None = None
    ) -> Response:
        """Return the response of all points to the unknowns (n,) at the end of a step (s).

        ``before`` (n,), of the iterate from which these were found, changes nothing here.

        The stress is that beyond the initial stress, and part of the new history.
        """
        return self.response(self.points.strain(deformation), history, step)

    def internal(self, deformation: Floats, history: History) -> Floats:
        """Return the internal force (n,) of an accepted state."""
        return self.force(deformation, history[STRESS])

    def mean_stress(self, deformation: Floats, history: History) -> tuple[Ints, Floats]:
        """Return the elements (k,) that have points and their mean stress (k, 3), without initial.

        In body axes (Pa).
        """
        return self.points.means(history[STRESS])

    def mean_across(self, deformation: Floats, history: History) -> tuple[Ints, Floats]:
        """Return the elements (k,) that have points and their mean stress across the plane (k,).

        All that their laws know of, the initial stress with it (Pa).
        """
        elements, means = self.points.means(self.across(history)[:, None])
        return elements, means[:, 0]

    def across_near(
        self, deformation: Floats, history: History, elements: Ints, points: Floats
    ) -> Floats:
        """Return the stress across (m,) of the nearest point; no number where laws are linear."""
        at = nearest(self.points.rule, elements, points)
        return np.where(at < 0, np.nan, self.across(history)[at])

    def force(self, deformation: Floats, stress: Floats) -> Floats:
        """Return the internal force (n,) of unknowns (n,) and of the stress (Q, 3) of points."""
        return product(self.rest, deformation) + self._summed(stress)

    @kept_of_object
    def _summed(self, stress: Floats) -> Floats:
        """Force (n,) of the last stress, at the end of a step and the start of the next one."""
        return self.thickness * self.points.force(stress)

    def stiffness(self, tangent: Floats, symmetric: bool = True) -> csc_array:
        """Return the tangent stiffness (n, n) of tangents (Q, 3, 3), or its symmetric part.

        It is the same object where matter is elastic, and resists all strains (`resisting`).
        """
        if tangent is self.elastic:
            return self.elastic_stiffness
        # One tangent of all points of one law is compared once.
        one = tangent[:1] if len(self.laws) == 1 and not tangent.strides[0] else tangent
        if symmetric:
            one = (one + np.swapaxes(one, 1, 2)) / 2
        elastic = self.elastic[: len(one)]
        if np.abs(one - elastic).max() <= ROUNDED_TANGENT * np.abs(elastic).max():
            return self.elastic_stiffness
        one = resisting(one, elastic)
        return self._stiffness(np.broadcast_to(one, tangent.shape), symmetric)

    @cached_property
    def elastic_stiffness(self) -> csc_array:
        """Elastic stiffness (n, n)."""
        return self._stiffness(self.elastic, symmetric=True)

    def _stiffness(self, tangent: Floats, symmetric: bool) -> csc_array:
        return csc_array(self.rest + self.thickness * self.points.matrix(tangent, symmetric))

    def energy(self, deformation: Floats, history: History) -> float:
        """Return the stored energy (J), but for what an initial stress counts by itself."""
        density, initial = self.energy_density(history), history.get(INITIAL)
        if initial is not None:
            strain = self.points.strain(deformation) + initial / 2
            density -= (self._initial(initial) * strain).sum(axis=1)
        stored = self.thickness * float(self.points.rule.weights @ density)
        return stored + float(deformation @ product(self.rest, deformation)) / 2

    def swollen(self, before: History, after: History) -> float:
        """Return the work (J) of the stress on what swells in a step, by the mean of both ends."""
        if SWELLING not in after:
            return 0.0
        more = after[SWELLING][:, 0] - before.get(SWELLING, np.zeros((len(self.law), 1)))[:, 0]
        mean = (self.pressing(before) + self.pressing(after)) / 2
        return self.thickness * float((self.points.rule.weights * mean) @ more)

    def missed(self, before: Floats, after: Floats) -> float:
        """Return what the mean force of both ends does beyond its work: nothing (J)."""
        return 0.0

    def stress_near(
        self, deformation: Floats, history: History, elements: Ints, points: Floats
    ) -> Floats:
        """Stress (m, 3) of the nearest point in elements (m,), beyond the initial stress.

        It is not a number in elements whose law is linear.
        """
        at = nearest(self.points.rule, elements, points)
        return np.where(at[:, None] < 0, np.nan, history[STRESS][at])
