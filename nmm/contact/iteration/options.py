"""Numbers that steer the iterations: tables ``[contact.options.iterations.*]`` of formulations.

They change what a step costs and whether it is found, never what is accepted: that is said by the
tolerances of the enforcement. The defaults were measured on walls and piles of 100 to 10 000
blocks.
"""

from dataclasses import dataclass, field
from math import inf, log, sqrt

from nmm.registry import above_zero

SMALL = 120
"""Unknowns up to which exactness costs nothing: Newton's method is tried first."""


@dataclass(frozen=True)
class IterationBudget:
    """How long each method may try.

    Attributes
    ----------
    solves
        Most search steps.
    factors
        Most factorisations of the springs that act.
    interior
        Most factorisations of the interior point.
    cost
        Solves after which no new factor is made, factorisations counted as `WayOptions.acting`.
    """

    solves: int = 1000
    factors: int = 40
    interior: int = 100
    cost: float = inf


@dataclass(frozen=True)
class Patience:
    """How long an iteration may go on that gets on slowly.

    Attributes
    ----------
    ahead
        Most solves that may lie ahead at the rate of the last ones.
    below
        Relative out-of-balance force (-) below which it is judged.
    look
        Solves over which the rate is taken.
    """

    ahead: float
    below: float = inf
    look: int = 4

    def lost(self, sizes: list[float], tolerance: float) -> bool:
        """Whether the best ``sizes`` so far, one a solve, forecast too many solves."""
        if len(sizes) <= self.look or not sizes[-1] < self.below:
            return False
        gain = log(sizes[-1 - self.look] / sizes[-1]) / self.look
        return not gain * self.ahead >= log(sizes[-1] / tolerance)

    def longer(self, size: float, stay: float) -> "Patience":
        """Patience of a problem in which a factorisation costs ``size`` times as many solves.

        ``stay`` is how many times as many solves may lie ahead besides.
        """
        return Patience(
            stay * size * self.ahead, self.below / size**3, max(1, int(size * self.look))
        )


@dataclass(frozen=True)
class AlternationOptions:
    """Of modified Newton steps with Anderson acceleration, alternating between two factorisations.

    Attributes
    ----------
    wide, narrow
        Solves in a row with the factor of all springs, and with that of those that act.
    slow
        When the first is left before its turn is over: most states are right and it is slow.
    usual
        Unknowns of the problems that ``wide`` and ``slow`` are meant for. In larger ones a
        factorisation costs more solves, as the root of their number, and the first is left later;
        up to as many times later again where the second has not paid.
    lost
        When the second is: it would take long, because states are wrong.
    renewed
        Reduction (-) after which the second is renewed at once, without the first in between.
    rest
        Part (-) of their stiffness left to springs that do not act, so that nothing comes free.
    drag
        Part (-) of the shear stiffness left where contacts slide: some may stick in the end.
    growth
        An accelerated step that multiplies the best residual by more (-) is taken back.
    depth
        Last steps that are combined.
    """

    wide: int = above_zero(20)
    narrow: int = above_zero(20)
    slow: Patience = field(default_factory=lambda: Patience(10, 1e-3))
    usual: float = above_zero(600.0)
    lost: Patience = field(default_factory=lambda: Patience(40))
    renewed: float = 0.1
    rest: float = above_zero(1e-6)
    drag: float = above_zero(0.02)
    growth: float = above_zero(3.0)
    depth: int = above_zero(10)

    def size(self, unknowns: int) -> float:
        """How many times as many solves a factorisation costs among so many unknowns; least 1."""
        return max(1.0, sqrt(unknowns / self.usual))


@dataclass(frozen=True)
class SpringOptions:
    """Of the order in which methods are tried on cut springs.

    Attributes
    ----------
    few
        Contacts up to which Newton's method is tried first from a start that is near.
    fine
        Relative out-of-balance force (-) at which Newton's method need not go on.
    first
        Most factors of acting springs where the interior point has found most states.
    loose
        Out-of-balance force (-) at which the interior point has found most states.
    """

    few: int = 200
    fine: float = above_zero(1e-13)
    first: int = above_zero(6)
    loose: float = above_zero(1e-4)


@dataclass(frozen=True)
class WayOptions:
    """Of the choice which way goes first (`nmm.contact.iteration.ways`); costs in solves.

    Attributes
    ----------
    acting
        Cost of a factorisation of the springs that act, with its matrix.
    inside
        Cost of a step of the interior point besides its own solves: an unsymmetric factorisation
        and the equations around it.
    guess
        Cost of the interior point before it was ever taken.
    trial
        What the alternation may cost where the interior point leads and it is tried again.
    finish
        What it may cost where the interior point has found most states.
    near
        The same from a start that is near its end.
    nearness
        Relative out-of-balance force (-) up to which a start is near.
    longest
        Most steps between two trials.
    """

    acting: float = above_zero(12.0)
    inside: float = above_zero(20.0)
    guess: float = above_zero(400.0)
    trial: float = above_zero(60.0)
    finish: float = above_zero(100.0)
    near: float = above_zero(120.0)
    nearness: float = above_zero(5e-3)
    longest: int = above_zero(16)


