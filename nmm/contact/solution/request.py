"""The problem that a step hands to the contact solution."""

from collections.abc import Callable
from dataclasses import dataclass

from integration.arrays import Floats
from integration.sparse import csc_array
from nmm.contact.enforcement.null_space import NullSpace
from nmm.contact.solution.record import Breaking, BrokenBonds
from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class StepRequest:
    """Balance of a step without contact, ``matrix @ d = force``, and how it is to be solved.

    Attributes
    ----------
    matrix, force
        (n, n) and (n,).
    solver
        Factorises the matrices.
    step
        Its length (s); None in statics.
    weight
        Weight of its end in the stretch of springs (`nmm.contact.laws.time_weighting`).
    null_space
        Further linear constraints on the unknowns.
    breaking
        Which bonds break at a time: "all", the "worst" alone, or "stop": none, the step ends there
        and is no equilibrium.
    near
        Whether an increment (n,) stays within the reach of the contact search, without which no
        bond is judged. None: every increment does.
    broken
        Bonds that broke earlier in the same step; None where none did.
    uncovers
        Whether ends of joints bear once these bonds broke that are not among the contacts.
        None: they never have.
    time
        At its end (s); None where nothing depends on time.
    foreseen
        (n,) a predicted increment, at which energy-conserving springs are linearised; None where
        springs are linear from the start.
    among
        See `StepProblem`.
    carried
        (n,) motion of bodies with driven ground, from the end of which unknowns count; None
        where there is none.
    """

    matrix: csc_array
    force: Floats
    solver: LinearSolver
    step: float | None = None
    weight: float = 1.0
    null_space: NullSpace | None = None
    breaking: Breaking = "all"
    near: Callable[[Floats], bool] | None = None
    broken: BrokenBonds | None = None
    uncovers: Callable[[BrokenBonds], bool] | None = None
    time: float | None = None
    foreseen: Floats | None = None
    among: Floats | None = None
    carried: Floats | None = None
