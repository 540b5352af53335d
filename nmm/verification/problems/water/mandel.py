"""Soil between stiff plates that drains sideways: pressure rises in the middle before it falls."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds, limit
from nmm.verification.problems.water.seepage import consolidating, pressure

if TYPE_CHECKING:
    from nmm.stepping.run import Run

HALF, HIGH = 1.0, 1.0
"""Half of the width, and of the height (m)."""
MODULUS, POISSON, FORCE, WEIGHT, STORAGE = 1e7, 0.2, 1e5, 1.0, 1e-3
"""Of drained soil (Pa); force on half a plate (N/m); of water (N/m3); storage times M / w."""
TERMS = 40


class Mandel:
    """Mandel's series (1953), as Cheng and Detournay (1988) write it, for grains that do not give.

    Times are those of ``c t / a^2``.
    """

    shear = MODULUS / 2 / (1 + POISSON)
    bulk = MODULUS / 3 / (1 - 2 * POISSON)

    @cached_property
    def water(self) -> float:
        """Biot's modulus (Pa): the weight of water over the storage."""
        return (self.bulk + 4 * self.shear / 3) / STORAGE

    @cached_property
    def undrained(self) -> float:
        """Poisson ratio of soil whose water cannot leave."""
        bulk = self.bulk + self.water
        return float((3 * bulk - 2 * self.shear) / (2 * (3 * bulk + self.shear)))

    @cached_property
    def skempton(self) -> float:
        """Pressure by mean stress where water cannot leave."""
        return float(self.water / (self.bulk + self.water))

    @cached_property
    def diffusivity(self) -> float:
        """``c w / k``: of pressures (Pa)."""
        confined = self.bulk + 4 * self.shear / 3
        return float(self.water * confined / (confined + self.water))

    @cached_property
    def roots(self) -> Floats:
        """Solutions (n,) of ``tan x = x (1 - nu) / (nu_u - nu)``, by bisection."""
        ratio = (1 - POISSON) / (self.undrained - POISSON)
        low = np.pi * np.arange(TERMS)
        sign, high = np.cos(low), low + np.pi / 2
        for _ in range(60):
            middle = (low + high) / 2
            above = sign * (np.sin(middle) - ratio * middle * np.cos(middle)) > 0
            low, high = np.where(above, low, middle), np.where(above, middle, high)
        return np.asarray((low + high) / 2)

    @property
    def weights(self) -> Floats:
        """``1 / (x - sin x cos x)`` of the roots (n,)."""
        x = self.roots
        return np.asarray(1 / (x - np.sin(x) * np.cos(x)))

    def at_once(self) -> float:
        """Pressure everywhere as the load comes (Pa)."""
        return FORCE * self.skempton * (1 + self.undrained) / (3 * HALF)

    def pressure(self, x: Floats, time: float) -> Floats:
        """Pressure (m,) at ``x`` over the half width (Pa)."""
        roots, falls = self.roots, np.exp(-(self.roots**2) * time)
        shape = np.cos(np.outer(x, roots)) - np.cos(roots)
        return np.asarray(2 * self.at_once() * shape @ (np.sin(roots) * self.weights * falls))

    def sinking(self) -> tuple[float, Floats]:
        """Way of the plate (m): its end, and factors (n,) of ``exp(-x^2 t)`` to add."""
        x = self.roots
        drained = -FORCE * HIGH * (1 - POISSON) / (2 * self.shear * HALF)
        factor = FORCE * HIGH * (1 - self.undrained) / (self.shear * HALF)
        return drained, factor * np.sin(x) * np.cos(x) * self.weights

    def widening(self, time: float) -> float:
        """Way of the free edge outwards (m)."""
        x, falls = self.roots, np.exp(-(self.roots**2) * time)
        part = np.sin(x) * np.cos(x) * self.weights @ falls
        size = FORCE / (2 * self.shear)
        return float(size * (POISSON + 2 * (1 - self.undrained) * part))


@dataclass(frozen=True)
class SqueezedSoil(SceneCase):
    """A quarter of soil between two stiff plates without friction; water leaves at its free edge.

    The plate is led down as Mandel's series says, which is to take a force that never changes. As
    the edge drains and gives way the middle carries more: its pressure rises above the first one
    (Mandel 1953, Cryer 1963), which no theory does in which pressure spreads by itself.
    """

    name = "WA14"
    title = "Mandel and Cryer's rise of pressure"
    source = "Mandel 1953; series as in Cheng and Detournay 1988"
    formulations = ("quads",)
    steps: int = 40
    time: float = 0.08
    label = "{0.steps} steps to c t / a^2 = {0.time:g}"
    cover: ClassVar = {"size": 0.1}

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """While the middle rises, in steps of two lengths, and as all drains."""
        return [cls(), cls(160), cls(80, 0.5)]

    @property
    def slow(self) -> bool:
        """More steps than needed to show it."""
        return self.steps > 40

    def scene(self) -> str:
        """Return the quarter; a unit of time is the half width squared over the diffusivity."""
        exact = Mandel()
        end, parts = exact.sinking()
        sums = "".join(
            f"+({float(part)!r})*exp(-{float(root**2 * self.time)!r}*t)"
            for part, root in zip(parts[:12], exact.roots, strict=False)
        )
        plate = f'["0", "{end!r}{sums}"]'
        storage = WEIGHT / exact.water
        conductivity = HALF**2 * WEIGHT / exact.diffusivity
        a, b = HALF, HIGH
        return text.scene(
            consolidating("Mandel", b, WEIGHT, self.time, self.steps),
            [
                text.material("soil", MODULUS, POISSON, None)
                + f"hydraulic_conductivity = {conductivity!r}\nspecific_storage = {storage!r}\n",
                text.block("soil", "soil", text.rectangle((0, 0), (a, b))),
                f'[[heads]]\nname = "edge"\nsegment = [[{a}, 0], [{a}, {b}]]\nhead = {b!r}\n',
                text.fixed_edge("plate", [[0, b], [a, b]], "y") + f"field = {plate}\n",
                text.fixed_edge("middle", [[0, 0], [0, b]], "x"),
                text.fixed_edge("half", [[0, 0], [a, 0]], "y"),
                text.monitor("edge", (a, b / 2), "soil"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        exact = Mandel()
        place = np.array([0.02, 0.5, 0.9])
        points = np.stack([HALF * place, np.full(3, HIGH / 2)], axis=1)
        first = exact.at_once()
        found = pressure(run, points) / first
        known = exact.pressure(place, self.time) / first
        force = -float(run.history["reaction:plate:y"][-1])
        steps = "of order 1 in the step"
        share = 1.25 * self.time / self.steps
        checks = {
            f"pressure at {x:g} a (of the first)": Check(one, other, share, steps, scale=1.0)
            for x, one, other in zip(place, found, known, strict=True)
        }
        if self.time < 0.1:
            checks["the middle is above the first"] = holds(found[0] > 1.0, "Mandel and Cryer")
        moved = float(run.history["monitor:edge:ux"][-1])
        seepage = run.stepper.plan.effects["consolidation"]
        return {
            **checks,
            "force of the plate (N/m)": Check(force, FORCE, share, steps),
            "edge outwards (m)": Check(moved, exact.widening(self.time), share, steps),
            "water unaccounted for": limit(seepage.imbalance(run.state), 1e-9, "rounding"),
        }
