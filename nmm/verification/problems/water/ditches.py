"""A ditch that fills or is emptied beside ground with a water table."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run

CONDUCTIVITY, DRAINABLE = 1e-4, 0.2
LENGTH, TOP, REACH = 60.0, 6.0, 20.0
"""Of the ground, and how far the change has gone in the end (m)."""
STEPS = 40


def slope_at_ditch(beyond: float) -> float:
    """Slope at 0 of the solution of ``(u u')' + 2 s u' = 0``, 1 at 0 and ``beyond`` far away.

    Boussinesq's equation with ``s = x / sqrt(4 K h1 t / n)``, found by shooting.
    """
    from scipy.integrate import solve_ivp
    from scipy.optimize import brentq

    def far(slope: float) -> float:
        def rates(s: float, y: Floats) -> list[float]:
            level, rise = float(y[0]), float(y[1])
            return [rise, -(rise**2 + 2 * s * rise) / max(level, 1e-3)]

        found = solve_ivp(rates, (0.0, 6.0), (1.0, slope), rtol=1e-10, atol=1e-12)
        return float(found.y[0, -1] - beyond)

    return float(brentq(far, *((-2.0, -1e-9) if beyond < 1 else (1e-9, 2.0)), xtol=1e-10))


@dataclass(frozen=True)
class FilledDitch(SceneCase):
    """The level in a ditch jumps; the water table follows, long and flat against its depth.

    Dupuit's flow with Boussinesq's equation, not linearised: what the ditch gives grows with the
    square root of time. A wall with upright faces lets through what Dupuit says, exactly.
    """

    name = "WA15"
    title = "A water table that follows a ditch"
    source = "Boussinesq 1904: similar solution, by shooting"
    formulations = ("quads",)
    before: float = 2.0
    after: float = 3.0
    label = "from {0.before:g} to {0.after:g} m"
    slow = True

    @classmethod
    def variants(cls) -> "tuple[FilledDitch, ...]":
        """A ditch that fills, and one that is emptied."""
        return (cls(), cls(3.0, 2.0))

    @property
    def duration(self) -> float:
        """Time in which the change goes as far as is asked (s)."""
        return REACH**2 * DRAINABLE / (4 * CONDUCTIVITY * self.after)

    def scene(self) -> str:
        """Return the ground, which is held, and the ditch at its left."""
        return text.scene(
            'title = "Ditch"\nplane = "strain"\n',
            [
                "[materials.sand]\nyoung_modulus = 1e8\npoisson_ratio = 0.3\n"
                f"hydraulic_conductivity = {CONDUCTIVITY}\nspecific_storage = 1e-8\n"
                f"drainable_porosity = {DRAINABLE}\n",
                text.block("ground", "sand", text.rectangle((0, 0), (LENGTH, TOP))),
                text.fixed_block("ground"),
                f"[seepage]\ntransient = true\nfree_surface = true\ninitial = {self.before}\n"
                f"duration = {self.duration!r}\n",
                f'[[heads]]\nname = "ditch"\nsegment = [[0, 0], [0, {TOP}]]\nhead = {self.after}\n',
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return cells of half a metre and forty steps."""
        found = super().formulation(scene, name)
        cover = found.cover.model_copy(update={"size": 0.5})
        loading = found.loading.model_copy(update={"increment": 1 / STEPS})
        return found.model_copy(update={"cover": cover, "loading": loading})

    def measure(self, run: "Run") -> Checks:
        slope = slope_at_ditch(self.before / self.after)
        spread = CONDUCTIVITY * self.after / DRAINABLE
        given = run.history["seepage:taken:ditch"]
        time = np.asarray(run.history["time"]) * self.duration
        checks: Checks = {}
        why = (
            "at the ditch pores above the water are empty, elsewhere they hang on to some in a cell"
        )
        marks = (("at a quarter", STEPS // 4, 0.05), ("in the end", STEPS, 0.02))
        for name, at, within in marks:
            n = int(np.argmin(np.abs(time - self.duration * at / STEPS)))
            exact = -CONDUCTIVITY * self.after**2 * slope * float(np.sqrt(time[n] / spread))
            checks[f"water from the ditch {name} (m2)"] = Check(float(given[n]), exact, within, why)
        kept = float(abs(run.history["seepage:stored"][-1] / given[-1] - 1))
        checks["water that is not stored, of all"] = limit(kept, 1e-6, "balance of volume")
        return checks
