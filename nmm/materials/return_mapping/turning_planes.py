"""Return of stresses to planes of a yield surface that turn as their strengths fall.

Where friction falls with cohesion, the planes of yield ``N`` and the ways along which they flow
``W`` go from one end to the other with the share ``D`` of the fall: ``N(D) = N0 + D (N1 - N0)``. At
one ``D`` the return is linear, so that ``D`` is all that is iterated for.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.materials.return_mapping.planes import ActingPlanes, Normals, Planes, StrengthLoss

# Iterations for the share by Newton's method within a bracket: five are enough where it is even.
MOST, ENOUGH = 50, 1e-14


@dataclass(frozen=True)
class TurningPlanes:
    """Planes that act together and turn; see `nmm.materials.return_mapping.planes.Planes`.

    Attributes
    ----------
    elastic
        (d, d) stresses from strains (Pa).
    first, last
        Normals (p, d) of yield and of flow where nothing and where all of the fall is done.
    strength, falls
        (p,) at first, and by how much it falls (Pa).
    """

    elastic: Floats
    first: Normals
    last: Normals
    strength: Floats
    falls: Floats

    @property
    def eased(self) -> float:
        """See `Planes.eased`: that of stress from nowhere else, the larger of both ends."""
        ends = (self.first, self.last)
        return max(Planes.of(self.elastic, one, self.strength, self.falls).eased for one in ends)

    def returned(self, trial: Floats, weakening: StrengthLoss) -> tuple[Floats, Floats, Floats]:
        """Return stress (m, d), flow (m, p) and share of the fall (m,) where these planes act."""
        after = self._share(trial, weakening)
        here = _Standing.of(self, trial, after)
        return here.stress, here.flow, after

    def tangent(self, trial: Floats, weakening: StrengthLoss, after: Floats) -> Floats:
        """Derivative (m, d, d) of the returned stress by the trial's."""
        here = _Standing.of(self, trial, after)
        speed = np.where(after < 1, weakening.speed, 0.0)
        rate = speed / (1 - speed * (here.rises @ self.falls))
        grown = rate[:, None] * (here.multiplier.swapaxes(1, 2) @ self.falls)
        lost = (here.ways @ here.rises[:, :, None])[:, :, 0] + here.aside
        kept = np.eye(len(self.elastic)) - here.ways @ here.multiplier
        return np.asarray(kept - lost[:, :, None] * grown[:, None, :])

    def _share(self, trial: Floats, weakening: StrengthLoss) -> Floats:
        """Share (m,) that the flow to it asks for, within the one before and 1."""
        low, high = weakening.done, np.ones(len(trial))
        low = np.where(self._beyond(trial, weakening, high)[0] <= 0, 1.0, low)
        found = low
        for _ in range(MOST):
            over, slope = self._beyond(trial, weakening, found)
            low, high = np.where(over < 0, found, low), np.where(over < 0, high, found)
            with np.errstate(divide="ignore", invalid="ignore"):
                after = found - over / slope
            inside = (after >= low - ENOUGH) & (after <= high + ENOUGH)
            after = np.where(inside, np.clip(after, low, high), (low + high) / 2)
            going, found = np.abs(after - found) > ENOUGH, after
            if not going.any():
                break
        return found

    def _beyond(
        self, trial: Floats, weakening: StrengthLoss, share: Floats
    ) -> tuple[Floats, Floats]:
        """By how much (m,) a share is more than the flow to it asks for, and the slope of that."""
        here = _Standing.of(self, trial, share)
        asked = weakening.done + weakening.speed * (here.flow @ self.falls)
        return share - asked, 1 - weakening.speed * (here.rises @ self.falls)


@dataclass(frozen=True)
class _Standing:
    """Planes at one share of the fall a point, and the return to them.

    Attributes
    ----------
    ways
        (m, d, p) stress that flow of 1 relieves (Pa).
    multiplier
        (m, p, d) flow by the trial stress (1/Pa).
    flow, stress
        (m, p) and (m, d): flow, and the stress returned (Pa).
    rises
        (m, p) by how much flow grows with the share.
    aside
        (m, d) by how much the stress falls as ways turn (Pa).
    """

    ways: Floats
    multiplier: Floats
    flow: Floats
    stress: Floats
    rises: Floats
    aside: Floats

    @classmethod
    def of(cls, planes: TurningPlanes, trial: Floats, share: Floats) -> "_Standing":
        """Return those of shares (m,) and trial stresses (m, d)."""
        (normal, way), (turn, swing) = (
            planes.first,
            tuple(last - first for first, last in zip(planes.first, planes.last, strict=True)),
        )
        done = share[:, None, None]
        yields = normal + done * turn
        ways = planes.elastic @ (way + done * swing).swapaxes(1, 2)
        inverse = np.linalg.inv(yields @ ways)
        strength = planes.strength - np.outer(share, planes.falls)
        multiplier = inverse @ yields
        flow = (multiplier @ trial[:, :, None] - inverse @ strength[:, :, None])[:, :, 0]
        stress = trial - (ways @ flow[:, :, None])[:, :, 0]
        aside = flow @ swing @ planes.elastic.T
        eased = stress @ turn.T + planes.falls - (yields @ aside[:, :, None])[:, :, 0]
        rises = (inverse @ eased[:, :, None])[:, :, 0]
        return cls(ways, multiplier, flow, stress, rises, aside)


def planes_between(
    elastic: Floats, ends: tuple[Normals, Normals], strength: Floats, falls: Floats
) -> ActingPlanes:
    """Return planes that act together between both ends of their fall."""
    first, last = ends
    if all(np.array_equal(*pair) for pair in zip(first, last, strict=True)):
        return Planes.of(elastic, first, strength, falls)
    return TurningPlanes(elastic, first, last, strength, falls)
