"""The manifold beside finite elements at equal energy error, from cover or mesh to solution.

*Over elements*: ratios of seconds (each side with its faster solver) and of unknowns, elements
interpolated between the sizes solved.
"""

from collections.abc import Callable, Iterator
from functools import cache, partial
from typing import Any

import numpy as np
import pytest
import singular_costs
import smooth_costs
from smooth_costs import Cost

SIZES = {0: (64, 128), 1: (32, 64), 2: (16, 32)}
"""Cells along a side, by degree of the manifold."""
ELEMENTS = {1: (32, 64, 128, 256), 2: (16, 32, 64, 128), 3: (8, 16, 32, 64)}
"""Cells along a side, by order of the elements: errors of the manifold lie between theirs."""


@cache
def smooth_elements(order: int) -> list[Cost]:
    """Solve the smooth problem with elements of all sizes."""
    smooth_costs.elements(order, 8)  # loads what is loaded once
    return [smooth_costs.elements(order, n) for n in ELEMENTS[order]]


@cache
def graded_elements(problem: str, order: int) -> list[Cost]:
    """Solve a singular problem with graded elements of all sizes."""
    made = getattr(singular_costs, problem)()
    meshes = [
        partial(singular_costs.graded_mesh, made, size, order)
        for size in singular_costs.GRADED[order]
    ]
    return [singular_costs.elements(made, order, mesh, "graded") for mesh in meshes]


def at_error(baseline: list[Cost], values: list[float], error: float) -> float:
    """Return a value of the baseline at an error, by logarithms; NaN beyond the errors solved."""
    x, y = np.log(sorted((cost.error, v) for cost, v in zip(baseline, values, strict=True))).T
    return float(np.exp(np.interp(np.log(error), x, y, left=np.nan, right=np.nan)))


Case = tuple[str, Callable[[], Cost], Callable[[], list[Cost]]]


def cases() -> Iterator[Case]:
    """Group, solution by the manifold, and solutions by elements."""
    for degree, sizes in SIZES.items():
        for n in sizes:
            other = partial(smooth_elements, degree + 1)
            yield "smooth", partial(smooth_costs.on_fitted, degree, n), other
            yield "smooth", partial(smooth_costs.on_cut, degree, n, 1), other
    for problem in ("crack", "corner"):
        for degree, singular in singular_costs.MANIFOLD.items():
            solve = partial(_singular, problem, degree, singular[-1])
            yield problem, solve, partial(graded_elements, problem, 3)


def _singular(problem: str, degree: int, n: int) -> Cost:
    return singular_costs.manifold(getattr(singular_costs, problem)(), degree, n, 1)


@pytest.mark.parametrize("case", list(cases()))
def test_manifold_beside_elements(benchmark: Any, case: Case) -> None:
    problem, solve, elements = case
    benchmark.group = f"manifold beside elements, {problem}"
    cost, others = benchmark.pedantic(solve, rounds=1, warmup_rounds=1), elements()
    seconds = at_error(others, [other.total() for other in others], cost.error)
    unknowns = at_error(others, [float(other.unknowns) for other in others], cost.error)
    benchmark.extra_info |= {
        "method": f"{cost.method}, {cost.n}",
        "unknowns": cost.unknowns,
        "energy error": cost.error,
        "against": others[0].method,
        "seconds over elements": cost.total() / seconds,
        "unknowns over elements": cost.unknowns / unknowns,
    }
