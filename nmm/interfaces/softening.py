"""Bonds that lose their strength gradually, over an opening fixed by the fracture energy."""

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.errors import SceneError
from nmm.interfaces.history import DAMAGE, History, HistoryColumn
from nmm.interfaces.limits import Limits
from nmm.interfaces.mohr_coulomb import MohrCoulomb
from nmm.interfaces.passage import Passage
from nmm.interfaces.response import InterfaceResponse
from nmm.interfaces.softening_curve import SofteningCurve


@dataclass(frozen=True)
class Softening(MohrCoulomb):
    """Base of cohesive laws (Hillerborg, Modeer and Petersson 1976).

    Tensile strength and cohesion decrease together, by the share ``g``, as the crack opens by ``w``
    or slides by ``s``; damage is ``w`` (or ``s``) over the width at which no strength is left. The
    elastic stretch of the bond's spring adds to ``w``, so that the area under the curve of force
    over opening is the fracture energy for any spring. An open bond unloads to the origin along its
    secant and has its full stiffness under compression; the slip of a sliding one is plastic. As
    the bond is lost, friction changes from its peak to its residual angle.
    """

    def __post_init__(self) -> None:
        if not self.bonded or not self.fracture_energy or not self.tensile_strength:
            raise SceneError(
                f"interface law {type(self).__name__}: bonded {self.bonded}, fracture_energy "
                f"{self.fracture_energy}, tensile_strength {self.tensile_strength}: expected "
                "bonded = true and both above zero: give them, or take law = 'mohr_coulomb'"
            )

    @property
    @abstractmethod
    def curve(self) -> tuple[Floats, Floats]:
        """Crack widths in units of fracture energy over strength, and shares of strength left."""

    @property
    def columns(self) -> Mapping[str, HistoryColumn]:
        return {**super().columns, "damage": DAMAGE}

    @property
    def least_stiffness(self) -> float:
        """See `InterfaceLaw.least_stiffness`: the steepest fall of strength over the opening."""
        falls = -np.diff(self.curve[1]) / np.diff(self._widths)
        return float(self.tensile_strength * falls.max())

    def response(self, history: History, stiffness: Floats) -> InterfaceResponse:
        """Return the strength left, and the secant stiffness of open bonds."""
        damage = history["damage"]
        left = self._softens.left(damage)
        strength, crack = left * self.tensile_strength, stiffness * damage * self._widths[-1]
        intact, residual = np.tan(self.friction_angle), np.tan(self.residual_angle)
        limits = Limits(
            tension=strength,
            cohesion=left * self.cohesion,
            friction=left * intact + (1 - left) * residual,
        )
        open_share = np.where(damage < 1, strength / (strength + crack), 1.0)
        return InterfaceResponse(limits, open_share, self.rise(history))

    def overload(self, pull: Floats, shear: Floats) -> Floats:
        """Return zeros: nothing breaks at once."""
        return np.zeros(len(pull))

    def onset(self, pull: Floats, shear: Floats) -> Floats:
        """See `InterfaceLaw.onset`: softening begins where a brittle bond would break."""
        return super().overload(pull, shear)

    def evolved(
        self, history: History, gap: Floats, sliding: Floats, stiffness: Floats
    ) -> dict[str, Floats]:
        """See `InterfaceLaw.evolved`; the width of a crack is its opening less the elastic part."""
        after = super().evolved(history, gap, sliding, stiffness)
        bonded = history["bonded"]
        damage = np.ones_like(gap)
        columns = (history["damage"], gap, sliding, stiffness)
        damage[bonded] = self._damaged(*(column[bonded] for column in columns))
        return after | {"damage": damage, "bonded": bonded & (damage < 1)}

    def dissipated(self, passage: Passage) -> Floats:
        """See `InterfaceLaw.dissipated`: from the damage at both ends, however long the step."""
        (start, end), opening = passage.history, passage.gap[1]
        damage, normal = (start["damage"], end["damage"]), passage.stiffness[0]
        reached = self._damaged(damage[0], opening, np.zeros_like(opening), normal)
        reached = np.minimum(reached, damage[1])
        opened = self._softens.by_opening(damage, reached, opening, normal)
        return opened + self._rubbed(damage, passage)

    def _rubbed(self, damage: tuple[Floats, Floats], passage: Passage) -> Floats:
        """Energy (m,) that the shear stress took along what was slid, less the work of lifting.

        The stress is the bound, ``left (c + p (tan phi - tan phi_r)) + p tan phi_r``, as it falls
        with damage, or once it has fallen to what the shear spring carries.
        """
        softens, way, pressure = self._softens, np.abs(passage.sliding), passage.pressure
        residual = pressure * np.tan(self.residual_angle)
        lost = self.cohesion + pressure * np.tan(self.friction_angle) - residual
        carried = np.abs(passage.stiffness[1] * (passage.slip[1] + passage.sliding)) - residual
        at = np.divide(carried, lost, out=np.ones_like(lost), where=lost != 0)
        left = np.clip(at, softens.left(damage[1]), softens.left(damage[0]))
        begun = np.clip(softens.damage(left), *damage)
        within = np.minimum(way, self._slip_width * (damage[1] - begun)) if self.cohesion else way
        mean = within * softens.mean(begun, damage[1]) + (way - within) * softens.left(damage[1])
        lifted = self.rise(passage.history[1]) - self.rise(passage.history[0])
        return np.asarray(lost * mean + residual * way - pressure * lifted)

    def _damaged(
        self, damage: Floats, opening: Floats, sliding: Floats, stiffness: Floats
    ) -> Floats:
        """Return the damage (m,) of bonds.

        Raises
        ------
        SceneError
            When the bond's spring is so soft that its force would fall at a standstill.
        """
        share = self.curve[1]
        opening_at = self._widths + np.outer(self.tensile_strength / stiffness, share)
        span = np.diff(opening_at, axis=1)
        if (span <= 0).any():
            raise SceneError(
                f"interface law {type(self).__name__}: normal stiffness {stiffness.min():.4g} Pa/m "
                f"of a bond: expected above {self.least_stiffness:.4g} Pa/m, as its strength and "
                "fracture energy ask for: give the interface a normal_stiffness, or raise "
                "bond_stiffness"
            )
        passed = np.clip((opening[:, None] - opening_at[:, :-1]) / span, 0.0, 1.0)
        width = passed @ np.diff(self._widths)
        slid = np.abs(sliding) / self._slip_width if self.cohesion else np.zeros_like(sliding)
        return np.asarray(np.clip(np.maximum(width / self._widths[-1], damage + slid), damage, 1.0))

    @property
    def _widths(self) -> Floats:
        assert self.fracture_energy is not None
        return np.asarray(self.curve[0] * self.fracture_energy / self.tensile_strength)

    @property
    def _softens(self) -> SofteningCurve:
        return SofteningCurve(self._widths, self.curve[1], self.tensile_strength)

    @property
    def _slip_width(self) -> float:
        energy = self.shear_fracture_energy or self.fracture_energy
        assert energy is not None
        return float(self.curve[0][-1] * energy / self.cohesion)


