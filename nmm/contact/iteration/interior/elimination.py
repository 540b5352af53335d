"""A step of the interior point in compiled passes over the contacts, a solve between two of them.

What stands where is said in `nmm.contact.iteration.interior.equations`, and of the sides of a
contact in `nmm.contact.iteration.interior.complementarity`.
"""

from typing import NamedTuple

import numpy as np

from integration.arrays import Bools, Floats
from nmm.compiled import compiled
from nmm.contact.iteration.interior.centrality import PointColumns
from nmm.contact.problem.residual_kernel import SpringColumns
from nmm.contact.problem.row_products import Compressed, products_along, push


class SideColumns(NamedTuple):
    """The sides of contacts as compiled code takes them, see `Complementarity`.

    Attributes
    ----------
    active, smooth
        (3, m) sides that exist, (m,) contacts without shear force.
    give, soft, compliance
        (2, m) of springs (m/N); the same with some of exact contacts; and of what these join.
    """

    active: Bools
    smooth: Bools
    give: Floats
    soft: Floats
    compliance: Floats


Rows = tuple[Compressed, Compressed]
"""Normal and tangent rows (m, n)."""

Reduced = tuple[Floats, Floats, Floats, Floats, Floats, Floats]
"""The equations at a point without the unknowns of the contacts:

the out-of-balance force (n,) in N; by how much gaps and slips (2, m) are not those of their forces
(m); by how much slack (3, m) is not what is left to the limits (N); flow over slack (3, m) in m/N;
normal and shear stiffness (N/m) and shear force for a normal force (-), (3, m); and the growth of
the bound with the pressure (m,)."""


@compiled
def over(one: float, other: float) -> float:
    """A quotient as arrays have it, infinite where the divisor has vanished."""
    return one / other if other != 0.0 else np.inf * one


@compiled
def reduced(at: PointColumns, springs: SpringColumns, sides: SideColumns, coupled: bool) -> Reduced:
    """Equations at a point; bounds follow the normal force where ``coupled``."""
    increment, normal, shear, slack, flow = at
    active, smooth, give, soft, compliance = sides
    shift, tension, friction = springs.shift, springs.tension, springs.friction
    m = len(normal)
    jump, lacks, ratio = np.empty((2, m)), np.zeros((3, m)), np.zeros((3, m))
    stiffness, slope = np.zeros((3, m)), np.zeros(m)
    products_along(springs.normal_rows, increment, jump[0])
    products_along(springs.tangent_rows, increment, jump[1])
    for c in range(m):
        jump[0, c] += springs.gap[c] - (normal[c] - shift[0, c]) * give[0, c]
        jump[1, c] += springs.slip[c] - (shear[c] - shift[1, c]) * give[1, c]
        if active[0, c]:
            ratio[0, c] = over(flow[0, c], slack[0, c])
            jump[0, c] -= flow[0, c]
            lacks[0, c] = slack[0, c] - (tension[c] - normal[c])
        if active[1, c]:
            ratio[1, c], ratio[2, c] = over(flow[1, c], slack[1, c]), over(flow[2, c], slack[2, c])
            jump[1, c] += flow[2, c] - flow[1, c]
            closes = slack[0, c] * compliance[0, c] > flow[0, c] or tension[c] > 0.0
            bound = springs.cohesion[c] if closes else 0.0
            bound += friction[c] * max(-normal[c], 0.0)
            lacks[1, c] = slack[1, c] - (bound - shear[c])
            lacks[2, c] = slack[2, c] - (bound + shear[c])
            slope[c] = friction[c] if coupled and normal[c] < 0.0 else 0.0
        stiffness[0, c] = over(1.0, soft[0, c] + ratio[0, c])
        if not smooth[c]:
            stiffness[1, c] = over(1.0, soft[1, c] + ratio[1, c] + ratio[2, c])
            stiffness[2, c] = stiffness[1, c] * (ratio[2, c] - ratio[1, c]) * slope[c]
    rest = np.empty(len(increment))
    products_along(springs.matrix, increment, rest)  # columns of a symmetric one serve as rows
    rest -= springs.load
    push(springs.normal_rows, springs.tangent_rows, normal, shear, rest)
    return rest, jump, lacks, ratio, stiffness, slope


@compiled
def load_for(
    targets: Floats, slack: Floats, given: Reduced, rows: Rows, active: Bools
) -> tuple[Floats, Floats, Floats]:
    """Load (n,) of a step whose products of slack and flow change by ``targets`` (3, m).

    Besides, the jumps (2, m) and flow (3, m) of it that are known.
    """
    rest, jump, lacks, ratio, stiffness, _ = given
    m = slack.shape[1]
    known, flow = np.empty((2, m)), np.zeros((3, m))
    normal, shear, load = np.empty(m), np.empty(m), rest.copy()
    for c in range(m):
        for side in range(3):
            if active[side, c]:
                flow[side, c] = over(targets[side, c], slack[side, c])
        known[0, c] = jump[0, c] - flow[0, c] - ratio[0, c] * lacks[0, c]
        slipped = jump[1, c] - flow[1, c] + flow[2, c]
        known[1, c] = slipped - ratio[1, c] * lacks[1, c] + ratio[2, c] * lacks[2, c]
        normal[c] = stiffness[0, c] * known[0, c]
        shear[c] = stiffness[1, c] * known[1, c] + stiffness[2, c] * normal[c]
    push(rows[0], rows[1], normal, shear, load)
    return load, known, flow


@compiled
def step_of(
    increment: Floats, known: Floats, flow: Floats, given: Reduced, rows: Rows
) -> PointColumns:
    """Forces, slack and flow that go with a step's unknowns (n,) and what is known of it."""
    _, _, lacks, ratio, stiffness, slope = given
    m = known.shape[1]
    normal, shear, slack, flows = np.empty(m), np.empty(m), np.empty((3, m)), np.empty((3, m))
    products_along(rows[0], increment, normal)
    products_along(rows[1], increment, shear)
    for c in range(m):
        normal[c] = stiffness[0, c] * (normal[c] + known[0, c])
        shear[c] = stiffness[1, c] * (shear[c] + known[1, c]) + stiffness[2, c] * normal[c]
        bound = -slope[c] * normal[c]
        slack[0, c] = -normal[c] - lacks[0, c]
        slack[1, c] = bound - shear[c] - lacks[1, c]
        slack[2, c] = bound + shear[c] - lacks[2, c]
        for side in range(3):
            flows[side, c] = flow[side, c] - ratio[side, c] * slack[side, c]
    return increment, normal, shear, slack, flows
