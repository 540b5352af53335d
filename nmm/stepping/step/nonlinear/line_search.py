"""How far an iteration goes: the whole step, or less where forces overshoot along it."""

from nmm.stepping.step.linear.equations import Equations, Linearisation
from nmm.stepping.step.nonlinear.inner import InternalForces
from nmm.stepping.step.nonlinear.iterate import Iterate

# A full step is taken when it leaves at most this share of its slope; else it is shortened, at most
# so often, down to this share of it.
SLOPE, TRIALS, SHORTEST_PART = 0.8, 6, 0.05


def searched(
    equations: Equations,
    line: Linearisation,
    now: Iterate,
    then: Iterate,
    inner: InternalForces,
) -> Iterate:
    """Return the next iterate: the whole step, or less where the forces overshoot along it.

    Contact and support forces are held as the solution has them, so that the slope of the energy
    along the step is ``-p A p`` at its start and what matter adds to its line at any share of it.
    """
    way = then.increment - now.increment
    share = _share_of_matter(equations)
    curved = float(way @ (equations.matrix @ way))
    bent = line.stiffness @ way

    def slope(one: Iterate, part: float) -> float:
        missed = one.force - now.force - part * bent
        return (part - 1) * curved + share * float(way @ missed)

    found, part, ends = then, 1.0, [(0.0, -curved), (1.0, slope(then, 1.0))]
    for _ in range(TRIALS):
        last = ends[1][1]
        if curved <= 0 or last <= SLOPE * curved or part <= SHORTEST_PART:
            break
        (low, falls), (high, rises) = ends
        part = max(low - falls * (high - low) / (rises - falls), SHORTEST_PART)
        found = inner.at(now.increment + part * way, now)
        now_slope = slope(found, part)
        if abs(now_slope) <= SLOPE * curved:
            break
        ends = [ends[0], (part, now_slope)] if now_slope > 0 else [(part, now_slope), ends[1]]
    return found


def _share_of_matter(equations: Equations) -> float:
    """Factor of the tangent in the matrix of a step."""
    terms = equations.inertia
    return 1.0 if terms is None else terms.weight / terms.contact_factor
