"""Response spectra: the largest answers of masses on springs to an acceleration of the ground."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError

PERIODS = np.geomspace(0.02, 5.0, 100)
"""Periods (s) of a spectrum for which none are given."""
OFTEN = 20
"""Times in the shortest period at which answers are looked at."""
LEAST = 4
"""Times in a step of the record at which they are: forces turn as the shaking changes its sign."""


@dataclass(frozen=True)
class ResponseSpectrum:
    """Largest answers of one-mass oscillators of a ratio of critical damping.

    Attributes
    ----------
    period
        (k,) of the undamped oscillators (s).
    ratio
        Of critical damping.
    displacement
        (k,) largest displacement against the ground (m).
    absolute_acceleration
        (k,) largest acceleration of the mass, against axes at rest (m/s2).
    """

    period: Floats
    ratio: float
    displacement: Floats
    absolute_acceleration: Floats

    @property
    def pseudo_acceleration(self) -> Floats:
        """``w^2`` times the displacement (k,): the force of the spring over the mass (m/s2).

        Without damping it is the absolute acceleration; with it, below.
        """
        return np.asarray((2 * np.pi / self.period) ** 2 * self.displacement)

    @property
    def pseudo_velocity(self) -> Floats:
        """``w`` times the displacement (k,) (m/s)."""
        return np.asarray(2 * np.pi / self.period * self.displacement)


def response_spectrum(
    times: Floats, acceleration: Floats, periods: Floats = PERIODS, ratio: float = 0.05
) -> ResponseSpectrum:
    """Answer of oscillators to an acceleration of the ground that is linear between samples.

    The answer is exact (Nigam and Jennings 1969) at the samples and at least twenty times in each
    period between them, which miss the largest by 1.2 % at most, and so is its largest value after
    the last of them, as oscillators swing on.

    Parameters
    ----------
    times, acceleration
        (n,) increasing, s and m/s2.
    periods
        (k,) s, > 0.
    ratio
        Of critical damping, from 0 to below 1.

    Raises
    ------
    NmmError
        Periods or a ratio out of range.
    """
    periods = np.asarray(periods, dtype=float)
    sampled = len(times) > 1 and bool((np.diff(times) > 0).all())
    if not (0 <= ratio < 1 and len(periods) and periods.min() > 0 and sampled):
        raise NmmError(
            f"response spectrum: ratio {ratio:g}, {len(periods)} periods, {len(times)} samples: "
            "expected a ratio from 0 to below 1, periods > 0, and times that increase: correct them"
        )
    omega = 2 * np.pi / periods
    state = np.zeros((2, len(periods)))
    moved, felt = np.zeros(len(periods)), np.zeros(len(periods))
    known: dict[float, tuple[Floats, Floats]] = {}
    steps = np.diff(times).round(15).tolist()
    # Each step follows from the last one.
    for step, start, end in zip(steps, acceleration[:-1], acceleration[1:], strict=True):
        if step not in known:
            known[step] = _within(omega, ratio, step)
        own, driven = known[step]
        path = np.einsum("pijk,jk->pik", own, state) + driven[:, :, 0] * start
        path += driven[:, :, 1] * end
        state = path[-1]
        moved = np.maximum(moved, np.abs(path[:, 0]).max(axis=0))
        felt = np.maximum(felt, np.abs(_force(omega, ratio, path[:, 0], path[:, 1])).max(axis=0))
    force = _force(omega, ratio, *state)
    # Without shaking the rate of the speed is that of this force, and the force swings as it does.
    rate = _force(omega, ratio, state[1], -force)
    return ResponseSpectrum(
        periods,
        ratio,
        np.maximum(moved, _largest_later(omega, ratio, state[0], state[1])),
        np.maximum(felt, _largest_later(omega, ratio, force, rate)),
    )


def _force(omega: Floats, ratio: float, way: Floats, speed: Floats) -> Floats:
    """Return what spring and damper exert on a mass of 1 (m/s2): its absolute acceleration."""
    return np.asarray(omega**2 * way + 2 * ratio * omega * speed)


def _largest_later(omega: Floats, ratio: float, value: Floats, rate: Floats) -> Floats:
    """Largest size (k,) of what swings freely from a value (k,) and its rate (k,) on.

    It is the first extreme, as the later ones are smaller, or the value itself.
    """
    damped, fading = omega * np.sqrt(1 - ratio**2), ratio * omega
    late = (rate + fading * value) / damped
    angle = np.arctan2(rate, (fading * rate + omega**2 * value) / damped) % np.pi
    swung = value * np.cos(angle) + late * np.sin(angle)
    return np.asarray(np.maximum(np.abs(value), np.exp(-fading / damped * angle) * np.abs(swung)))


def _within(omega: Floats, ratio: float, step: float) -> tuple[Floats, Floats]:
    """Return `_recurrence` (p, 2, 2, k) from the start of a step to p times within it."""
    parts = max(LEAST, int(np.ceil(OFTEN * step * omega.max() / 2 / np.pi)))
    shares = np.arange(1, parts + 1) / parts
    found = [_recurrence(omega, ratio, step * share) for share in shares.tolist()]
    own, driven = (np.stack(one) for one in zip(*found, strict=True))
    # The shaking at a share of the step is that share between both ends.
    part = shares[:, None, None]
    first, last = driven[:, :, 0] + (1 - part) * driven[:, :, 1], part * driven[:, :, 1]
    return own, np.stack([first, last], axis=2)


def _recurrence(omega: Floats, ratio: float, step: float) -> tuple[Floats, Floats]:
    """Matrices (2, 2, k) of displacement and velocity, and of both ends of the ground's shaking.

    Of ``u'' + 2 z w u' + w^2 u = -a`` with ``a`` linear over the step, from the solution without
    shaking and a particular one, ``-a / w^2 + 2 z a' / w^3``.
    """
    damped = omega * np.sqrt(1 - ratio**2)
    fade, s, c = np.exp(-ratio * omega * step), np.sin(damped * step), np.cos(damped * step)
    share = ratio * omega / damped
    own = np.array(
        [
            [fade * (c + share * s), fade * s / damped],
            [-fade * s * omega**2 / damped, fade * (c - share * s)],
        ]
    )
    # Particular solution at the start and at the end, for unit values of a at both ends.
    slope = np.array([-1.0, 1.0])[:, None] / step
    bent = 2 * ratio * slope / omega**3
    at_start = np.stack([np.array([-1.0, 0.0])[:, None] / omega**2 + bent, -slope / omega**2])
    at_end = np.stack([np.array([0.0, -1.0])[:, None] / omega**2 + bent, -slope / omega**2])
    return own, at_end - np.einsum("ijk,jlk->ilk", own, at_start)
