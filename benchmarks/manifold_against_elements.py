"""What the manifold costs on a smooth problem beside finite elements of the same order.

The problem has an exact smooth solution with displacements prescribed on all sides of the unit
square (E = 1, nu = 0.3, plane stress). The manifold of order p stands beside finite elements of
order p + 1 (scikit-fem with strong supports and the same direct solver), all in one run on one
thread. Seconds are processor seconds, the least of some repetitions; errors are not timed. Run:
``OPENBLAS_NUM_THREADS=1 python benchmarks/manifold_against_elements.py``.
"""

from __future__ import annotations

import platform
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from time import process_time

import numpy as np
import scipy
import skfem
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu
from skfem.models.elasticity import linear_elasticity

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
from nmm.materials.elastic import Elastic
from nmm.stepping.equilibrium import body_force, equilibrium, hold

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
LAW = Elastic(1.0, 0.3)
D = LAW.stiffness("stress")

MANIFOLD_SIZES = {0: (16, 32, 64, 128), 1: (8, 16, 32, 64), 2: (4, 8, 16, 32)}
ELEMENT_SIZES = {1: (16, 32, 64, 128, 192), 2: (8, 16, 32, 64, 96), 3: (4, 8, 16, 32, 48)}
SWEPT = {0: 64, 1: 32, 2: 16}
TRIANGLE = {
    1: skfem.ElementTriP1,
    2: skfem.ElementTriP2,
    3: skfem.ElementTriP3,
}


@dataclass(frozen=True)
class Cost:
    """One solution: what it cost and how far it is off.

    Attributes
    ----------
    seconds
        By phase.
    """

    method: str
    n: int
    unknowns: int
    error: float
    seconds: dict[str, float]

    @property
    def total(self) -> float:
        """Seconds of all phases."""
        return sum(self.seconds.values())


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
        self.seconds: dict[str, float] = {}
        self._last = process_time()

    def stop(self, name: str) -> None:
        """Count the time since the last call for ``name``."""
        now = process_time()
        self.seconds[name] = self.seconds.get(name, 0.0) + now - self._last
        self._last = now


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


def manifold(degree: int, n: int, make: Callable[[], Triangles], kind: str) -> Cost:
    """Solve with covers of a degree by Nitsche's method on all sides."""
    clock = Clock()
    cover = make()
    pieces = cut(cover, SQUARE)
    clock.stop("cutting")
    made = mesh_manifold(cover, pieces, Monomials(degree))
    clock.stop("moments")
    count = len(made.elements)
    elasticity = np.broadcast_to(D, (count, 3, 3))
    model = Model(made, elasticity, np.zeros(count), np.ones(count), 1.0, pieces)
    _ = model.stiffness
    clock.stop("assembly")
    place = on_edges(made, np.ones(len(made.boundary), dtype=bool), 2 * degree + 2)
    effects = [
        hold(model, place, Method("nitsche", 1 / n, degree), displacement),
        body_force(model, load, 2 * degree + 2),
    ]
    clock.stop("supports and loads")
    found = equilibrium(model, effects)
    clock.stop("solve")
    assert found.residual < 1e-9
    off = field_errors(model, found.state.deformation, displacement, strain, 2 * degree + 4)
    return Cost(f"NMM{degree} {kind}", n, made.n_unknowns, off.energy, clock.seconds)


