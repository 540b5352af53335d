"""Matter that has next to no stiffness against a motion: it flows, softens or is a mechanism."""

from dataclasses import replace

from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.solvers.unchecked import product
from nmm.stepping.step.linear.equations import Linearisation
from nmm.stepping.step.nonlinear.iterate import Iterate, Solve

# Stiffness against the last iteration's motion, as a share of the elastic one, that shows flow.
FLOWS = 1e-2
# Share of the elastic stiffness that shows what yielding matter moves along, and that may be left
# against a mechanism.
TRACE = 1e-6


def flow(elastic: csc_array | None, line: Linearisation, way: Floats, softens: bool) -> str:
    """Say how little of its elastic stiffness matter has against a motion (n,); empty if enough.

    Where it ``softens`` some motion of the iterations took work of second order below zero (Hill
    1958); the last one may be of matter that unloads again, with all of its stiffness.
    """
    if softens:
        return "matter softens faster than what is about it unloads"
    if elastic is None:
        return ""
    whole = float(way @ (elastic @ way))
    left = float(way @ (line.stiffness @ way)) / whole if whole > 0 else 1.0
    return (
        f"matter flows with {max(left, 0.0):.1e} of its elastic stiffness" if left < FLOWS else ""
    )


def mechanism(
    elastic: csc_array, line: Linearisation, now: Iterate, solve: Solve, size: float
) -> str:
    """Say that matter yields all along a motion; empty where none is found.

    With traces of its ``elastic`` stiffness besides, one twice the other, matter moves by what it
    does not resist once and half of it: further than the ``size`` of the domain (m), beside
    contact, is no solution, but such a motion.
    """
    moved = []
    for trace in (TRACE * elastic, 2 * TRACE * elastic):
        force = line.force - product(trace, now.increment)
        moved.append(solve(replace(line, stiffness=line.stiffness + trace, force=force), None)[1])
    way = moved[0].increment - moved[1].increment
    left, whole = (float(way @ product(matrix, way)) for matrix in (line.stiffness, elastic))
    found = all(one.converged or one.motion > size for one in moved)
    if not found or left >= TRACE * whole:
        return ""
    return (
        f"matter yields all along a motion, against which less than {TRACE:.0e} of its elastic "
        "stiffness is left: its limit load is passed"
    )
