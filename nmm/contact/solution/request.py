"""What a step asks of contact."""

from collections.abc import Callable
from dataclasses import dataclass

from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.contact.enforcement.null_space import NullSpace
from nmm.contact.solution.record import Breaking
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
        Share of its end in the stretch of springs (`nmm.contact.laws.time_weighting`).
    null_space
        Conditions on the unknowns besides.
    breaking
        Which bonds break at a time: "all", the "worst" alone, or "stop": none, the step ends there
        and is no equilibrium.
    near
        Whether an increment (n,) moves no further than contacts were sought: no bond is judged by
        one that does. None: none does.
    lost
        Energy (J) that bonds lost which broke before, in the same step.
    time
        At its end (s); None where nothing hangs on it.
    foreseen
        (n,) an increment near the answer, about which springs conserve energy; None where they are
        posed as lines from the start.
    among
        See `StepProblem`.
    """

    matrix: csc_array
    force: Floats
    solver: LinearSolver
    step: float | None = None
    weight: float = 1.0
    null_space: NullSpace | None = None
    breaking: Breaking = "all"
    near: Callable[[Floats], bool] | None = None
    lost: float = 0.0
    time: float | None = None
    foreseen: Floats | None = None
    among: Floats | None = None
