"""What manifold covers cost beside finite elements: seconds, unknowns and errors of one problem.

Benchmark A8 (smooth elasticity on the unit square, displacements prescribed on all sides) with
triangular covers of degree 0 to 2 that are turned and shifted at random against the square, and
with scikit-fem's P1, P2 and P3 on a mesh that fits it. CPU seconds of one process, medians over
the positions of the mesh and over repeats; the same linear solver for all. Evaluation of errors is
not counted. Run: ``python benchmarks/manifold_cost.py [largest number of unknowns]``.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from covers.cutting import cut
from covers.local_functions import Monomials
from covers.mesh_manifold import mesh_manifold
from covers.triangles import Triangles
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.errors import field_errors
from nmm.assembly.model import Model
from nmm.assembly.places import on_edges
from nmm.effects.supports import Method
from nmm.formulation import Solver
from nmm.materials.elastic import Elastic
from nmm.stepping.cures import solver_for
from nmm.stepping.equilibrium import END, body_force, hold

LAW = Elastic(1.0, 0.3)
SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
D = LAW.stiffness("strain")
FACTOR = (D[0, 1] + 2 * D[2, 2]) * 2 * np.pi**2


def displacement(p: Floats) -> Floats:
    x, y = np.pi * p.T
    return np.stack([np.sin(x) * np.cos(y), np.cos(x) * np.sin(y)], axis=1)


def strain(p: Floats) -> Floats:
    x, y = np.pi * p.T
    normal = np.pi * np.cos(x) * np.cos(y)
    return np.stack([normal, normal, -2 * np.pi * np.sin(x) * np.sin(y)], axis=1)


@dataclass
class Cost:
    """One run: CPU seconds by phase, unknowns, relative error in energy."""

    unknowns: int = 0
    error: float = np.nan
    seconds: dict[str, float] = field(default_factory=dict)

    def spend(self, phase: str, work: Callable[[], object]) -> object:
        """Do the work and count its seconds."""
        begin = time.process_time()
        result = work()
        self.seconds[phase] = self.seconds.get(phase, 0.0) + time.process_time() - begin
        return result

    @property
    def total(self) -> float:
        """Seconds of all phases."""
        return sum(self.seconds.values())


def manifold(degree: int, size: float, angle: float, shift: tuple[float, float]) -> Cost:
    cost = Cost()
    spend = cost.spend
    laid = spend(
        "cutting", lambda: Triangles.regular([[0, 0], [1, 1]], size, angle=angle, shift=shift)
    )
    pieces = spend("cutting", lambda: cut(laid, SQUARE))
    made = spend("moments", lambda: mesh_manifold(laid, pieces, Monomials(degree)))
    n = len(made.elements)
    model = Model(made, np.broadcast_to(D, (n, 3, 3)), np.zeros(n), np.ones(n), 1.0, pieces)
    spend("assembly", lambda: model.stiffness)
    method = Method("nitsche", size, degree)
    from nmm.assembly.motion import initial_state

    start = initial_state(made)

    def boundary():
        place = on_edges(made, np.ones(len(made.boundary), dtype=bool), method.order)
        supports = hold(model, place, method, displacement)
        return supports.matrix(start), supports.force(start, END)

    tie, pull = spend("supports", boundary)
    load = spend(
        "load",
        lambda: body_force(model, lambda p: FACTOR * displacement(p), 2 * degree + 2).force(
            start, END
        ),
    )
    factor = spend("solve", lambda: solver_for(made, Solver()).factorise(model.stiffness + tie))
    found = spend("solve", lambda: factor.solve(pull + load))
    cost.unknowns = made.n_unknowns
    cost.error = field_errors(model, found, displacement, strain, 2 * degree + 6).energy
    return cost


def finite_elements(degree: int, cells: int) -> Cost:
    import skfem
    from skfem.helpers import ddot, sym_grad
    from skfem.models.elasticity import linear_elasticity

    cost = Cost()
    spend = cost.spend
    element = {1: skfem.ElementTriP1, 2: skfem.ElementTriP2, 3: skfem.ElementTriP3}[degree]()
    line = np.linspace(0, 1, cells + 1)

    def lay():
        mesh = skfem.MeshTri.init_tensor(line, line)
        return skfem.Basis(mesh, skfem.ElementVector(element), intorder=2 * degree)

    basis = spend("mesh", lay)
    matrix = spend("assembly", lambda: skfem.asm(linear_elasticity(D[0, 1], D[2, 2]), basis))

    @skfem.LinearForm
    def force(v, w):
        x, y = np.pi * w.x
        return FACTOR * (np.sin(x) * np.cos(y) * v[0] + np.cos(x) * np.sin(y) * v[1])

    load = spend("load", lambda: force.assemble(basis))

    def solve():
        x = np.zeros(basis.N)
        dofs = basis.get_dofs().flatten()
        places = basis.doflocs[:, dofs].T
        first = np.isin(dofs, basis.get_dofs().all("u^1"))
        values = displacement(places)
        x[dofs] = np.where(first, values[:, 0], values[:, 1])
        inner = np.setdiff1d(np.arange(basis.N), dofs)
        rest = load - matrix @ x
        factor = solver_for(Independent(), Solver()).factorise(matrix[inner][:, inner])
        x[inner] = factor.solve(rest[inner])
        return x

    found = spend("solve", solve)

    @skfem.Functional
    def error(w):
        p = np.moveaxis(w.x, 0, -1)
        exact = np.moveaxis(strain(p.reshape(-1, 2)).reshape(*p.shape[:-1], 3), -1, 0)
        e = sym_grad(w["u"])
        d = np.array(
            [
                [e[0, 0] - exact[0], e[0, 1] - exact[2] / 2],
                [e[1, 0] - exact[2] / 2, e[1, 1] - exact[1]],
            ]
        )
        return D[0, 1] * (d[0, 0] + d[1, 1]) ** 2 + 2 * D[2, 2] * ddot(d, d)

    @skfem.Functional
    def size(w):
        p = np.moveaxis(w.x, 0, -1)
        exact = np.moveaxis(strain(p.reshape(-1, 2)).reshape(*p.shape[:-1], 3), -1, 0)
        trace = exact[0] + exact[1]
        return D[0, 1] * trace**2 + 2 * D[2, 2] * (
            exact[0] ** 2 + exact[1] ** 2 + exact[2] ** 2 / 2
        )

    fine = skfem.Basis(basis.mesh, basis.elem, intorder=2 * degree + 4)
    cost.unknowns = basis.N
    cost.error = float(
        np.sqrt(error.assemble(fine, u=fine.interpolate(found)) / size.assemble(fine))
    )
    return cost


class Independent:
    """Finite elements have no dependent functions."""

    dependent = 0


def median(costs: list[Cost]) -> Cost:
    phases = costs[0].seconds
    return Cost(
        int(np.median([c.unknowns for c in costs])),
        float(np.median([c.error for c in costs])),
        {name: float(np.median([c.seconds[name] for c in costs])) for name in phases},
    )


def at_error(costs: list[Cost], error: float) -> tuple[float, float]:
    """Seconds and unknowns at an error, interpolated between logarithms; not a number outside."""
    order = np.argsort([c.error for c in costs])
    logs = np.log([costs[k].error for k in order])
    if not logs[0] <= np.log(error) <= logs[-1]:
        return np.nan, np.nan
    seconds = np.interp(np.log(error), logs, np.log([costs[k].total for k in order]))
    unknowns = np.interp(np.log(error), logs, np.log([costs[k].unknowns for k in order]))
    return float(np.exp(seconds)), float(np.exp(unknowns))


def main(largest: int = 40_000, positions: int = 20, repeats: int = 3) -> dict[str, list[Cost]]:
    """Print all costs and the ratios at equal errors; return the costs."""
    rng = np.random.default_rng(0)
    places = [(rng.uniform(0, np.pi / 3), tuple(rng.uniform(0, 1, 2))) for _ in range(positions)]
    manifold(1, 0.2, *places[0]), finite_elements(2, 4)  # warm up
    found: dict[str, list[Cost]] = {}
    print(f"{'method':12} {'unknowns':>9} {'error':>10} {'worst':>10} {'seconds':>8}  phases")
    for degree in (0, 1, 2):
        name, cells = f"manifold {degree}", 8
        found[name] = []
        while 2.4 * cells**2 * (degree + 1) * (degree + 2) / 2 < largest:
            few = places if cells <= 32 else places[:5]
            runs = [manifold(degree, 1 / cells, *place) for place in few]
            _report(found, name, runs)
            cells *= 2
    for degree in (1, 2, 3):
        name, cells = f"P{degree}", 8
        found[name] = []
        while 2 * (degree * cells) ** 2 < largest:
            _report(found, name, [finite_elements(degree, cells) for _ in range(repeats)])
            cells *= 2
    print("\nat equal error: seconds and unknowns of the manifold over those of P(degree + 1)")
    for degree in (0, 1, 2):
        for error in (3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5):
            ours, theirs = (
                at_error(found[name], error) for name in (f"manifold {degree}", f"P{degree + 1}")
            )
            if np.isfinite([*ours, *theirs]).all():
                ratios = f"{ours[0] / theirs[0]:.2f} {ours[1] / theirs[1]:.2f}"
                print(f"degree {degree}, error {error:.0e}: {ratios}")
    return found


def _report(found: dict[str, list[Cost]], name: str, runs: list[Cost]) -> None:
    middle = median(runs)
    found[name].append(middle)
    worst = max(run.error for run in runs)
    phases = ", ".join(f"{key} {value:.3f}" for key, value in middle.seconds.items())
    numbers = f"{middle.unknowns:9,} {middle.error:10.2e} {worst:10.2e} {middle.total:8.3f}"
    print(f"{name:12} {numbers}  {phases}")


if __name__ == "__main__":
    main(*(int(item) for item in sys.argv[1:2]))
