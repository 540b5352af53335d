"""Costs at a crack tip and at a re-entrant corner, beside uniform and graded finite elements.

*Crack*: ``[-1, 1]^2`` with a crack from the left edge to the origin. *Corner*: an L of three unit
squares. Exact fields are of Williams' series: both singular modes, which the manifold's functions
hold, and regular ones of it, which they do not (exponents 3/2 and 5/2 at the crack, the complex
1.63 + 0.23 i at the corner). Displacements are prescribed on the outer edges; faces are free.
`bench_manifold.py` runs it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
import skfem
from scipy.optimize import newton
from scipy.sparse import csc_array
from skfem.models.elasticity import linear_elasticity
from smooth_costs import LAW, TRIANGLE, Clock, Cost, D, solutions

from covers.approximation.mesh_manifold import mesh_manifold
from covers.approximation.singular.enrichment import Enrichment, singular_fields
from covers.cutting.cut import cut
from covers.local_functions.corner_functions import corner_functions
from covers.local_functions.crack_tip_functions import crack_tip_functions
from covers.local_functions.polynomials import Monomials
from covers.local_functions.singular_functions import SingularFunctions
from covers.mathematical.triangles import Triangles
from integration.arrays import Bools, Floats
from integration.polygons import Polygons, diameters
from integration.rules import PointRule, polygon_rule
from integration.singular import tip_rule
from nmm.assembly.errors import field_errors
from nmm.assembly.model import Model
from nmm.assembly.places import on_edges
from nmm.assembly.state import initial_state
from nmm.constraints.imposition import Method
from nmm.formulation import Solver
from nmm.model.solver_settings import solver_for
from nmm.solvers.linear import make_solver
from nmm.stepping.drive.linear_statics import END, hold

KAPPA, SHEAR = LAW.kolosov("stress"), float(D[2, 2])
RADIUS = 0.35
MANIFOLD = {1: (4, 8), 2: (4,)}
GRADED = {2: (0.8, 0.6, 0.4, 0.3, 0.2, 0.15, 0.1), 3: (0.8, 0.6, 0.4, 0.3, 0.2, 0.15)}


@dataclass(frozen=True)
class Problem:
    """A singular point at the origin.

    Attributes
    ----------
    known, other
        Modes that covers carry, and modes of the exact solution besides.
    """

    name: str
    ring: Floats
    crack: Floats | None
    direction: Floats
    known: SingularFunctions
    other: SingularFunctions

    def fields(self, p: Floats, side: Floats) -> tuple[Floats, Floats]:
        """Displacement (m, 2) and gradient (m, 2, 2)."""
        u, g = np.zeros((len(p), 2)), np.zeros((len(p), 2, 2))
        # Beside a corner angles from the bisector are less than half a turn.
        bearing = (0.0 if self.crack is None else np.pi / 2) * side
        for functions in (self.known, self.other):
            item = Enrichment(functions, np.zeros(2), self.direction)
            value, gradient = singular_fields(item, p, bearing)
            strength = 1 / (2 * SHEAR) / np.arange(1, functions.number + 1)
            u += np.real(np.einsum("mnc,n->mc", value, strength))
            g += np.real(np.einsum("mncd,n->mcd", gradient, strength))
        return u, g

    def displacement(self, p: Floats) -> Floats:
        """Displacement (m, 2); above the crack where on it."""
        return self.fields(p, np.where(p[:, 1] >= 0, 1.0, -1.0))[0]

    def strain(self, p: Floats) -> Floats:
        """Strain (m, 3)."""
        g = self.fields(p, np.where(p[:, 1] >= 0, 1.0, -1.0))[1]
        return np.stack([g[:, 0, 0], g[:, 1, 1], g[:, 0, 1] + g[:, 1, 0]], axis=1)

    def outer(self, p: Floats) -> Bools:
        """Points on the outer edges."""
        return np.abs(p).max(axis=1) > 1 - 1e-9


@cache
def crack() -> Problem:
    """Return the problem of the crack."""
    ring = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    other = SingularFunctions((1.5, 2.5), (-0.2, -1.0), (True, False), KAPPA, 1.0)
    known = crack_tip_functions(KAPPA, 1.0)
    line = np.array([[-1.5, 0.0], [0.0, 0.0]])
    return Problem("crack", ring, line, np.array([1.0, 0.0]), known, other)


@cache
def corner() -> Problem:
    """Return the problem of the corner; its first regular mode has a complex exponent."""
    ring = np.array([[0.0, 0.0], [0, -1], [-1, -1], [-1, 1], [1, 1], [1, 0]])[::-1]
    half = 0.75 * np.pi
    power = complex(newton(lambda x: np.sin(2 * x * half) - x, 1.63 + 0.23j, tol=1e-14))
    ratio = -(power - 1) / (power + 1) * np.sin((power - 1) * half) / np.sin((power + 1) * half)
    other = SingularFunctions((power,), (ratio,), (True,), KAPPA, 1.0)  # type: ignore[arg-type]
    known = corner_functions(1.5 * np.pi, KAPPA, 1.0)
    return Problem("corner", ring, None, np.array([-1.0, 1.0]) / np.sqrt(2), known, other)


def manifold(problem: Problem, degree: int, n: int, position: int) -> Cost:
    """Solve on Shi's net of edges 1/n at a random position."""
    angle, *shift = np.random.default_rng(position).uniform(size=3).tolist()
    clock = Clock()
    box = [[-1.0, -1.0], [1.0, 1.0]]
    cover = Triangles.regular(box, 1 / n, angle=angle, shift=(shift[0], shift[1]))
    cracks = [] if problem.crack is None else [problem.crack]
    pieces = cut(cover, Polygons.from_vertices([problem.ring]), cracks)
    clock.stop("cover")
    about = Enrichment(problem.known, np.zeros(2), problem.direction, RADIUS)
    made = mesh_manifold(cover, pieces, Monomials(degree), [about])
    clock.stop("moments")
    count = len(made.elements)
    stiff = np.broadcast_to(D, (count, 3, 3))
    model = Model(made, stiff, np.zeros(count), np.ones(count), 1.0, pieces)
    matrix = model.stiffness
    clock.stop("assembly")
    edges = made.boundary
    held = problem.outer((edges.start + edges.end) / 2)
    place = on_edges(made, held, 2 * degree + 8)
    supports = hold(model, place, Method("nitsche", 1 / n, degree), problem.displacement)
    start = initial_state(made)
    matrix = csc_array(matrix + supports.matrix(start))
    force = supports.force(start, END)
    clock.stop("supports")
    found = solutions(clock, matrix, force, lambda name: solver_for(made, Solver(type=name)))
    rule = singular_rule(made.elements, 2 * degree + 2)
    off = field_errors(model, found, problem.displacement, problem.strain, 0, rule)
    method = f"NMM{degree} enriched"
    return Cost(problem.name, method, n, position, made.n_unknowns, off.energy, clock.seconds)


