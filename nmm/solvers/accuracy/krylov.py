"""Minimal residuals over a few directions, with an approximate inverse in hand (Saad 1986)."""

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats

Map = Callable[[Floats], Floats]

DIRECTIONS = 12
"""Most steps before a restart: directions in which a shift is taken out at once."""


def minimal_residual(
    product: Map,
    inverse: Map,
    rhs: Floats,
    *,
    tolerance: float,
    rounds: int = 3,
    start: Floats | None = None,
) -> Floats:
    """Solve ``product(x) = rhs`` by GMRES with ``inverse`` on the right.

    A decomposition of a matrix shifted by a small part of its diagonal inverts all of it well but
    for the few directions whose stiffness is not above the shift; as many steps as there are such
    directions make up for them, where plain refinement needs hundreds.

    Parameters
    ----------
    product, inverse
        The matrix and the approximate inverse.
    rhs
        (n,) load.
    tolerance
        Residual over load at which to stop.
    rounds
        Most starts, each of at most `DIRECTIONS` steps.
    start
        Where to start, zero when not given; it may be of another size than the load where a
        solution has more than one form.
    """
    size = float(np.linalg.norm(rhs))
    x, rest = (np.zeros_like(rhs), rhs) if start is None else (start, rhs - product(start))
    last = np.inf
    for _ in range(rounds):
        found = float(np.linalg.norm(rest))
        if found <= tolerance * size or found > 0.5 * last:
            break
        last = found
        step = _round(product, inverse, rest, tolerance * size)
        tried = x + step
        new = rhs - product(tried)
        if not float(np.linalg.norm(new)) < found:
            break
        x, rest = tried, new
    return x


def _round(product: Map, inverse: Map, rest: Floats, goal: float) -> Floats:
    norm = float(np.linalg.norm(rest))
    basis: list[Floats] = [rest / norm]
    steps: list[Floats] = []
    table = np.zeros((DIRECTIONS + 1, DIRECTIONS))
    answer: Floats = np.zeros(0)
    for k in range(DIRECTIONS):
        steps.append(inverse(basis[k]))
        image = product(steps[k])
        whole = float(np.linalg.norm(image))
        for _ in range(2):  # orthogonal to rounding
            for j, known in enumerate(basis):
                share = float(known @ image)
                table[j, k] += share
                image = np.asarray(image - share * known)
        table[k + 1, k] = np.linalg.norm(image)
        target = np.zeros(k + 2)
        target[0] = norm
        part = table[: k + 2, : k + 1]
        answer = np.asarray(np.linalg.lstsq(part, target, rcond=None)[0], dtype=np.float64)
        left = float(np.linalg.norm(part @ answer - target))
        if left <= goal or table[k + 1, k] <= 1e-14 * whole:
            break
        basis.append(image / table[k + 1, k])
    total = np.zeros_like(steps[0])
    for share, step in zip(answer, steps, strict=True):
        total = total + share * step
    return total
