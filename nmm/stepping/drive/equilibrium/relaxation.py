"""Where loose blocks come to rest: steps with a mass and little memory of velocity, then none.

Each step moves the blocks as if they started from rest (Shi 1988, kinetic factor 0; dynamic
relaxation in the sense of Day 1965, implicit), until long steps fail (`pace`). The mass lends
stiffness to what is not yet held and drops out of the state that is found: the last solution is
one without it. Corners that a step let through are sought anew in the next one, as in statics: kept
with their friction they hold up, in time alone, what no equilibrium without mass holds.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.moving.momenta import resultants, rigid_masses
from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.integrators.shi import Shi
from nmm.stepping.bounds.static_theorem import carried
from nmm.stepping.drive.equilibrium.pace import Pace
from nmm.stepping.drive.equilibrium.restless import touched, who
from nmm.stepping.drive.equilibrium.settling import COLLAPSE, anchored, beyond_anchors
from nmm.stepping.step.anchors import largest_mover
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
# What is nearer than this share of the way that ends the search goes to and fro, and does not fall.
GONE_FROM = 0.5
# Steps after which the static theorem is evaluated again where blocks must rest near.
LOOK = 20
# Up to this way the motion that is told of a block that moves freely is looked for.
FREE_WAY = 0.01
# So many steps end the search.
STEPS = 400


@dataclass(frozen=True)
class RelaxationEnd:
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
    way, lost
        Sum of the largest motions of the steps (m), and what friction, bonds and matter took (J).
    """

    state: State
    steps: int
    at_rest: bool
    sentence: str
    falls: bool = False
    way: float = 0.0
    lost: float = 0.0


def relax(
    stepper: Stepper, state: State, end: Instant, names: Sequence[str], near: bool = False
) -> RelaxationEnd:
    """Move loose blocks under the loads of ``end`` until they rest; ``names`` (N,) of regions.

    Where they are to rest ``near`` where they stand, those that go further than `COLLAPSE` fall,
    and so do those that, on their way, no contact forces hold with the bonds that are left.
    """
    return _Search(stepper, state, end, names, near).run()


