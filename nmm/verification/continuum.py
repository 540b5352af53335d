"""Benchmarks of the continuum: meshed bodies under given functions of position."""

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np
import numpy.typing as npt

from integration.arrays import Bools, Floats
from integration.polygons import Polygons
from nmm.assembly.errors import Field, FieldErrors, field_errors, stresses
from nmm.assembly.model import Model
from nmm.assembly.places import Place, at_point, on_edges
from nmm.assembly.state import initial_state
from nmm.constraints.chosen_method import support_method
from nmm.constraints.imposition import Imposition
from nmm.constraints.interface import Interface
from nmm.constraints.springs import Springs
from nmm.constraints.supports import Supports
from nmm.formulation import Formulation
from nmm.geometry.tessellation.cover_types import degree_of
from nmm.verification.base import Case
from nmm.verification.formulations import chosen, with_cover

if TYPE_CHECKING:
    from pathlib import Path

    from nmm.effects.base import Effect
    from nmm.effects.loading.loads import Load
    from nmm.formulation import Solver
    from nmm.stepping.drive.linear_statics import Equilibrium

POSITIONS = ((0.2, (0.3, 0.1)), (0.5, (0.61, 0.83)), (0.8, (0.42, 0.05)))
"""Angles (rad) and displacements (in cells) of meshes that follow no edge of a body."""

FITTED = -1
"""Position of a mesh along the axes."""

Tractions = Callable[[Floats, Floats], Floats]


@dataclass(frozen=True)
class Exact:
    """A solution in closed form.

    Attributes
    ----------
    displacement, stress
        Fields (m, 2) and (m, 3) of points (m, 2).
    """

    displacement: Field
    stress: Field

    def traction(self, points: Floats, normals: Floats) -> Floats:
        """Tractions (m, 2) on faces with outward normals (m, 2)."""
        return traction_of(self.stress(points), normals)


@dataclass(frozen=True)
class Problem:
    """A body on a mesh with what acts on it.

    Attributes
    ----------
    model
        The body.
    supports, loads
        Where it is held and by what it is loaded.
    forces
        Further effects.
    """

    model: Model
    supports: Sequence[Imposition] = ()
    loads: "Sequence[Load]" = ()
    forces: "Sequence[Effect]" = ()

    def solve(self, solver: "Solver | None" = None) -> "Equilibrium":
        """Solve in small displacements."""
        from nmm.effects.loading.loads import Loads
        from nmm.stepping.drive.linear_statics import equilibrium

        n = self.model.manifold.n_unknowns
        effects: list[Effect] = list(self.forces)
        if self.supports:
            state = initial_state(self.model.manifold)
            effects.append(Supports(list(self.supports), n, state))
        if self.loads:
            effects.append(Loads(list(self.loads), self.model))
        return equilibrium(self.model, effects, solver)


class ContinuumCase(Case):
    """Benchmark on a meshed body.

    Attributes
    ----------
    size
        Size of covers in the sketch (m).
    """

    size: ClassVar[float]
    formulations: ClassVar[tuple[str, ...]] = ("manifold",)

    @abstractmethod
    def problem(self, formulation: Formulation) -> Problem:
        """Return the problem on the mesh of a formulation."""

    def solved(self, name: str, size: float | None = None, position: int = 0) -> "Equilibrium":
        """Solve under the formulation called ``name`` with covers of a size at a position."""
        return self.problem(on_mesh(name, size or self.size, position)).solve()

    def sketch(self, path: "Path") -> bool:
        """Draw elements, supports and tractions."""
        from nmm.verification.sketches import sketch_solid

        problem = self.problem(on_mesh(self.formulations[0], self.size))
        sketch_solid(problem.model.cut, problem.supports, problem.loads, path)
        return True


def on_mesh(name: str, size: float, position: int = 0) -> Formulation:
    """Return the formulation called ``name`` with covers of a size, turned and moved."""
    angle, shift = (0.0, (0.0, 0.0)) if position == FITTED else POSITIONS[position]
    found = chosen(name)
    return with_cover(found, size=size, angle=angle, shift=shift)


