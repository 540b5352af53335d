"""Matter of finite strain: elastic laws asked at material points for what gradients do to them.

Nothing is remembered: stress is a function of the displacements from the start, which hold all of
the rotation (total Lagrangian). Forces are those of the first Piola-Kirchhoff stress
``P = F S`` on the gradients of the functions as they were, and tangents are their derivatives.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from scipy.sparse import csc_array

from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints
from nmm.assembly.finite_strain.conserving_stress import conserving_stress
from nmm.assembly.finite_strain.gradients import (
    green,
    kirchhoff,
    strain_rates,
    turning,
    volumes,
)
from nmm.assembly.stress_points import StressPoints, gradients, nearest
from nmm.errors import SolveError
from nmm.materials.base import FiniteResponse, History, Law, Response


@dataclass(frozen=True)
class FiniteMatter:
    """Material points of all elements, under finite strain.

    Attributes
    ----------
    laws
        All laws.
    law
        (Q,) the law of each point.
    points
        Q points, with gradients (xx, xy, yx, yy) of the displacement.
    plane, thickness
        "stress" or "strain"; m.
    """

    laws: tuple[Law, ...]
    law: Ints
    points: StressPoints
    plane: str
    thickness: float

    symmetric: ClassVar[bool] = True
    """Whether tangents are: there is an energy."""
    flows: ClassVar[bool] = False
    """Whether matter may give way without end."""

    softens: ClassVar[bool] = False
    """Whether it loses strength as it does."""

    @classmethod
    def of(
        cls, manifold: Manifold, laws: Sequence[Law], law: Ints, plane: str, thickness: float
    ) -> Self:
        """Return the points of a manifold whose elements (E,) have each a ``law``.

        Raises
        ------
        FormulationError
            A law that has no potential.
        """
        every = np.ones(len(manifold.elements), dtype=bool)
        points = StressPoints.of(manifold, every, gradients)
        found = cls(tuple(laws), law[points.rule.owner], points, plane, thickness)
        found._potential(np.zeros((len(found.law), 3)))
        return found

    @cached_property
    def elastic_stiffness(self) -> csc_array:
        """Stiffness (n, n) where nothing has moved."""
        return self.stiffness(self._at(np.zeros((len(self.law), 4))).tangent)

    def start(self) -> dict[str, Floats]:
        """Return what is remembered: nothing."""
        return {}

    def at_rest(self, history: History) -> None:
        """See `Matter.at_rest`: a strain has no rest."""

    def update(
        self, deformation: Floats, history: History, step: float, before: Floats | None = None
    ) -> Response:
        """Return first Piola-Kirchhoff stress (Q, 4) and tangent (Q, 4, 4) of unknowns (n,).

        With the iterate ``before`` (n,) it is the stress foreseen there that turns in the tangent.
        That of the trial itself is off by the square of the rotation, which slender bodies resist
        by far more than bending: iterations with it take steps as small as their thickness
        (Magisano, Leonetti and Garcea 2017).
        """
        gradient = self._gradient(deformation)
        return self._at(gradient, None if before is None else self._foreseen(before, gradient))

    def _foreseen(self, before: Floats, gradient: Floats) -> Floats:
        """Second Piola-Kirchhoff stress (Q, 3) at gradients (Q, 4), linear from an iterate (n,)."""
        known = self.points.strain(before)
        found, rates = self._potential(green(known)), strain_rates(known)
        strain = np.einsum("qij,qj->qi", rates, gradient - known)
        return np.asarray(found.stress + np.einsum("qij,qj->qi", found.tangent, strain))

    def conserving(self, before: Floats, after: Floats) -> Response:
        """Return the stress (Q, 4) whose work from one deformation to another is the energy gained.

        See `nmm.assembly.finite_strain.conserving_stress`; the tangent (Q, 4, 4), by the gradient
        at the end, is not symmetric.
        """
        start, end = self.points.strain(before), self._gradient(after)
        strains, middle = (green(start), green(end)), strain_rates((start + end) / 2)
        found = conserving_stress(self._potential, *strains)
        tangent = np.swapaxes(middle, 1, 2) @ found.tangent @ strain_rates(end)
        return Response(_by(middle, found.stress), tangent + turning(found.stress) / 2, {})

    def internal(self, deformation: Floats, history: History) -> Floats:
        """Return the internal force (n,) of an accepted state."""
        return self.force(deformation, self.update(deformation, history, 0.0).stress)

    def force(self, deformation: Floats, stress: Floats) -> Floats:
        """Return the internal force (n,) of the stress (Q, 4) of points."""
        return self.thickness * self.points.force(stress)

    def stiffness(self, tangent: Floats, symmetric: bool = True) -> csc_array:
        """Return the tangent stiffness (n, n) of tangents (Q, 4, 4), or its symmetric part."""
        if symmetric:
            tangent = (tangent + np.swapaxes(tangent, 1, 2)) / 2
        return csc_array(self.thickness * self.points.matrix(tangent, symmetric))

    def energy(self, deformation: Floats, history: History) -> float:
        """Return the stored energy (J)."""
        density = self._potential(green(self.points.strain(deformation))).energy
        return self.thickness * float(self.points.rule.weights @ density)

    def missed(self, before: Floats, after: Floats) -> float:
        """Return by how much the mean force of both ends does more work (J) than is stored."""
        mean = self.internal(before, {}) + self.internal(after, {})
        gained = self.energy(after, {}) - self.energy(before, {})
        return float(mean @ (after - before)) / 2 - gained

    def mean_stress(self, deformation: Floats, history: History) -> tuple[Ints, Floats]:
        """Return the elements (k,) and their mean Cauchy stress (k, 3) in global axes (Pa).

        The mean is that over the element where it is now. In plane stress it counts the thickness
        as it was.
        """
        gradient = self.points.strain(deformation)
        elements, stress = self.points.means(self._kirchhoff(gradient))
        _, area = self.points.means(volumes(gradient)[:, None])
        return elements, stress / area

    def mean_across(self, deformation: Floats, history: History) -> tuple[Ints, Floats]:
        """Return the elements (k,) and their mean Cauchy stress across the plane (k,) (Pa)."""
        gradient = self.points.strain(deformation)
        elements, stress = self.points.means(self._across(gradient)[:, None])
        _, area = self.points.means(volumes(gradient)[:, None])
        return elements, (stress / area)[:, 0]

    def across_near(
        self, deformation: Floats, history: History, elements: Ints, points: Floats
    ) -> Floats:
        """Return the Cauchy stress across (m,) of the nearest point in elements (m,) (Pa)."""
        gradient = self.points.strain(deformation)
        at = nearest(self.points.rule, elements, points)
        return np.asarray(self._across(gradient) / volumes(gradient))[at]

    def mean_volume(self, deformation: Floats) -> Floats:
        """Return the areas (E,) of the elements over what they were."""
        return self.points.means(volumes(self.points.strain(deformation))[:, None])[1][:, 0]

    def _across(self, gradient: Floats) -> Floats:
        """Stress across (Q,) over areas as they were, where nothing is stretched across (Pa)."""
        strain, found = green(gradient), np.empty(len(gradient))
        for number, law in enumerate(self.laws):  # a handful of laws
            at = np.flatnonzero(self.law == number)
            found[at] = law.potential_across(strain[at], self.plane)
        return found

    def stress_near(
        self, deformation: Floats, history: History, elements: Ints, points: Floats
    ) -> Floats:
        """Cauchy stress (m, 3) of the nearest point in elements (m,)."""
        gradient = self.points.strain(deformation)
        at = nearest(self.points.rule, elements, points)
        return np.asarray(self._kirchhoff(gradient) / volumes(gradient)[:, None])[at]

    def _kirchhoff(self, gradient: Floats) -> Floats:
        return kirchhoff(gradient, self._potential(green(gradient)).stress)

    def asked(self, gradient: Floats, points: Floats, law: Ints) -> Response:
        """Return first Piola-Kirchhoff stress (m, 4) and tangent (m, 4, 4) at other points (m, 2).

        ``law`` (m,) is that of each, and ``gradient`` (m, 4) what is there.

        Raises
        ------
        SolveError
            Where matter is turned inside out.
        """
        return replace(self, law=law)._at(_upright(gradient, points))

    def _gradient(self, deformation: Floats) -> Floats:
        """Return the gradients (Q, 4) of a trial; raises `SolveError` as `asked` does."""
        return _upright(self.points.strain(deformation), self.points.rule.points)

    def _at(self, gradient: Floats, turns: Floats | None = None) -> Response:
        """Return first Piola-Kirchhoff stress and tangent at gradients (Q, 4).

        ``turns`` (Q, 3) is the stress that turns in the tangent, where it is not that there.
        """
        found, rates = self._potential(green(gradient)), strain_rates(gradient)
        tangent = np.swapaxes(rates, 1, 2) @ found.tangent @ rates
        tangent += turning(found.stress if turns is None else turns)
        return Response(_by(rates, found.stress), tangent, {})

    def _potential(self, strain: Floats) -> FiniteResponse:
        """Return what the laws answer at Green strains (Q, 3)."""
        if len(self.laws) == 1:
            return self.laws[0].potential(strain, self.plane)
        energy, stress = np.empty(len(strain)), np.empty_like(strain)
        tangent = np.empty((len(strain), 3, 3))
        for number, law in enumerate(self.laws):  # a handful of laws
            at = np.flatnonzero(self.law == number)
            answer = law.potential(strain[at], self.plane)
            energy[at], stress[at], tangent[at] = answer
        return FiniteResponse(energy, stress, tangent)


def _upright(gradient: Floats, points: Floats) -> Floats:
    """Return gradients (m, 4) at points (m, 2), none of which turns matter inside out."""
    volume = volumes(gradient)
    at = int(np.argmin(np.where(np.isnan(volume), -np.inf, volume)))
    if not volume[at] > 0:
        x, y = points[at]
        raise SolveError(
            f"matter at ({x:.6g}, {y:.6g}) is turned inside out: expected a volume above zero: "
            "take smaller steps or cells"
        )
    return gradient


def _by(rates: Floats, stress: Floats) -> Floats:
    """First Piola-Kirchhoff stress (m, 4) of rates of strain (m, 3, 4) and stresses (m, 3)."""
    return np.asarray(np.einsum("mij,mi->mj", rates, stress))
