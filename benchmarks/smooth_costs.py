"""Costs of one smooth problem: the manifold, and finite elements of scikit-fem, phase by phase.

The problem has an exact smooth solution with displacements prescribed on all sides of the unit
square (E = 1, nu = 0.3, plane stress). Both solve with SuperLU in symmetric mode and with the
project's Cholesky factorisation, whose order of elimination is found anew each time. Seconds are
processor seconds of one thread; errors are not timed. `bench_manifold.py` runs it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from time import process_time

import numpy as np
import skfem
from scipy.sparse import csc_array
from skfem.models.elasticity import linear_elasticity

from covers.approximation.mesh_manifold import mesh_manifold
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Monomials
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.errors import field_errors
from nmm.assembly.model import Model
from nmm.assembly.places import on_edges
from nmm.assembly.state import initial_state
from nmm.constraints.imposition import Method
from nmm.formulation import Solver
from nmm.materials.elastic import Elastic
from nmm.model.solver_settings import solver_for
from nmm.solvers.frontal import symbolic as plans
from nmm.solvers.linear import LinearSolver, make_solver
from nmm.stepping.drive.linear_statics import END, body_force, hold

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
LAW = Elastic(1.0, 0.3)
D = LAW.stiffness("stress")

TRIANGLE = {1: skfem.ElementTriP1, 2: skfem.ElementTriP2, 3: skfem.ElementTriP3}
SOLVERS = ("superlu", "cholesky")
PHASES = ("cover", "moments", "assembly", "supports", *SOLVERS)
# Unknowns beyond which SuperLU takes minutes here.
MOST_FOR_SUPERLU = 45_000


@dataclass(frozen=True)
class Cost:
    """One solution: what it cost and how far it is off.

    Attributes
    ----------
    position
        Number of the random position of the net; 0 for meshes that fit.
    seconds
        By phase; no number for a solver that was not tried.
    """

    problem: str
    method: str
    n: int
    position: int
    unknowns: int
    error: float
    seconds: dict[str, float]

    @property
    def setting(self) -> float:
        """Seconds without the solution of the system."""
        return sum(self.seconds[phase] for phase in PHASES[:4])

    def total(self, solver: str = "best") -> float:
        """Seconds with a solver, or with the faster one."""
        tried = [self.seconds[one] for one in ((solver,) if solver != "best" else SOLVERS)]
        return self.setting + float(np.nanmin(tried)) if np.isfinite(tried).any() else np.nan


def displacement(p: Floats) -> Floats:
    """The solution (m, 2)."""
    x, y = p.T
    u = np.sin(3 * x) * np.cos(2 * y) + x * y / 4
    v = np.cos(2 * x + y) * np.exp(y / 2) - y**2 / 3
    return np.stack([u, v], axis=1)


def strain(p: Floats) -> Floats:
    """Its strain (m, 3)."""
    x, y = p.T
    e, s, c = np.exp(y / 2), np.sin(2 * x + y), np.cos(2 * x + y)
    xx = 3 * np.cos(3 * x) * np.cos(2 * y) + y / 4
    yy = (c / 2 - s) * e - 2 * y / 3
    return np.stack([xx, yy, -2 * np.sin(3 * x) * np.sin(2 * y) + x / 4 - 2 * s * e], axis=1)


def load(p: Floats) -> Floats:
    """Minus the divergence of its stress (m, 2)."""
    x, y = p.T
    e, s, c = np.exp(y / 2), np.sin(2 * x + y), np.cos(2 * x + y)
    sine = np.sin(3 * x) * np.cos(2 * y)
    u_xx, u_yy, u_xy = -9 * sine, -4 * sine, 0.25 - 6 * np.cos(3 * x) * np.sin(2 * y)
    v_xx, v_yy, v_xy = -4 * c * e, -(0.75 * c + s) * e - 2 / 3, -(2 * c + s) * e
    f_x = D[0, 0] * u_xx + D[0, 1] * v_xy + D[2, 2] * (u_yy + v_xy)
    f_y = D[2, 2] * (u_xy + v_xx) + D[0, 1] * u_xy + D[1, 1] * v_yy
    return -np.stack([f_x, f_y], axis=1)


class Clock:
    """Processor seconds between calls."""

    def __init__(self) -> None:
        self.seconds = dict.fromkeys(PHASES, 0.0)
        self._last = process_time()

    def stop(self, name: str) -> None:
        """Count the time since the last call for ``name``."""
        now = process_time()
        self.seconds[name] += now - self._last
        self._last = now


def solutions(
    clock: Clock, matrix: csc_array, force: Floats, settings: Callable[[str], LinearSolver]
) -> Floats:
    """Solve with each solver; the order of elimination is not kept between them."""
    found = np.zeros(0)
    for name in SOLVERS:
        if name == "superlu" and len(force) > MOST_FOR_SUPERLU:
            clock.seconds[name] = np.nan
            continue
        plans.PLANS.clear()
        factor = settings(name).factorise(matrix)
        found = factor.solve(force)
        clock.stop(name)
        assert factor.relative_residual(found, force) < 1e-9
    return found


def net(n: int, angle: float, shift: tuple[float, float]) -> Triangles:
    """Shi's net with edges 1/n, turned and shifted against the square."""
    return Triangles.regular([[0.0, 0.0], [1.0, 1.0]], 1 / n, angle=angle, shift=shift)


