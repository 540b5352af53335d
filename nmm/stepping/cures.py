"""What a cover needs of the solver, and what is said about it."""

from typing import TYPE_CHECKING

from nmm.solvers.linear import LinearSolver, make_solver

if TYPE_CHECKING:
    from covers.manifold import Manifold
    from nmm.formulation import Solver


def solver_for(manifold: "Manifold", solver: "Solver") -> LinearSolver:
    """Return the linear solver, with a shift when functions of the cover are dependent.

    The shift adds 1e-10 of the diagonal to the decomposition and refinement removes it again; the
    displacements are unique whatever the shift (Duarte, Babuska and Oden 2000).
    """
    made = make_solver(solver.type, solver.options)
    return made.deflated() if manifold.dependent and not made.shift else made


def cures(manifold: "Manifold", solver: LinearSolver) -> dict[str, int]:
    """Return the cures at work, each with the number of functions or covers it acts on."""
    found = {}
    if manifold.dependent:
        found[f"dependent functions, diagonal shift {solver.shift:g}"] = manifold.dependent
    if manifold.fitted:
        found["covers in coordinates fitted to the cut"] = manifold.fitted
    if manifold.enriched:
        found["covers with singular functions"] = manifold.enriched
    return found