class _Search:
    """A search for rest: where blocks are, and the record of their motion.

    Attributes
    ----------
    way, lost
        Sum of the largest motions of the steps (m), and what they took for good (J).
    first
        The step whose motion tells what is free: what moves later may have hit something.
    start
        Largest motion of the first step over the square of its length (m/s2).
    stands
        Whether the structure may stand where it started, as the static theorem and its first motion
        say.
    """

    def __init__(
        self, stepper: Stepper, state: State, end: Instant, names: Sequence[str], near: bool
    ) -> None:
        # Only scenes with loose blocks come here; the others do not import inertia.
        from nmm.effects.inertia import Inertia

        self.stepper, self.state, self.end, self.names = stepper, state, end, names
        model, kinematics, self.size = stepper.model, stepper.kinematics.let_go, stepper.size
        self.heavy = replace(model, density=np.where(model.density > 0, model.density, 1.0))
        joined = stepper.discretisation.joined(Inertia(self.heavy, kinematics.turns))
        self.moving = Stepper(joined, Shi(), stepper.solver, kinematics)
        self.moving.budget = stepper.budget
        self.origin = self.moving.place(state)
        self.pace = Pace(_first_length(self.heavy, stepper.plan.force(state, end), self.size))
        self.proof = carried(stepper, state, end.load_factor)
        self.near, self.farthest = near, (COLLAPSE if near else 1.0) * self.size
        self.way, self.lost, self.steps, self.stands = 0.0, 0.0, 0, True
        self.first: Attempt | None = None
        self.start: float | None = None

    def run(self) -> RelaxationEnd:
        """Move the blocks until they rest, or it is known that they fall."""
        for self.steps in range(1, STEPS + 1):
            length = self.pace.length
            found = self.moving.attempt(self.state, self.end, length)
            ended = self._judged(found, length) if found.converged else self._cut(found)
            if ended is not None:
                return ended
            if found.converged and found.motion < SLOW * self.size:
                self.pace.lengthen()
        return self._given_up()

    def _judged(self, found: Attempt, length: float) -> RelaxationEnd | None:
        """Take a step, and say where the search ends by it; None where it goes on."""
        self._take(found, length)
        if self._gathers(found, length) and self.way > GATHERED * self.size:
            return self._falls(
                f"it gathers speed: {self._who()}" if self.stands else self._fallen()
            )
        if not self.stands and self.way > FALLEN * self.size:
            return self._falls(self._fallen())
        still = replace(self.state, velocity=np.zeros_like(self.state.velocity))
        # A step cut short moves little, which is no rest.
        slow = found.motion < STILL * self.size * min(1.0, (length / self.pace.first) ** 2)
        if slow and self.pace.may_ask(self.steps) and _holds(self.stepper, still, self.end):
            return RelaxationEnd(still, self.steps, True, "", way=self.way, lost=self.lost)
        if self.way > self.farthest:
            return self._given_up()
        if self.near and self.steps % LOOK == 0:
            now = carried(self.moving, self.state, self.end.load_factor)
            if now is not None and now.fails:
                return self._falls(f"{now.sentence} after {self.way:.3g} m; {self._who()}")
        return None

    def _take(self, found: Attempt, length: float) -> None:
        """Continue from the end of a step."""
        self.moving.accept(found)
        self.lost += _taken(self.moving, self.state, found)
        goes = self.pace.speed(self.heavy, found.state.velocity)
        self.state = replace(found.state, velocity=goes, acceleration=np.zeros_like(goes))
        self.way += found.motion
        if self.first is None and self.proof is not None and self.proof.fails:
            model = self.stepper.model
            body = largest_mover(model, self.state, found.increment)[0]
            self.stands = not touched(model, found, body)
        if self.first is None or self.way - found.motion < FREE_WAY * self.size:
            self.first = found
        if self.start is None:
            self.start = found.motion / length**2

    def _gathers(self, found: Attempt, length: float) -> bool:
        """Whether the structure has gathered speed since its first step."""
        assert self.start is not None
        return not self.pace.keeps_speed and found.motion > GATHERS * self.start * length**2

    def _cut(self, found: Attempt) -> RelaxationEnd | None:
        """Shorten the step that failed; say where the search ends if it may be no shorter."""
        self.pace.cut()
        if not self.pace.ends:
            return None
        said = f"a step failed: {found.sentence}" if self.stands else self._fallen()
        return RelaxationEnd(self.state, self.steps, False, said, not self.stands)

    def _given_up(self) -> RelaxationEnd:
        if not self.stands:
            return self._falls(self._fallen())
        gone = float(np.abs(self.moving.place(self.state) - self.origin).max())
        far = self.way > self.farthest
        falls = far and gone > GONE_FROM * self.farthest
        said = f"blocks went {self.way:.3g} m to and fro; " if far and not falls else ""
        return RelaxationEnd(self.state, self.steps, False, said + self._who(), falls)

    def _falls(self, sentence: str) -> RelaxationEnd:
        return RelaxationEnd(self.state, self.steps, False, sentence, True)

    def _fallen(self) -> str:
        assert self.proof is not None
        return f"{self.proof.sentence}; {self._who()}"

    def _who(self) -> str:
        carries = self.proof is not None and self.proof.fails and (self.proof.factor or 0.0) > 0
        return who(self.moving, self.first, self.names, "lower the load, or " if carries else "")


def _holds(stepper: Stepper, state: State, end: Instant) -> bool:
    """Whether there is equilibrium without mass near ``state``, with anchors where it needs them.

    The matrix knows nothing of what the turn of forces alone holds, as it does a block that hangs.
    """
    alone = stepper.attempt(state, end, None)
    if beyond_anchors(stepper, alone):
        return False
    if not (alone.converged and alone.motion <= SLOW * stepper.size):
        start = stepper.remember()
        alone = anchored(stepper, state, end, "stop").attempt
        stepper.restore(start)
        stepper.anchored = False
    return alone.converged and alone.motion <= SLOW * stepper.size


def _taken(moving: Stepper, before: State, found: Attempt) -> float:
    """Energy (J) that friction, breaking bonds, members and matter took for good in a step."""
    after = found.state
    by_contact = 0.0 if found.solved is None else found.solved.loss
    by_effects = sum(moving.plan.losses(before, after).values())
    return by_contact + by_effects + moving.model.dissipated(before, after)


def _first_length(model: Model, force: Floats, size: float) -> float:
    """Length (s) of a step in which the most accelerated body moves by `FIRST`."""
    mass = rigid_masses(model)
    pull = resultants(model, force)
    fastest = float(np.hypot(*(pull[:, :2] / mass[:, :2]).T).max(initial=0.0))
    return float(np.sqrt(2 * FIRST * size / fastest)) if fastest > 0 else 1.0