@dataclass(frozen=True)
class LinearSoftening(Softening):
    """Strength falls linearly to zero at ``w = 2 GF / ft``."""

    @property
    def curve(self) -> tuple[Floats, Floats]:
        return np.array([0.0, 2.0]), np.array([1.0, 0.0])


@dataclass(frozen=True)
class BilinearSoftening(Softening):
    """To a third at ``0.8 GF / ft``, to zero at ``3.6 GF / ft`` (Petersson 1981)."""

    @property
    def curve(self) -> tuple[Floats, Floats]:
        return np.array([0.0, 0.8, 3.6]), np.array([1.0, 1 / 3, 0.0])


def _exponential() -> tuple[Floats, Floats]:
    """``exp(-w)`` by a hundred chords to 8, then straight to zero at 10; the area is one."""
    widths = np.append(np.linspace(0.0, 8.0, 101), 10.0)
    share = np.append(np.exp(-widths[:-1]), 0.0)
    return widths / np.trapezoid(share, widths), share


@dataclass(frozen=True)
class ExponentialSoftening(Softening):
    """Falls as ``exp(-w ft / GF)``, to 1e-3 of what is left; zero from ``10 GF / ft`` on."""

    points: ClassVar[tuple[Floats, Floats]] = _exponential()

    @property
    def curve(self) -> tuple[Floats, Floats]:
        return self.points