def singular_rule(elements: Polygons, order: int) -> PointRule:
    """Points for errors: fans about the origin near it."""
    near = np.hypot(*elements.centroids.T) < 1.5 * diameters(elements)
    close, far = np.flatnonzero(near), np.flatnonzero(~near)
    one = tip_rule(elements.take(close), np.zeros((len(close), 2)), order + 8)
    two = polygon_rule(elements.take(far), order)
    owner = np.concatenate([close[one.owner], far[two.owner]])
    points = np.concatenate([one.points, two.points])
    return PointRule(points, np.concatenate([one.weights, two.weights]), owner)


def uniform_mesh(problem: Problem, n: int) -> skfem.MeshTri:
    """Right triangles, n along an edge of 2; nodes on the crack are double."""
    line = np.linspace(-1, 1, n + 1)
    mesh = skfem.MeshTri.init_tensor(line, line)
    p, t = mesh.p, mesh.t.copy()
    middle = p[:, t].mean(axis=1)
    if problem.crack is None:
        kept = ~((middle[0] > 0) & (middle[1] < 0))
        return skfem.MeshTri(p, t[:, kept]).remove_unused_nodes()
    twice = np.flatnonzero((np.abs(p[1]) < 1e-12) & (p[0] < -1e-12))
    new = np.arange(p.shape[1])
    new[twice] = p.shape[1] + np.arange(len(twice))
    t[:, middle[1] < 0] = new[t[:, middle[1] < 0]]
    return skfem.MeshTri(np.hstack([p, p[:, twice]]), t)


