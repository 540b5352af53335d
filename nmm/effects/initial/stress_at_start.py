"""The initial stress field: uniform in a block, or linear with depth."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.rules import polygon_rule
from nmm.assembly.model import Model
from nmm.assembly.stress_points import StressPoints
from nmm.errors import Fault, SceneError
from nmm.materials.base import Law

if TYPE_CHECKING:
    from nmm.effects.given.setup import Setup
    from nmm.scene.tables.initial import InitialStressTable


# Share of the largest stress up to which a tension at the surface is rounding.
ROUNDED = 1e-9


@dataclass(frozen=True)
class StressAtStart:
    """Stress of elements in body axes, linear in y.

    Attributes
    ----------
    mean
        (E, 4) xx, yy, xy and zz at the centroids (Pa); zz is nan where it is not given.
    slope
        (E, 4) derivative by y (Pa/m).
    """

    mean: Floats
    slope: Floats

    @classmethod
    def constant(cls, stress: Floats) -> Self:
        """Return a stress (E, 3) that is uniform in each element (Pa)."""
        mean = np.column_stack([stress, np.full(len(stress), np.nan)])
        return cls(mean, np.zeros_like(mean))

    @classmethod
    def declared(cls, setup: "Setup") -> Self:
        """Return the stress of ``[[initial_stresses]]``; later tables overwrite earlier ones."""
        region = setup.model.manifold.element_region
        height = setup.model.manifold.elements.centroids[:, 1]
        mean, slope = np.zeros((len(region), 4)), np.zeros((len(region), 4))
        mean[:, 3] = np.nan
        for number, item in enumerate(setup.scene.initial_stresses):  # a handful of tables
            regions = setup.regions(item.block)
            _refuse_across(setup, number, regions)
            chosen = np.full(len(region), True) if regions is None else regions[region]
            at_zero, slope[chosen] = _line(item, setup.origin[1])
            mean[chosen] = at_zero + height[chosen, None] * slope[chosen]
        return cls(mean, slope)

    @property
    def even(self) -> bool:
        """Whether it is uniform in each element."""
        return not self.slope.any()

    def tension(self, model: Model) -> tuple[float, float]:
        """Return how far matter reaches above where stress by depth is zero (m), and its tension.

        The latter is the largest vertical one at the start (Pa); both are zero below the surface.
        """
        elements = model.manifold.elements
        top = np.full(len(elements), -np.inf)
        np.maximum.at(top, elements.polygon_of_point, elements.points[:, 1])
        by_depth = self.slope[:, 1] > 0
        pull = self.mean[:, 1] + (top - elements.centroids[:, 1]) * self.slope[:, 1]
        pull[~by_depth] = 0.0
        if not by_depth.any() or pull.max() <= ROUNDED * np.abs(self.mean[by_depth, 1]).max():
            return 0.0, 0.0
        worst = int(pull.argmax())
        return float(pull[worst] / self.slope[worst, 1]), float(pull[worst])

    def at(self, model: Model, elements: Ints, points: Floats) -> Floats:
        """Return the stress (m, 4) at reference points (m, 2) of elements (m,) (Pa)."""
        above = points[:, 1] - model.manifold.elements.centroids[elements, 1]
        return np.asarray(self.mean[elements] + above[:, None] * self.slope[elements])

    def within(self, model: Model) -> Callable[[Ints, Floats], Floats]:
        """Return a function like `at` of the components in the plane (m, 3)."""
        return lambda elements, points: self.at(model, elements, points)[:, :3]

    def force(self, model: Model) -> Floats:
        """Return the integral (n,) of ``B^T sigma`` (N)."""
        found = model.stress_load(self.mean[:, :3])
        if self.even:
            return found
        points = StressPoints.of(model.manifold, np.asarray(self.slope.any(axis=1)))
        owner = points.rule.owner
        beyond = (self.at(model, owner, points.rule.points) - self.mean[owner])[:, :3]
        return found + model.thickness * points.force(beyond)

    def energy(self, model: Model) -> float:
        """Return its elastic energy (J), ``1/2 int sigma : D^-1 sigma``."""
        area = model.manifold.elements.areas
        found = float(_density(model, self.mean) @ area)
        if not self.even:
            rule, middle = (
                polygon_rule(model.manifold.elements, 2),
                model.manifold.elements.centroids,
            )
            square = rule.weights * (rule.points[:, 1] - middle[rule.owner, 1]) ** 2
            found += float(_density(model, self.slope) @ np.bincount(rule.owner, square, len(area)))
        return found * model.thickness


def _refuse_across(setup: "Setup", number: int, regions: Bools | None) -> None:
    """Refuse a stress out of the plane of matter that knows of none.

    Raises
    ------
    SceneError
        In plane stress, and of laws that are not linear and whose variables do not tell of it.
    """
    item, scene, laws = setup.scene.initial_stresses[number], setup.scene, setup.model.laws
    key = "across" if item.across is not None else "ratio_across"
    if getattr(item, key) is None:
        return
    place = scene.source.place("initial_stresses", number, key)
    if setup.model.plane == "stress":
        raise SceneError(Fault(place, "in plane stress", "none across the plane", "remove it"))
    own = np.asarray(setup.region_material)[slice(None) if regions is None else regions]
    for law in (laws[one] for one in np.unique(own)):  # a handful of materials
        if not law.linear and type(law).under is Law.under:
            value, expected = f"of {type(law).__name__}", "matter that flows"
            remedy = "remove it: the stress across is then that of elastic matter"
            raise SceneError(Fault(place, value, expected, remedy))


def _density(model: Model, stress: Floats) -> Floats:
    """Elastic energy density (E,) of stresses (E, 4) (J/m3)."""
    in_plane = stress[:, :3]
    strain = np.linalg.solve(model.elasticity, in_plane[:, :, None])[:, :, 0]
    return np.asarray(np.einsum("ei,ei->e", in_plane, strain) / 2)


def _line(item: "InitialStressTable", origin: float) -> tuple[Floats, Floats]:
    """Return the stress (4,) of a table at y = 0 of the model's axes, and its slope (4,) by y."""
    if item.stress is not None:
        across = np.nan if item.across is None else item.across
        return np.array([*item.stress, across]), np.zeros(4)
    assert item.surface is not None
    assert item.unit_weight is not None
    assert item.ratio is not None
    known = item.ratio_across is not None
    shares = np.array([item.ratio, 1.0, 0.0, item.ratio_across if known else 0.0])
    at_zero = -(item.surcharge + item.unit_weight * (item.surface - origin)) * shares
    if not known:
        at_zero[3] = np.nan
    return at_zero, item.unit_weight * shares
