"""Numbers that steer the search for forces of springs: passes, ways, islands, what is kept."""

from dataclasses import dataclass, field
from math import sqrt

from nmm.contact.iteration.options.budgets import Patience
from nmm.registry import above_zero


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
    rare
        Unknowns for each contact from which Newton's method is tried after a few solves.
    fine
        Relative out-of-balance force (-) at which Newton's method need not go on.
    first
        Most factors of acting springs where the interior point has found most states.
    crossover
        Out-of-balance force (-) at which the interior point has found most states, and modified
        Newton takes over.
    """

    few: int = 200
    rare: float = above_zero(20.0)
    fine: float = above_zero(1e-13)
    first: int = above_zero(6)
    crossover: float = above_zero(1e-4)


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
