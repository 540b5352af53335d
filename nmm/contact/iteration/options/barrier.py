"""Numbers that steer the search for the balance of a barrier."""

from dataclasses import dataclass

from nmm.registry import above_zero


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
