"""An interface law at a point: traction, tangent and history after a given gap and slip.

In a run the plastic slip follows from the equilibrium of bodies. At a single point it follows from
the law: the shear traction returns to its bound, which may itself depend on the plastic slip.
"""

from dataclasses import replace
from typing import Protocol

import numpy as np

from integration.arrays import Bools, Floats
from nmm.interfaces.history import History
from nmm.interfaces.response import InterfaceResponse, Traction

ROUNDS, CLOSE = 60, 1e-14
"""Most iterations for the plastic slip, and their tolerance over the largest trial stress."""
NUDGE = 1e-6
"""Step of finite differences of the history, as a share of the gap or of the elastic slip."""
SAME = 1e-9
"""Pulls that differ by less than this share of the strength are the same."""
ROUNDED_PLACE = 2e-12
"""As a share of a slip, 1e4 times its rounding; larger steps may reach from slip to stick."""

# Normal and shear stiffness (m,) in Pa/m.
Stiffness = tuple[Floats, Floats]


class LawAtPoint(Protocol):
    """What is asked of a law, see `nmm.interfaces.base.InterfaceLaw`."""

    def response(self, history: History, stiffness: Floats) -> InterfaceResponse:
        """Return springs and limits at a fixed history."""

    def evolved(
        self, history: History, gap: Floats, sliding: Floats, stiffness: Floats
    ) -> dict[str, Floats]:
        """Return the history after a step."""

    def overload(self, pull: Floats, shear: Floats) -> Floats:
        """Return stress over strength (m,) of intact bonds."""

    def broken(self, history: History) -> dict[str, Floats]:
        """Return the history (m,) of bonds that broke at once."""


def mapped(
    law: LawAtPoint, history: History, gap: Floats, slip: Floats, stiffness: Stiffness
) -> Traction:
    """See `InterfaceLaw.update`."""
    after = _after(law, history, gap, slip, stiffness)
    behind = _behind(law, history, after, gap, stiffness)
    traction, slope = _traction(law, history, after, gap, slip, stiffness, behind)

    def slopes() -> Floats:
        tangent = np.zeros((len(gap), 2, 2))
        tangent[:, 0, 0], tangent[:, 1, 1] = slope, stiffness[1]
        # At a fixed history springs are linear; effects of its change are by finite differences.
        by_gap, by_slip = _nudge(gap, gap), _nudge(slip, slip - history["plastic_slip"])
        still = np.zeros_like(gap)
        # The four points of central differences in gap and slip are evaluated together.
        known = {name: np.tile(column, 4) for name, column in history.items()}
        stiff = np.tile(stiffness[0], 4), np.tile(stiffness[1], 4)
        here = np.tile(gap, 4), np.tile(slip, 4)
        gaps = here[0] + np.concatenate([by_gap, -by_gap, still, still])
        slips = here[1] + np.concatenate([still, still, by_slip, -by_slip])
        other = _after(law, known, gaps, slips, stiff)
        found = _traction(law, known, other, *here, stiff, np.tile(behind, 4))[0]
        more, less = found.reshape(2, 2, -1, 2).swapaxes(0, 1)
        for column, nudge in enumerate((by_gap, by_slip)):
            tangent[:, :, column] += (more[column] - less[column]) / (2 * nudge[:, None])
        return tangent

    return Traction(traction, after, slopes)


def _nudge(there: Floats, size: Floats) -> Floats:
    """Return the steps (m,) of finite differences at values ``there`` of a ``size`` (m,)."""
    scale = np.abs(size) + 1e-3 * np.abs(size).max(initial=1e-12)
    return np.asarray(NUDGE * scale + ROUNDED_PLACE * np.abs(there))


def _after(
    law: LawAtPoint, history: History, gap: Floats, slip: Floats, stiffness: Stiffness
) -> dict[str, Floats]:
    """Return the history after a gap and a slip: plastic slip, and broken bonds."""
    trial = stiffness[1] * (slip - history["plastic_slip"])
    sign, least, most = np.sign(trial), np.zeros_like(trial), np.abs(trial) / stiffness[1]
    close = CLOSE * float(np.abs(trial).max(initial=0.0))

    def slid(sliding: Floats) -> tuple[dict[str, Floats], Floats]:
        after = law.evolved(history, gap, sign * sliding, stiffness[0])
        bound = _pull(law, history, after, gap, stiffness)[2]
        return after, np.abs(trial) - stiffness[1] * sliding - bound

    over, under = slid(least)[1], slid(most)[1]
    slides = over > 0
    over, under = np.where(slides, over, 0.0), np.where(slides, under, -1.0)
    at, side = np.zeros_like(trial), np.zeros_like(trial)
    after, _ = slid(at)
    for _ in range(ROUNDS if slides.any() else 0):  # regula falsi
        chord = np.minimum(under - over, -np.finfo(float).tiny)
        at = np.where(slides, most - under * (most - least) / chord, 0.0)
        after, excess = slid(at)
        if np.abs(excess[slides]).max() <= close:
            break
        # The Illinois variant: the value of an end that is retained twice is halved.
        part, side = np.where(np.sign(excess) == side, 0.5, 1.0), np.sign(excess)
        more = excess > 0
        least, over = np.where(more, at, least), np.where(more, excess, part * over)
        most, under = np.where(more, most, at), np.where(more, part * under, excess)
    still = np.zeros(len(gap), dtype=bool)
    force, _ = _traction(law, history, after, gap, slip, stiffness, still)
    breaks = history["bonded"] & (law.overload(force[:, 0], force[:, 1]) > 1)
    broken = law.broken(after) | {"plastic_slip": slip}
    return {name: np.where(breaks, broken[name], after[name]) for name in after}


def _behind(
    law: LawAtPoint, before: History, after: History, gap: Floats, stiffness: Stiffness
) -> Bools:
    """Return which bonds (m,) are open by less than what slid has damaged: on their new secant."""
    response = law.response(after, stiffness[0])
    pull = stiffness[0] * response.open_share * (gap - response.rise)
    return np.asarray(before["bonded"] & (pull < (1 - SAME) * response.limits.tension))


def _traction(
    law: LawAtPoint,
    before: History,
    after: History,
    gap: Floats,
    slip: Floats,
    stiffness: Stiffness,
    behind: Bools,
) -> tuple[Floats, Floats]:
    """Return pull and shear (m, 2) in Pa, and the derivative of the pull by the gap."""
    pull, slope, _ = _pull(law, before, after, gap, stiffness, behind)
    return np.stack([pull, stiffness[1] * (slip - after["plastic_slip"])], axis=1), slope


def _pull(
    law: LawAtPoint,
    before: History,
    after: History,
    gap: Floats,
    stiffness: Stiffness,
    behind: Bools | bool = False,
) -> tuple[Floats, Floats, Floats]:
    """Return the normal traction, its derivative and the shear bound, at the limits ``after``.

    A bond that opens is loaded along the secant at the start of the step up to its limit, and those
    ``behind`` (m,) have the secant that sliding left.
    """
    response, known = law.response(after, stiffness[0]), law.response(before, stiffness[0])
    share = np.where(behind, response.open_share, known.open_share)
    return replace(response, open_share=share).pull(gap, before["bonded"], stiffness[0])
