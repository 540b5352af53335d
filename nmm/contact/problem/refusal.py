"""What is wrong with a contact problem that no enforcement could make sense of, by name."""

import math

import numpy as np

from integration.arrays import Floats
from nmm.compiled import compiled
from nmm.contact.problem.step_problem import COLUMNS, STIFFNESSES, StepProblem
from nmm.errors import SolveError

MATRICES = ("matrix", "normal_rows", "tangent_rows")


def refuse(problem: StepProblem) -> None:
    """Refuse shapes and numbers that no enforcement could make sense of.

    Raises
    ------
    SolveError
        Naming the first array at fault.
    """
    n, m, limits = len(problem.force), len(problem.gap), vars(problem.limits)
    given = vars(problem) | limits
    matrices = dict.fromkeys(MATRICES, (m, n)) | {"matrix": (n, n)}
    for name, expected in (matrices | dict.fromkeys((*COLUMNS, *limits), (m,))).items():
        if given[name].shape != expected:
            raise SolveError(f"contact problem: {name} {given[name].shape}: expected {expected}")
    finite = {name: given[name].data for name in MATRICES} | {"force": problem.force}
    held = [given[name] for name in ("gap", "slip", *STIFFNESSES, *limits)]
    if sound(*finite.values(), *held):
        return
    finite |= {name: given[name] for name in ("gap", "slip", "friction", *STIFFNESSES)}
    for name, array in finite.items():
        if not np.isfinite(array).all():
            at = int(np.isfinite(array).argmin())
            raise SolveError(
                f"contact problem: {name}[{at}] = {array[at]}: expected finite numbers: "
                "check loads and stiffnesses, or shorten the step"
            )
    for name in (*STIFFNESSES, *limits):
        good = given[name] > 0 if name in STIFFNESSES else given[name] >= 0
        if not good.all():
            at = int(good.argmin())
            raise SolveError(
                f"contact problem: {name} of contact {at}: {given[name][at]}: "
                "expected a positive number (limits may be 0)"
            )


@compiled
def sound(
    matrix: Floats,
    normal_rows: Floats,
    tangent_rows: Floats,
    force: Floats,
    gap: Floats,
    slip: Floats,
    normal: Floats,
    shear: Floats,
    tension: Floats,
    cohesion: Floats,
    friction: Floats,
) -> bool:
    """Whether all numbers are finite, stiffnesses positive and limits not negative."""
    good = _finite(matrix) and _finite(normal_rows) and _finite(tangent_rows) and _finite(force)
    for c in range(len(gap)):
        # What is no number is neither.
        good &= math.isfinite(gap[c]) and math.isfinite(slip[c]) and 0.0 <= friction[c] < math.inf
        good &= 0.0 < normal[c] < math.inf and 0.0 < shear[c] < math.inf
        good &= tension[c] >= 0.0 and cohesion[c] >= 0.0
    return good


@compiled
def _finite(numbers: Floats) -> bool:
    good = True
    for number in numbers:
        good &= math.isfinite(number)
    return good