def degree(formulation: Formulation) -> int:
    """Degree of the local functions."""
    return degree_of(formulation.cover) or 0


def fine(formulation: Formulation) -> int:
    """Degree of polynomials to integrate where fields are not polynomials."""
    return 2 * degree(formulation) + 6


def polygon(ring: npt.ArrayLike) -> Polygons:
    """Return one polygon of a ring (n, 2)."""
    return Polygons.from_vertices([np.asarray(ring, dtype=float)]).oriented()


def quarter(inner: float, segments: int) -> Floats:
    """Points (n + 1, 2) of a quarter of a circle, from (0, r) to (r, 0), both exactly."""
    angle = np.linspace(np.pi / 2, 0, segments + 1)
    arc = inner * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    arc[0], arc[-1] = [0.0, inner], [inner, 0.0]
    return arc


def middles(model: Model) -> Floats:
    """Middles (n, 2) of the boundary's edges."""
    edges = model.manifold.boundary
    return (edges.start + edges.end) / 2


def everywhere(model: Model, order: int) -> Place:
    """Gauss points on the whole boundary."""
    return on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), order)


def edge_support(
    model: Model,
    formulation: Formulation,
    place: Place,
    displacement: Field | None = None,
    axes: tuple[bool, bool] = (True, True),
) -> Imposition:
    """Hold Gauss points of edges as the formulation says."""
    values = np.zeros(2) if displacement is None else displacement(place.position)
    size = formulation.cover.size
    method = support_method(model, formulation.supports, size, degree(formulation))
    return method.hold(model, place, lambda end: values, axes)


def rollers(model: Model, formulation: Formulation, edges: Bools, axis: int) -> Imposition:
    """Hold edges (n,) of the boundary in x (0) or y (1)."""
    place = on_edges(model.manifold, edges, 2 * (degree(formulation) + 2))
    return edge_support(model, formulation, place, axes=(axis == 0, axis == 1))


def pin(model: Model, point: npt.ArrayLike, axes: tuple[bool, bool] = (True, True)) -> Imposition:
    """Hold a point by a spring as stiff as the material."""
    place = at_point(model.manifold, np.asarray(point, dtype=float))
    spring = np.full(len(place), float(model.modulus.max()))
    return Springs(Interface(place, None, place.weight, "pin", np.array(axes)), spring)


def load(model: Model, place: Place, field: Tractions) -> "Load":
    """Load Gauss points by tractions ``field(points, normals)`` (m, 2)."""
    from nmm.stepping.drive.linear_statics import traction

    return traction(model, place, field).loads[0]


def errors_of(found: "Equilibrium", exact: Exact, order: int) -> FieldErrors:
    """Relative errors of energy and displacement against a closed form of one material."""
    compliance = np.linalg.inv(found.model.elasticity[0])

    def strain(points: Floats) -> Floats:
        return np.asarray(exact.stress(points) @ compliance)

    return field_errors(found.model, found.state.deformation, exact.displacement, strain, order)


def displacement_at(found: "Equilibrium", point: npt.ArrayLike) -> Floats:
    """Displacement (2,) of the material at a point (m)."""
    place = at_point(found.model.manifold, np.asarray(point, dtype=float))
    return np.asarray(place.points.rows.apply(found.state.deformation)[0])


def stress_at(found: "Equilibrium", point: npt.ArrayLike) -> Floats:
    """Stress (3,) in the element at a point (Pa)."""
    from integration.rules import PointRule

    place = at_point(found.model.manifold, np.asarray(point, dtype=float))
    rule = PointRule(place.position[:1], np.ones(1), place.elements[:1])
    return np.asarray(stresses(found.model, found.state.deformation, rule, found.pressure)[0])


def traction_of(stress: Floats, normal: Floats) -> Floats:
    """Tractions (m, 2) of stresses (m, 3) on faces with normals (m, 2)."""
    x = stress[:, 0] * normal[:, 0] + stress[:, 2] * normal[:, 1]
    y = stress[:, 2] * normal[:, 0] + stress[:, 1] * normal[:, 1]
    return np.stack([x, y], axis=1)
