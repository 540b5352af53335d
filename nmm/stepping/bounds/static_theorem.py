"""The static theorem as a linear programme: whether any contact forces carry the loads at all.

Each body must be in balance under its loads, what its supports can give, contact forces within
friction and strength, and forces of members within what they can carry. Where no such forces exist
there is no equilibrium near this place, whatever bodies and contacts are made of and however they
slide; where they exist nothing is shown, since friction may not choose them (Drucker 1954: with
friction the static theorem bounds from above).
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import block_diag, csc_array, csr_array, diags_array, hstack, vstack

from integration.arrays import Floats, Ints
from integration.ragged import within
from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.model.planning.plan import Plan
from nmm.stepping.bounds.member_forces import MemberForces

if TYPE_CHECKING:
    from nmm.contact.problem.step_problem import Limits
    from nmm.stepping.step.stepper import Stepper

# Contacts open by less than this share of the domain count as if they could carry.
MAY_CARRY = 1e-4
# Stiffness of what holds a body below this share of the largest holds nothing.
HOLDS = 1e-9
# Bodies tied to each other in larger groups than this are taken as supported.
LARGEST = 200
# Status of linear programmes in scipy.
SOLVED, INFEASIBLE, UNBOUNDED = 0, 2, 3
# Loads beyond those carried by more than this, relative, are a proof; the programme's rounding.
CERTAIN = 1e-6


@dataclass(frozen=True)
class CarriedLoad:
    """The largest load factor, up to that asked for, that admissible contact forces carry.

    None where not even the loads that are not scaled are carried.

    Attributes
    ----------
    broken
        Whether bonds that broke before count as broken.
    members
        Whether members carry, too.
    """

    factor: float | None
    asked: float
    broken: bool = False
    members: bool = False

    @property
    def fails(self) -> bool:
        """Whether the structure cannot be in equilibrium."""
        return self.factor is None or self.factor < self.asked * (1 - CERTAIN)

    @property
    def sentence(self) -> str:
        """Say what is proven."""
        forces = "contact forces within friction and strength"
        forces += self.members * " and forces of members within theirs"
        by = "static theorem" + self.broken * ", bonds that broke before counted as broken"
        if self.factor is None:
            return f"no {forces} carry the loads ({by})"
        return f"{forces} carry no more than load factor {max(self.factor, 0.0):.6g} ({by})"


@dataclass(frozen=True)
class LoadBound:
    """The largest load factor that any admissible forces carry: no failure load lies above it.

    Attributes
    ----------
    factor
        The bound; infinite where no motion of bodies is resisted by contacts alone. None where
        not even the loads that are not scaled are carried.
    motion
        (n,) increment of the collapse mechanism, scaled at will; zero without one.
    """

    factor: float | None
    motion: Floats


def carried(
    stepper: "Stepper", state: State, asked: float, weaker: float = 1.0
) -> CarriedLoad | None:
    """Return what can be carried near ``state``; None without contact or where it is not known.

    Strengths of contacts are those of the stepper over ``weaker``.
    """
    reach = MAY_CARRY * stepper.size
    found = _largest_share(stepper, state, asked, 1.0, weaker, reach)
    if found is None:
        return None
    factor = None if found.factor is None else asked * found.factor
    members = bool(stepper.plan.having("resistance"))
    return CarriedLoad(factor, asked, stepper.broken_bonds > 0, members)


def load_bound(stepper: "Stepper", state: State) -> LoadBound | None:
    """Return the bound of the failure load near ``state``; None without contact or scaled loads.

    The multipliers of the equations of balance are the velocities of the mechanism in which the
    bodies fail under that load (Charnes, Lemke and Zienkiewicz 1959). Members act along their lines
    in ``state``: what they carry as they turn is not known.
    """
    return _largest_share(stepper, state, 1.0, most=np.inf)


def _largest_share(
    stepper: "Stepper",
    state: State,
    asked: float,
    most: float,
    weaker: float = 1.0,
    reach: float | None = None,
) -> LoadBound | None:
    """Return the largest share, up to ``most``, of the loads at ``asked`` that is carried.

    Members turn as `MemberForces.of` says by ``reach``. It is not known where effects have limits
    of their own, which no condition here says.
    """
    contact, members = stepper.plan.contact, stepper.plan.having("resistance")
    plan = Plan({name: e for name, e in stepper.plan.effects.items() if e not in members})
    if contact is None or any(effect.limited for effect in plan.effects.values()):
        return None
    (normal, tangent), limits = contact.near(state, MAY_CARRY * stepper.size)
    balance = _directions(stepper, plan, state)
    resisting = (one.resistance(state) for one in members)
    pulled = MemberForces.of(resisting, balance.shape[1], reach)
    fixed, whole = (plan.force(state, Instant(at, at)) for at in (0.0, asked))
    fixed, gain = balance @ fixed, balance @ (whole - fixed)
    size = max(float(np.abs(fixed).max(initial=0.0)), float(np.abs(gain).max(initial=0.0)))
    if not balance.shape[0] or size == 0:
        return None
    forces = normal.T, tangent.T, pulled.acting
    columns = (*(balance @ one for one in forces), csr_array(gain[:, None] / size))
    found = _programme(columns, -fixed / size, limits, weaker, size, most, pulled)
    still = np.zeros(balance.shape[1])
    if found.status == INFEASIBLE:
        return LoadBound(None, still)
    if found.status == UNBOUNDED:
        return LoadBound(np.inf, still)
    if found.status != SOLVED:
        return None
    # What is scaled does work in the mechanism; loads that are not, as weight, may resist it.
    motion = np.copysign(1.0, gain @ found.eqlin.marginals) * (balance.T @ found.eqlin.marginals)
    return LoadBound(float(found.x[-1]), motion)


def _programme(
    balance: tuple[csr_array, ...],
    sides: Floats,
    limits: "Limits",
    weaker: float,
    size: float,
    most: float,
    members: MemberForces,
) -> Any:
    """Maximise the share under balance and the limits of contacts, forces over ``size`` (N).

    ``balance`` has the columns of pressures ``p``, of shear forces ``t``, of forces of ``members``
    and of the share. Asked for is how far shear is above its lower limit,
    ``s = t + mu p + c >= 0``, so that the upper one, ``s - 2 mu p <= 2 c``, is the only one
    of contacts that is no bound.
    """
    # The one place that asks for it; its many signatures know no sparse conditions.
    from scipy import optimize

    linprog: Any = optimize.linprog
    pressed, sheared, pulled, gain = balance
    m, tension = len(limits.friction), limits.tension / weaker
    ends = np.isfinite(limits.cohesion)  # elsewhere shear is free, and asked for itself
    friction = np.where(ends, limits.friction / weaker, 0.0)
    cohesion = np.where(ends, limits.cohesion / weaker / size, 0.0)
    shear = np.where(ends, 0.0, -np.inf)
    lowest = np.concatenate([-tension / size, shear, members.lowest / size, [0.0]])
    highest = np.concatenate([np.full(2 * m, np.inf), members.highest / size, [most]])
    slope, one = diags_array(friction), diags_array(np.ones(m))
    rubbing = csr_array(hstack([-2 * slope, one]))
    return linprog(
        np.append(np.zeros(len(lowest) - 1), -1.0),
        A_ub=csr_array(block_diag([rubbing, members.limiting, csr_array((0, 1))])),
        b_ub=np.concatenate([np.where(ends, 2 * cohesion, np.inf), members.limits / size]),
        A_eq=csr_array(hstack([pressed - sheared @ slope, sheared, pulled, gain])),
        b_eq=sides + sheared @ cohesion,
        bounds=np.stack([lowest, highest], axis=1),
        method="highs-ipm",  # a fifth of the simplex method's seconds on 455 bonded blocks
    )


def _directions(stepper: "Stepper", plan: Plan, state: State) -> csr_array:
    """Rows (k, n) of the rigid motions of bodies that no support, seam or glue resists.

    A body that is held in part keeps its other motions. Rotations are of one mean size of a body.
    """
    from scipy.sparse.csgraph import connected_components

    manifold = stepper.model.manifold
    n = manifold.n_unknowns
    size = np.repeat(np.sqrt(manifold.body_area), 3)
    size[np.arange(len(size)) % 3 != 2] = 1.0
    modes = csr_array(manifold.rigid_modes @ diags_array(1 / size))
    stiffness = csr_array(modes.T @ (plan.matrix(state, csc_array((n, n))) @ modes))
    border = plan.border(state, Instant.of(state))
    if border is not None:
        rows = border[0] @ modes
        stiffness = csr_array(
            stiffness / (abs(stiffness).max() or 1.0) + rows.T @ rows / abs(rows).max() ** 2
        )
    body = np.arange(stiffness.shape[0]) // 3
    own = csr_array((np.ones(len(body)), (body, np.arange(len(body)))))
    tied = csr_array((np.ones(stiffness.nnz), stiffness.nonzero()), shape=stiffness.shape)
    label = np.asarray(connected_components(tied + own.T @ own, directed=False)[1], np.int64)
    return csr_array(_loose(stiffness, label) @ modes.T)


def _loose(stiffness: csr_array, label: Ints) -> csr_array:
    """Rows (k, m) of the directions that a stiffness (m, m), in groups by label (m,), leaves."""
    order, size = np.argsort(label, kind="stable"), np.bincount(label)
    place = np.empty(len(label), dtype=np.int64)
    place[order] = within(size)
    entries, stiffest, rows = stiffness.tocoo(), abs(stiffness).max(), [csr_array((0, len(label)))]
    for length in np.unique(size[size <= 3 * LARGEST]):  # groups of one size together
        groups = np.flatnonzero(size == length)
        number = np.full(len(size), -1)
        number[groups] = np.arange(len(groups))
        among = number[label[entries.row]] >= 0
        i, j = entries.row[among], entries.col[among]
        blocks = np.zeros((len(groups), length, length))
        blocks[number[label[i]], place[i], place[j]] = entries.data[among]
        value, vector = np.linalg.eigh(blocks)
        at, mode = np.nonzero(value <= HOLDS * stiffest)
        members = order[size[label[order]] == length].reshape(len(groups), length)
        found = vector[at, :, mode].ravel(), members[at].ravel()
        rows.append(csr_array((*found, np.arange(len(at) + 1) * length), (len(at), len(label))))
    return csr_array(vstack(rows))