def fitted(n: int) -> Triangles:
    """Right triangles that fit the square; two shapes."""
    line = np.linspace(0, 1, n + 1)
    cover = Triangles.from_mesh(skfem.MeshTri.init_tensor(line, line))
    half = len(cover.cell_vertices) // 2
    size = np.full(len(cover.patch_size), 1 / n)
    return replace(cover, cell_shape=np.repeat([0, 1], half), patch_size=size)


def manifold(degree: int, n: int, position: int, make: Callable[[], Triangles]) -> Cost:
    """Solve with covers of a degree by Nitsche's method on all sides."""
    clock = Clock()
    cover = make()
    pieces = cut(cover, SQUARE)
    clock.stop("cover")
    made = mesh_manifold(cover, pieces, Monomials(degree))
    clock.stop("moments")
    count = len(made.elements)
    elasticity = np.broadcast_to(D, (count, 3, 3))
    model = Model(made, elasticity, np.zeros(count), np.ones(count), 1.0, pieces)
    matrix = model.stiffness
    clock.stop("assembly")
    place = on_edges(made, np.ones(len(made.boundary), dtype=bool), 2 * degree + 2)
    start = initial_state(made)
    supports = hold(model, place, Method("nitsche", 1 / n, degree), displacement)
    matrix = csc_array(matrix + supports.matrix(start))
    force = supports.force(start, END)
    force = force + body_force(model, load, 2 * degree + 2).force(start, END)
    clock.stop("supports")
    found = solutions(clock, matrix, force, lambda name: solver_for(made, Solver(type=name)))
    off = field_errors(model, found, displacement, strain, 2 * degree + 4)
    method = f"NMM{degree} {'cut' if position else 'fitted'}"
    return Cost("smooth", method, n, position, made.n_unknowns, off.energy, clock.seconds)


def on_fitted(degree: int, n: int) -> Cost:
    """Solve on right triangles that fit."""
    return manifold(degree, n, 0, lambda: fitted(n))


def on_cut(degree: int, n: int, position: int) -> Cost:
    """Solve on Shi's net at a random position (1, 2, ...)."""
    angle, first, second = np.random.default_rng(position).uniform(size=3).tolist()
    return manifold(degree, n, position, lambda: net(n, angle, (first, second)))


def elements(order: int, n: int) -> Cost:
    """Solve with finite elements; strong supports, tuned direct solver."""
    clock = Clock()
    line = np.linspace(0, 1, n + 1)
    mesh = skfem.MeshTri.init_tensor(line, line)
    kind = skfem.ElementVector(TRIANGLE[order]())
    clock.stop("cover")
    # Stiffness integrands have the degree 2 (order - 1).
    stiff = skfem.Basis(mesh, kind, intorder=max(2 * order - 2, 1))
    matrix = skfem.asm(linear_elasticity(D[0, 1], D[2, 2]), stiff)
    clock.stop("assembly")
    basis = skfem.Basis(mesh, kind, intorder=_positive(2 * order))

    @skfem.LinearForm
    def work(v, w):  # type: ignore[no-untyped-def]
        shape = w.x[0].shape
        f = load(w.x.reshape(2, -1).T).T.reshape(2, *shape)
        return f[0] * v[0] + f[1] * v[1]

    force = work.assemble(basis)
    held = basis.get_dofs().flatten()
    at = basis.doflocs[:, held].T
    exact = displacement(at)
    u = basis.zeros()
    u[held] = exact[np.arange(len(held)), _component(basis, held)]
    clock.stop("supports")
    reduced, rest, _, free = skfem.condense(matrix, force, x=u, D=held)
    clock.stop("supports")
    u[free] = solutions(clock, csc_array(reduced), rest, make_solver)
    error = _error(mesh, kind, order, u)
    return Cost("smooth", f"P{order}", n, 0, len(u), error, clock.seconds)


def _positive(order: int) -> int:
    """Rules of the orders 3 and 7 have negative weights."""
    return order + 1 if order in (3, 7) else order


def _component(basis: skfem.Basis, held: np.ndarray) -> np.ndarray:
    """0 where an unknown moves along x, 1 where it moves along y."""
    second = np.zeros(basis.N, dtype=np.int64)
    for dofs in (basis.nodal_dofs, basis.facet_dofs, basis.interior_dofs):
        if len(dofs):
            second[dofs[1::2].ravel()] = 1
    return second[held]


def _error(mesh: skfem.MeshTri, kind: object, order: int, u: Floats) -> float:
    basis = skfem.Basis(mesh, kind, intorder=_positive(2 * order + 2))
    g = basis.interpolate(u).grad
    x = basis.global_coordinates().value
    exact = strain(x.reshape(2, -1).T).T.reshape(3, *x.shape[1:])
    off = np.stack([g[0, 0], g[1, 1], g[0, 1] + g[1, 0]]) - exact
    energies = [np.einsum("iek,ij,jek,ek->", e, D, e, basis.dx) for e in (off, exact)]
    return float(np.sqrt(energies[0] / energies[1]))
