"""Displacement and stress at common points, so that runs with unlike elements can be compared."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.errors import NmmError
from nmm.outputs.stresses import von_mises

if TYPE_CHECKING:
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class Raster:
    """A regular grid over the plane and the points of it that lie in material.

    Attributes
    ----------
    extent
        (2, 2) lower left and upper right corner (m).
    shape
        Rows and columns of the grid.
    index
        (m,) places of the points in the flattened grid.
    points
        (m, 2) reference coordinates (m).
    """

    extent: Floats
    shape: tuple[int, int]
    index: Ints
    points: Floats

    def image(self, values: Floats) -> Floats:
        """Return values (m,) as an image, nan where there is no material."""
        filled = np.full(self.shape[0] * self.shape[1], np.nan)
        filled[self.index] = values
        return filled.reshape(self.shape)


@dataclass(frozen=True)
class SampledFields:
    """Displacement (m, 2) in m and Cauchy stress (m, 3) in Pa, nan where no element is.

    ``across`` (m,) is the stress across the plane (Pa), 0 in plane stress.
    """

    displacement: Floats
    stress: Floats
    across: Floats

    @property
    def mises(self) -> Floats:
        """Von Mises stress (m,), the stress across the plane with it (Pa)."""
        return von_mises(self.stress, self.across)


def raster(polygons: Polygons, cells: int = 12_000) -> Raster:
    """Return about ``cells`` square cells over the box of polygons; their middles are the points.

    The points are moved off the middles by a hundredth of a cell, so that few lie on joints.
    """
    low, high = polygons.points.min(axis=0), polygons.points.max(axis=0)
    side = float(np.sqrt(np.prod(high - low) / cells))
    columns, rows = (max(int(np.ceil(n)), 1) for n in (high - low) / side)
    x = low[0] + (np.arange(columns) + 0.5) * (high[0] - low[0]) / columns
    y = low[1] + (np.arange(rows) + 0.5) * (high[1] - low[1]) / rows
    points = np.stack([axis.ravel() for axis in np.meshgrid(x, y)], axis=1) + 0.0071 * side
    inside = np.flatnonzero(elements_at(polygons, points) >= 0)
    return Raster(np.stack([low, high]), (rows, columns), inside, points[inside])


def elements_at(polygons: Polygons, points: Floats) -> Ints:
    """Return the polygon (m,) that each point lies in, -1 for none; the first of several."""
    import shapely

    tree = shapely.STRtree(polygons.to_shapely())
    found = np.full(len(points), len(polygons), dtype=np.int64)
    which, polygon = tree.query(shapely.points(points), predicate="intersects")
    np.minimum.at(found, which, polygon)
    return np.where(found == len(polygons), -1, found)


def fields(run: "Run", points: Floats) -> SampledFields:
    """Evaluate a run's last state at reference points (m, 2) of its scene, in global axes.

    Raises
    ------
    NmmError
        When no point lies in a block.
    """
    manifold, points = run.manifold, points - run.origin
    elements = elements_at(manifold.elements, points)
    there = elements >= 0
    if not there.any():
        raise NmmError(
            "no block lies at the points that are compared: expected a scene of the same case: "
            "leave it out"
        )
    displacement, stress = np.full((len(points), 2), np.nan), np.full((len(points), 3), np.nan)
    across = np.full(len(points), np.nan)
    displacement[there] = _displacement(run, elements[there], points[there])
    stress[there], across[there] = _stress(run, elements[there], points[there])
    return SampledFields(displacement, stress, across)


def _displacement(run: "Run", elements: Ints, points: Floats) -> Floats:
    from nmm.assembly.material_points import material_points

    material = material_points(run.manifold, elements, points)
    return material.place(run.state.frames, run.state.deformation) - points


def _stress(run: "Run", elements: Ints, points: Floats) -> tuple[Floats, Floats]:
    """Stress (m, 3) at points, and that across the plane (m,)."""
    from integration.rules import PointRule
    from nmm.assembly.errors import stresses
    from nmm.model.planning.across import stress_across_at
    from nmm.model.planning.pressures import patch_pressures

    model, plan = run.stepper.model, run.stepper.plan
    rule = PointRule(points, np.ones(len(points)), elements)
    pressure = patch_pressures(plan, model, run.state)
    stress = stresses(model, run.state.deformation, rule, pressure)
    if model.matter is not None:
        state = run.state
        near = model.matter.stress_near(state.deformation, state.history, elements, points)
        stress = np.where(np.isnan(near), stress, near)
    across = stress_across_at(plan, model, run.state, elements, points, stress)
    for tells in plan.stresses:  # a handful of effects
        stress = stress + tells(elements, points, run.state.time)
    turn = run.state.frames.rotation[run.manifold.element_body[elements]]
    tensor = turn @ stress[:, [[0, 2], [2, 1]]] @ np.swapaxes(turn, 1, 2)
    return np.stack([tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 0, 1]], axis=1), across