def elements(order: int, n: int) -> Cost:
    """Solve with finite elements; strong supports, tuned direct solver."""
    clock = Clock()
    line = np.linspace(0, 1, n + 1)
    mesh = skfem.MeshTri.init_tensor(line, line)
    kind = skfem.ElementVector(TRIANGLE[order]())
    clock.stop("mesh")
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
    clock.stop("supports and loads")
    reduced, rest, _, free = skfem.condense(matrix, force, x=u, D=held)
    system = csc_array(reduced)
    factor = splu(
        csc_array(
            (system.data, system.indices.astype(np.intc), system.indptr.astype(np.intc)),
            shape=system.shape,
        ),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    u[free] = factor.solve(rest)
    clock.stop("solve")
    return Cost(f"P{order}", n, len(u), _error(mesh, kind, order, u), clock.seconds)


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


def least(work: Callable[[], Cost], repeats: int) -> Cost:
    """Return the run of least total seconds."""
    return min((work() for _ in range(repeats)), key=lambda cost: cost.total)


def at_error(baseline: list[Cost], error: float) -> tuple[float, float]:
    """Seconds and unknowns of the baseline at an error, by log-log interpolation.

    Beyond the sizes solved the last two are prolonged.
    """
    x = np.log([cost.error for cost in baseline])
    found = []
    for values in ([c.total for c in baseline], [float(c.unknowns) for c in baseline]):
        y = np.log(values)
        k = int(np.clip(np.searchsorted(-x, -np.log(error)) - 1, 0, len(x) - 2))
        slope = (y[k + 1] - y[k]) / (x[k + 1] - x[k])
        found.append(float(np.exp(y[k] + slope * (np.log(error) - x[k]))))
    return found[0], found[1]


def ratios(costs: Iterable[Cost], baseline: list[Cost]) -> Floats:
    """Ratios (m, 2) of seconds and unknowns to the baseline's at equal error."""
    return np.array(
        [np.array([cost.total, cost.unknowns]) / at_error(baseline, cost.error) for cost in costs]
    )


def positions(number: int) -> list[tuple[float, tuple[float, float]]]:
    """Random turns and shifts of the net."""
    random = np.random.default_rng(1)
    return [(float(a), (float(s), float(t))) for a, s, t in random.uniform(size=(number, 3))]


def row(cost: Cost) -> str:
    """One line of the table."""
    s = cost.seconds
    first = s.get("cutting", s.get("mesh", 0.0))
    return (
        f"| {cost.method} | {cost.n} | {cost.unknowns} | {cost.error:.2e} | {first:.3f} "
        f"| {s.get('moments', 0.0):.3f} | {s['assembly']:.3f} | {s['supports and loads']:.3f} "
        f"| {s['solve']:.3f} | {cost.total:.3f} |"
    )


def on_fitted(degree: int, n: int) -> Cost:
    """Solve on right triangles that fit."""
    return manifold(degree, n, partial(fitted, n), "fitted")


def on_cut(degree: int, n: int, angle: float, shift: tuple[float, float]) -> Cost:
    """Solve on Shi's net at a position."""
    return manifold(degree, n, partial(net, n, angle, shift), "cut")


def main(repeats: int = 3, cuts: int = 20, largest: int = 4) -> dict[str, object]:
    """Solve all and return the costs, the ratios and the lines of the report.

    Parameters
    ----------
    repeats
        Of every solution; the least counts.
    cuts
        Random positions of the net.
    largest
        How many of the sizes of each method are solved.
    """
    base = {
        order: [least(partial(elements, order, n), repeats) for n in sizes[: largest + 1]]
        for order, sizes in ELEMENT_SIZES.items()
    }
    lines = [
        f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}, "
        f"scipy {scipy.__version__}, scikit-fem {skfem.__version__}; one thread, least of "
        f"{repeats} runs, {cuts} positions of the net",
        "",
        "| method | n | unknowns | energy error | cutting | moments | assembly | supports, loads "
        "| solve | total s |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    lines += [row(cost) for costs in base.values() for cost in costs]
    summary, found = [], {}
    for degree, sizes in MANIFOLD_SIZES.items():
        fit = [least(partial(on_fitted, degree, n), repeats) for n in sizes[:largest]]
        first = positions(1)[0]
        series = [least(partial(on_cut, degree, n, *first), repeats) for n in sizes[:largest]]
        n = min(SWEPT[degree], sizes[:largest][-1])
        swept = [least(partial(on_cut, degree, n, *place), repeats) for place in positions(cuts)]
        lines += [row(cost) for cost in (*fit, *series)]
        for name, costs in (("fitted", fit[1:]), ("cut", swept)):
            ratio = ratios(costs, base[degree + 1])
            found[f"{degree} {name}"] = ratio
            summary.append(_ratio_row(f"order {degree} {name}", degree + 1, costs, ratio))
    lines += [
        "",
        "| manifold | against | energy error | seconds, median | worst "
        "| unknowns, median | worst |",
        "|---|---|---|---|---|---|---|",
        *summary,
    ]
    return {"elements": base, "ratios": found, "lines": lines}


def _ratio_row(name: str, order: int, costs: list[Cost], ratio: Floats) -> str:
    middle, worst = np.median(ratio, axis=0), ratio.max(axis=0)
    errors = [cost.error for cost in costs]
    return (
        f"| {name} | P{order} | {min(errors):.1e} .. {max(errors):.1e} "
        f"| {middle[0]:.2f} | {worst[0]:.2f} | {middle[1]:.2f} | {worst[1]:.2f} |"
    )


if __name__ == "__main__":
    report = main()
    text = "\n".join(report["lines"])  # type: ignore[arg-type]
    print(text)
    if len(sys.argv) > 1:
        Path(sys.argv[1]).write_text(text + "\n")
