"""Where loose blocks come to rest: steps with a mass and little memory of velocity, then none.

Each step moves the blocks as if they started from rest (Shi 1988, kinetic factor 0; dynamic
relaxation in the sense of Day 1965, implicit), until long steps fail (`pace`). The mass lends
stiffness to what is not yet held and drops out of the state that is found: the last solution is
one without it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.momenta import rigid_masses
from nmm.assembly.motion import State
from nmm.effects.base import Instant
from nmm.integrators.shi import Shi
from nmm.stepping.bounds.static_theorem import carried
from nmm.stepping.drive.pace import Pace
from nmm.stepping.drive.settling import COLLAPSE
from nmm.stepping.step.anchors import block_name, largest_mover
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

# Motions in sizes of the domain: of the first step, up to which the next step is lengthened, and
# at which a solution without mass is tried.
FIRST, SLOW, STILL = 1e-3, 5e-3, 1e-5
# A structure that gathers speed, its acceleration grown by this factor, over this way in sizes of
# the domain, is a mechanism: relaxation would only follow its fall.
GATHERS, GATHERED = 4.0, 0.03
# Over this way one that cannot stand where it starts, by the static theorem, has fallen, though it
# might come to lie on something further on.
FALLEN = 0.25
# Steps after which the static theorem is asked again where blocks are to rest near.
LOOK = 20
# Up to this way the motion that is told of a block that moves freely is looked for.
FREE_WAY = 0.01
# So many steps end the search.
STEPS = 400


@dataclass(frozen=True)
class Relaxed:
    """Where the search for rest ended.

    Attributes
    ----------
    state
        The last state.
    steps
        Steps taken.
    at_rest
        Whether hardly anything moves any more.
    sentence
        Which block moves, and how, if it does.
    falls
        Whether it moves on, so that the structure and not the solver is at fault.
    way
        Sum of the largest motions of the steps (m).
    """

    state: State
    steps: int
    at_rest: bool
    sentence: str
    falls: bool = False
    way: float = 0.0


def relax(
    stepper: Stepper, state: State, end: Instant, names: Sequence[str], near: bool = False
) -> Relaxed:
    """Move loose blocks under the loads of ``end`` until they rest; ``names`` (N,) of regions.

    Where they are to rest ``near`` where they stand, those that go further than `COLLAPSE` fall,
    and so do those that, on their way, no contact forces hold with the bonds that are left.
    """
    # Only scenes with loose blocks come here; the others do not import inertia.
    from nmm.effects.inertia import Inertia

    model = stepper.model
    heavy = replace(model, density=np.where(model.density > 0, model.density, 1.0))
    kinematics = stepper.kinematics.let_go
    inertia = Inertia(heavy, kinematics.turns)
    moving = Stepper(
        stepper.discretisation.joined(inertia),
        Shi(),
        stepper.solver,
        kinematics,
    )
    moving.budget = stepper.budget
    size = stepper.size
    pace = Pace(_first_length(heavy, stepper.plan.force(state, end), size))
    proof = carried(stepper, state, end.load_factor)
    farthest = COLLAPSE if near else 1.0
    way, attempt, start, stands = 0.0, None, None, True

    def fallen(first: Attempt | None) -> str:
        assert proof is not None
        return f"{proof.sentence}; {_who(moving, first, names)}"

    for steps in range(1, STEPS + 1):
        length = pace.length
        found = moving.attempt(state, end, length)
        if not found.converged:
            pace.cut()
            if pace.ends:
                said = f"a step failed: {found.sentence}"
                return Relaxed(state, steps, False, said if stands else fallen(attempt), not stands)
            continue
        moving.accept(found)
        goes = pace.speed(heavy, found.state.velocity)
        rest = np.zeros_like(goes)
        state, way = replace(found.state, velocity=goes, acceleration=rest), way + found.motion
        if attempt is None and proof is not None and proof.fails:
            stands = not _touched(model, found, largest_mover(model, state, found.increment)[0])
        # What moves first tells what is free, not what it hits later.
        attempt = found if attempt is None or way - found.motion < FREE_WAY * size else attempt
        start = found.motion / length**2 if start is None else start
        gathers = not pace.keeps_speed and found.motion > GATHERS * start * length**2
        if gathers and way > GATHERED * size:
            who = _who(moving, attempt, names)
            return Relaxed(state, steps, False, f"it gathers speed: {who}", True)
        if not stands and way > FALLEN * size:
            return Relaxed(state, steps, False, fallen(attempt), True)
        still = replace(state, velocity=rest)
        # A step cut short moves little, which is no rest.
        slow = found.motion < STILL * size * min(1.0, (length / pace.first) ** 2)
        if slow and pace.may_ask(steps) and _holds(stepper, still, end):
            return Relaxed(still, steps, True, "", way=way)
        if way > farthest * size:
            break
        if near and steps % LOOK == 0:
            now = carried(moving, state, end.load_factor)
            if now is not None and now.fails:
                said = f"{now.sentence} after {way:.3g} m; {_who(moving, attempt, names)}"
                return Relaxed(state, steps, False, said, True)
        if found.motion < SLOW * size:
            pace.lengthen()
    if not stands:
        return Relaxed(state, steps, False, fallen(attempt), True)
    return Relaxed(state, steps, False, _who(moving, attempt, names), way > farthest * size)


def _holds(stepper: Stepper, state: State, end: Instant) -> bool:
    """Whether there is equilibrium without mass near ``state``."""
    alone = stepper.attempt(state, end, None)
    return alone.converged and alone.motion <= SLOW * stepper.size


def _first_length(model: Model, force: Floats, size: float) -> float:
    """Length (s) of a step in which the most accelerated body moves by `FIRST`."""
    mass = rigid_masses(model)
    pull = np.asarray(model.manifold.rigid_modes.T @ force).reshape(-1, 3)
    fastest = float(np.hypot(*(pull[:, :2] / mass[:, :2]).T).max(initial=0.0))
    return float(np.sqrt(2 * FIRST * size / fastest)) if fastest > 0 else 1.0


def _who(moving: Stepper, attempt: Attempt | None, names: Sequence[str]) -> str:
    """Name the block that moves most, and how; one that nothing touches moves freely."""
    if attempt is None:
        return "no step converged"
    model = moving.model
    body, how = largest_mover(model, attempt.state, attempt.increment)
    name = block_name(model, body, names)
    if _touched(model, attempt, body):
        return (
            f"block {name} moves most: {how}; the blocks that touch it do not hold it: add "
            "supports, friction or strength, or [inertia] to follow its motion"
        )
    return f"block {name} can move freely: {how}; add a support or friction, or [inertia]"


def _touched(model: Model, attempt: Attempt, body: int) -> bool:
    """Whether anything pressed on a body in a step."""
    if attempt.solved is None:
        return False
    contacts, answer = attempt.solved.contacts, attempt.solved.answer
    owner = model.manifold.boundary.body
    beside = (owner[contacts.edge_a] == body) | (owner[contacts.edge_b] == body)
    return bool((beside & (answer.normal_force < 0)).any())