@dataclass(frozen=True)
class InteriorOptions:
    """Of the interior point (Mehrotra 1992; Gondzio 1996).

    Attributes
    ----------
    boundary
        Part (-) of the way to the boundary that a step may take.
    jam
        Length (-) of a step after which the next only recentres, with bounds that do not move.
    corrections
        Most corrections of centrality a step, each the price of a solve.
    reach, gain
        How much longer (-) a corrected step is meant to become, and must become to be taken.
    spread
        Products within this factor (-) of their mean are not corrected.
    settled
        Part (-) of the contacts whose states may still change from step to step when Newton's
        method on springs is tried.
    patience
        Steps without halving the mean product after which a path is left.
    distances
        Starts, as multiples (-) of the usual slack and flow. Without dilatancy a path can turn
        back; one from elsewhere mostly leads past that place.
    soft
        Compliance left to exact contacts in the matrix, as a part (-) of their own: redundant
        contacts do no harm then (Friedlander, Orban 2012).
    within
        Part (-) of its bound that a shear force may take up at the start.
    whole, stuck
        A path to a given product ends after a step longer than the first (-), and is left after
        one shorter than the second: nothing holds a part.
    deep, left
        Parts (-) of a given product that are aimed at at least, and below which the path was left.
    """

    boundary: float = above_zero(0.995)
    jam: float = 0.1
    corrections: int = 1
    reach: float = 0.3
    gain: float = 0.03
    spread: float = above_zero(10.0)
    settled: float = 1e-3
    patience: int = 8
    distances: tuple[float, ...] = (1.0, 10.0, 0.1, 3.0)
    soft: float = 1e-7
    within: float = 0.7
    whole: float = 0.9
    stuck: float = 1e-4
    deep: float = 0.3
    left: float = 1e-3


@dataclass(frozen=True)
class RoundOptions:
    """Of rounds of multipliers.

    Attributes
    ----------
    start, again
        Stiffness over compliance (-) of the springs of the first round; and where a step is solved
        again.
    stiff
        The same of rounds that finish what the interior point leaves.
    slight
        The same of springs that only carry the forces of the interior point.
    most, few
        Most rounds in small problems and at the end, and where the step is solved again.
    stiffest
        Largest factor (-) by which rounds stiffen springs: beyond, a round costs more than it
        gains.
    gain
        Part (-) of the error that a round must leave at most for its springs to stay as they are.
    near
        Errors this many times the tolerance are likely within it after the next round.
    failures
        Rounds that may miss their own tolerance before the iteration is given up.
    """

    start: float = above_zero(10.0)
    again: float = above_zero(100.0)
    stiff: float = above_zero(100.0)
    slight: float = above_zero(1e-5)
    most: int = above_zero(12)
    few: int = above_zero(3)
    stiffest: float = above_zero(100.0)
    gain: float = 0.02
    near: float = above_zero(3.0)
    failures: int = 2


@dataclass(frozen=True)
class BarrierOptions:
    """Of the search for the balance of a barrier.

    Attributes
    ----------
    quick, patient, path, held
        Most steps of the first attempt of Newton's method, of one from the central path, of the
        path before it, and under one given friction bound.
    goal
        Product of force and distance at which the path is left, over largest force and width (-).
    bounds
        Most friction bounds that are held before the search is given up.
    stiff
        Springs of the trials over the inverse compliance of their contact (-).
    growth, free
        What a step may leave of the least miss (-), in so many first steps; later ones reduce it.
    halvings
        Most halvings of a step.
    chords, gain
        Most solutions more with a factor, each of which must leave less than this part (-).
    near
        Miss, relative to the load (-), below which the gaps themselves are tried for balance.
    short, look, slow
        Two steps shorter than this (-), or so many that leave more than this part (-), end an
        attempt.
    """

    quick: int = above_zero(20)
    patient: int = above_zero(40)
    path: int = above_zero(40)
    held: int = above_zero(40)
    goal: float = above_zero(1e-3)
    bounds: int = 6
    stiff: float = above_zero(30.0)
    growth: float = above_zero(2.0)
    free: int = 6
    halvings: int = above_zero(10)
    chords: int = 3
    gain: float = 0.6
    near: float = above_zero(1e-5)
    short: float = 0.1
    look: int = above_zero(3)
    slow: float = 0.5


@dataclass(frozen=True)
class MemoryOptions:
    """Of what is kept from step to step.

    Attributes
    ----------
    drift
        A kept factor serves while no diagonal entry of the matrix has changed by more (-).
    turn
        It is as good as new while the rows have changed by less than this part (-).
    factors
        Most factors kept.
    steps
        Last steps from which the next one may start.
    parts
        Most islands solved apart of which anything is kept.
    """

    drift: float = above_zero(1.25)
    turn: float = above_zero(1e-3)
    factors: int = above_zero(4)
    steps: int = above_zero(2)
    parts: int = above_zero(16)


@dataclass(frozen=True)
class IslandOptions:
    """Of islands that are solved apart (`nmm.contact.iteration.apart`).

    Attributes
    ----------
    rounds
        Most times that islands are solved apart in a step, since held bodies pass a little on; all
        is solved together then. 0 always does.
    alone
        Unknowns from which on an island is solved alone; smaller ones are solved as one.
    most
        Part (-) of all unknowns from which on all is solved together.
    """

    rounds: int = 4
    alone: int = above_zero(600)
    most: float = 0.8


@dataclass(frozen=True)
class IterationOptions:
    """Of all iterations an enforcement may call."""

    alternation: AlternationOptions = field(default_factory=AlternationOptions)
    springs: SpringOptions = field(default_factory=SpringOptions)
    ways: WayOptions = field(default_factory=WayOptions)
    interior: InteriorOptions = field(default_factory=InteriorOptions)
    rounds: RoundOptions = field(default_factory=RoundOptions)
    barrier: BarrierOptions = field(default_factory=BarrierOptions)
    memory: MemoryOptions = field(default_factory=MemoryOptions)
    islands: IslandOptions = field(default_factory=IslandOptions)


DEFAULT = IterationOptions()
