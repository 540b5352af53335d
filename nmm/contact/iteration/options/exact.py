"""Numbers that steer exact enforcements: interior point and rounds of multipliers."""

from dataclasses import dataclass

from nmm.registry import above_zero


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
