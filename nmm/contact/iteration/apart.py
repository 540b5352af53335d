"""Islands solved separately: each takes the passes it needs, none where its start balances.

An island is left alone in a step where the unknowns that it starts from, a mix of its own last
ones, balance its equations to the tolerance. These are the equations of the step with inertia,
loads and contacts as they now are: nothing is supposed of an island that seems to rest, and what
wakes it (a load, an impact, ground that moves) is seen in its balance.
"""

from collections.abc import Callable
from math import ceil

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.islands.part import part_of
from nmm.contact.islands.partition import Islands, balances
from nmm.contact.iteration.options.budgets import SMALL
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.cut_springs import CutSprings, IterationResult

Together = Callable[[CutSprings, Tools, Floats], IterationResult]
"""Solves springs from an increment with what is kept of them."""


def apart_in(springs: CutSprings, tools: Tools) -> Islands | None:
    """Return the islands of a problem; None where it is to be solved as one."""
    if not tools.options.islands.rounds or len(springs.problem.force) <= SMALL:
        return None
    found = tools.memory.islands_of(springs)
    return found if found.apart else None


def solve_apart(
    springs: CutSprings,
    islands: Islands,
    tools: Tools,
    tolerance: float,
    start: Floats,
    together: Together,
) -> IterationResult:
    """Balance each island from ``start`` (n,), and all together where that is not enough.

    Solves of a part count by its share of the unknowns.
    """
    problem, at, n, options = springs.problem, start.copy(), len(start), tools.options.islands
    solves, factors, woken = 0.0, 0, np.zeros(islands.count, dtype=bool)
    scale = np.zeros(islands.count)
    for _ in range(options.rounds):
        force = springs.residual(at).force
        rest, largest = balances(at, force, islands.unknown, islands.count, springs.columns)
        # What was solved with others is judged beside them.
        scale = np.maximum(scale, largest)
        busy = rest > tolerance * scale
        if not busy.any():
            break
        # Held bodies alone only once what stands on them is settled.
        busy = busy & ~islands.held if (busy & ~islands.held).any() else busy
        woken |= busy
        parts = _parts(islands, busy, options.alone)
        if max(float(chosen[islands.unknown].mean()) for chosen in parts) > options.most:
            break
        for chosen in parts:
            unknowns, contacts = islands.around(problem, chosen)
            part = part_of(springs, unknowns, contacts, at)
            found = together(part, tools.of_part(unknowns), at[unknowns])
            at[unknowns] = found.increment
            scale[chosen] = np.linalg.norm(scale[np.unique(islands.unknown[unknowns])])
            solves += found.solves * len(unknowns) / n
            factors += found.factorisations
    size = springs.residual(at).size
    quiet = f"{islands.count - int(woken.sum())} of {islands.count} islands left alone"
    spent = f"{ceil(solves)} solves with {factors or 'no'} new factors, {quiet}"
    found = IterationResult(springs, at, size, ceil(solves), factors, spent)
    return found if size <= tolerance else found.then(together(springs, tools, at))


def _parts(islands: Islands, busy: Bools, alone: int) -> list[Bools]:
    """Each large island that is ``busy`` (I,), and all small ones as one (I,)."""
    large = busy & (np.bincount(islands.unknown, minlength=islands.count) >= alone)
    parts = [np.arange(islands.count) == one for one in np.flatnonzero(large)]
    return [*parts, busy & ~large] if (busy & ~large).any() else parts
