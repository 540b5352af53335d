"""Solver settings that a cover and a run need, and warnings about the model."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from nmm.model.locking import locking
from nmm.model.manifolds.tips import tip_warnings
from nmm.solvers.linear import LinearSolver, make_solver

if TYPE_CHECKING:
    from covers.approximation.manifold import Manifold
    from nmm.assembly.model import Model
    from nmm.constraints.supports import Supports
    from nmm.effects.given.setup import Setup
    from nmm.formulation import Solver

# Most steps of refinement that take the shift out again. They end when the residual does not fall;
# springs of 1e6 E make the shift, a share of their diagonal, as stiff as soft motions and want ten.
REFINEMENTS = 20
# Unknowns times steps, each with a matrix of its own, from which on compiled factorisations pay the
# 0.4 s that a start with the compiler takes longer: SuperLU takes 2 to 10 us an unknown more.
WORTH_COMPILER = 100_000


def solver_of_run(setup: "Setup", manifold: "Manifold", contact: bool) -> LinearSolver:
    """Return the linear solver of a run from a setup, on a manifold.

    Runs with ``contact`` import the compiler in any case.
    """
    step = setup.formulation.integrator.fixed_step if setup.scene.in_time else None
    # Small displacements keep one factor in all steps.
    steps = 0.0 if step is None or setup.small else (setup.scene.duration or 0.0) / step
    compiled = contact or steps * manifold.n_unknowns >= WORTH_COMPILER
    return solver_for(manifold, setup.formulation.solver, compiled)


def solver_for(manifold: "Manifold", solver: "Solver", compiled: bool = False) -> LinearSolver:
    """Return the linear solver, with a shift when functions of the cover are dependent.

    The shift adds 1e-10 of the diagonal to the decomposition and refinement removes it again; the
    displacements are unique whatever the shift (Duarte, Babuska and Oden 2000). A run that needs
    ``compiled`` code anyway factorises with it.
    """
    made = make_solver(solver.type, solver.options).beside(compiled)
    if not manifold.dependent or made.shift:
        return made
    return replace(made.deflated(), refinements=max(made.refinements, REFINEMENTS))


def cures(
    manifold: "Manifold", solver: LinearSolver, supports: "Supports | None" = None
) -> dict[str, int]:
    """Return the cures at work, each with the number of functions or covers it acts on."""
    found = {}
    if manifold.dependent:
        found[f"dependent functions, diagonal shift {solver.shift:g}"] = manifold.dependent
        found["covers that hold dependent functions"] = manifold.dependent_covers
    if manifold.fitted:
        found["covers in coordinates fitted to the cut"] = manifold.fitted
    if manifold.enriched:
        found["covers with singular functions"] = manifold.enriched
    found |= manifold.mended
    tied = 0 if supports is None else _covers(manifold, supports)
    if tied:
        found["covers tied to their neighbours beside supports (ghost)"] = tied
    return found


def warnings(model: "Model") -> list[str]:
    """Return what is known to spoil answers of the model: one sentence each."""
    locked = locking(model)
    return [*([] if locked is None else [locked]), *tip_warnings(model)]


def _covers(manifold: "Manifold", supports: "Supports") -> int:
    """Number of covers with unknowns in the ghost terms of supports."""
    return len(np.unique(manifold.unknown_cover[supports.tied_unknowns()]))