def graded_mesh(problem: Problem, size: float, order: int) -> skfem.MeshTri:
    """Cells of ``size r^(1 - g)`` at a distance r, with the g that restores the rate."""
    grade = 0.9 * problem.known.exponent[0] / order
    mesh = uniform_mesh(problem, 4)
    for _ in range(60):
        corners = mesh.p[:, mesh.t]
        far = np.hypot(*corners).max(axis=0)
        long = np.max([np.hypot(*(corners[:, i] - corners[:, i - 1])) for i in range(3)], axis=0)
        wide = long > size * np.maximum(far, size ** (1 / grade)) ** (1 - grade)
        if not wide.any():
            break
        mesh = mesh.refined(np.flatnonzero(wide))
    return mesh


def elements(problem: Problem, order: int, make: Callable[[], skfem.MeshTri], name: str) -> Cost:
    """Solve with finite elements, displacements strong on the outer edges."""
    clock = Clock()
    mesh = make()
    kind = skfem.ElementVector(TRIANGLE[order]())
    clock.stop("cover")
    basis = skfem.Basis(mesh, kind, intorder=max(2 * order - 2, 1))
    matrix = skfem.asm(linear_elasticity(D[0, 1], D[2, 2]), basis)
    clock.stop("assembly")
    ends = mesh.p[:, mesh.facets]
    inside = ends.mean(axis=1)
    rim = mesh.boundary_facets()
    held = basis.get_dofs(rim[problem.outer(inside[:, rim].T)]).flatten()
    side = _sides(basis)
    exact = problem.fields(basis.doflocs.T, side)[0]
    second = np.zeros(basis.N, dtype=np.int64)
    for dofs in (basis.nodal_dofs, basis.facet_dofs, basis.interior_dofs):
        if len(dofs):
            second[dofs[1::2].ravel()] = 1
    u = basis.zeros()
    u[held] = exact[held, second[held]]
    reduced, rest, _, free = skfem.condense(matrix, basis.zeros(), x=u, D=held)
    clock.stop("supports")
    u[free] = solutions(clock, csc_array(reduced), rest, make_solver)
    method = f"P{order} {name}"
    error = _error(problem, mesh, kind, u)
    return Cost(problem.name, method, mesh.t.shape[1], 0, len(u), error, clock.seconds)


def _sides(basis: skfem.Basis) -> Floats:
    """Side of the crack of the cells that unknowns belong to."""
    middle = basis.mesh.p[:, basis.mesh.t].mean(axis=1)[1]
    side = np.zeros(basis.N)
    side[basis.element_dofs] = np.where(middle >= 0, 1.0, -1.0)
    return side


def _error(problem: Problem, mesh: skfem.MeshTri, kind: object, u: Floats) -> float:
    """Relative error in energy; cells at the singular point by a rule of degree 19."""
    total = np.zeros(2)
    origin = (np.hypot(*mesh.p) < 1e-12)[mesh.t].any(axis=0)
    for cells, order in ((origin, 19), (~origin, 10)):
        basis = skfem.Basis(mesh, kind, intorder=order, elements=np.flatnonzero(cells))
        g = basis.interpolate(u).grad
        x = basis.global_coordinates().value
        exact = problem.strain(x.reshape(2, -1).T).T.reshape(3, *x.shape[1:])
        off = np.stack([g[0, 0], g[1, 1], g[0, 1] + g[1, 0]]) - exact
        total += [np.einsum("iek,ij,jek,ek->", e, D, e, basis.dx) for e in (off, exact)]
    return float(np.sqrt(total[0] / total[1]))
