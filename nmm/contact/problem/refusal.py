"""What is wrong with a contact problem that no enforcement could make sense of, by name."""

from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Bools, Floats
from nmm.errors import SolveError

if TYPE_CHECKING:
    from nmm.contact.problem.step_problem import StepProblem

LISTED = ("slip", "normal_stiffness", "shear_stiffness", "normal_force", "shear_force", "state")


def refuse(problem: "StepProblem") -> None:
    """Refuse shapes and numbers that a solution cannot start from.

    Raises
    ------
    SolveError
        Naming the first array at fault.
    """
    limits = vars(problem.limits)
    columns = {name: getattr(problem, name) for name in LISTED} | limits
    _sizes(problem, columns)
    finite = {"matrix": problem.matrix.data, "force": problem.force, "gap": problem.gap}
    finite |= {name: getattr(problem, name).data for name in ("normal_rows", "tangent_rows")}
    finite |= {name: columns[name] for name in ("slip", "friction", *LISTED[1:3])}
    for name, array in finite.items():
        at = _first(np.isfinite(array))
        if at is not None:
            raise SolveError(
                f"contact problem: {name}[{at}] = {array[at]}: expected finite numbers: "
                "check loads and stiffnesses, or shorten the step"
            )
    positive = {name: columns[name] > 0 for name in LISTED[1:3]}
    for name, good in (positive | {name: one >= 0 for name, one in limits.items()}).items():
        at = _first(good)
        if at is not None:
            raise SolveError(
                f"contact problem: {name} of contact {at}: {columns[name][at]}: "
                "expected a positive number (limits may be 0)"
            )


def _sizes(problem: "StepProblem", columns: dict[str, Floats]) -> None:
    n, m = len(problem.force), problem.n_contacts
    sizes: dict[str, tuple[Any, Any]] = {"matrix": (problem.matrix.shape, (n, n))}
    for name in ("normal_rows", "tangent_rows"):
        sizes[name] = (getattr(problem, name).shape, (m, n))
    sizes |= {name: (np.shape(column), (m,)) for name, column in columns.items()}
    for name, (found, expected) in sizes.items():
        if found != expected:
            raise SolveError(f"contact problem: {name} {found}: expected {expected}")


def _first(good: Bools) -> int | None:
    """Number of the first entry at fault; None without any."""
    bad = np.flatnonzero(~good)
    return int(bad[0]) if len(bad) else None
