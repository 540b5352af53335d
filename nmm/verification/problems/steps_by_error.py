"""Steps chosen by their error: what a run errs by against what was asked for."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from nmm.verification.base import Case, Check, Checks
from nmm.verification.problems.time_integration import FREQUENCY, oscillator

CYCLES = 5.03
ASKED = (0.1, 0.03, 0.01)


@dataclass(frozen=True)
class ErrorAsked(Case):
    """Error of an oscillator over its amplitude, a cycle, for three errors that were asked for."""

    name: ClassVar[str] = "B9 error"
    title: ClassVar[str] = "Steps chosen by an error"
    source: ClassVar[str] = "u = (v / omega) sin(omega t)"
    formulations: ClassVar[tuple[str, ...]] = ("rigid",)
    integrator: str = "newmark"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return integrators of order 2 and 1."""
        return [cls("newmark"), cls("generalized_alpha"), cls("shi")]

    @property
    def variant(self) -> str:
        """The integrator."""
        return self.integrator

    def checks(self, formulation: str) -> Checks:
        """Measure the slope of the error over what was asked for, and the smallest error."""
        found = [self._error(error) for error in ASKED]
        slope = float(np.polyfit(np.log(ASKED), np.log(found), 1)[0])
        first = "the first steps are short whatever is asked for, and steps grow by three at most"
        share = "what is asked for is met within a factor of four"
        return {
            "slope over the error asked for": Check(slope, 1.0, 0.2, first, scale=1.0),
            "logarithm of the share": Check(
                float(np.log(found[-1] / ASKED[-1])), 0.0, float(np.log(4)), share, scale=1.0
            ),
        }

    def _error(self, asked: float) -> float:
        from nmm.scene import parse_scene
        from nmm.stepping.run import run
        from nmm.verification.formulations import chosen

        text = oscillator(self.integrator, 1.0, CYCLES * 2 * np.pi / FREQUENCY)
        scene = parse_scene(text.replace("step = 1.0", f'step = "auto"\nerror = {asked!r}'))
        history = run(scene, chosen("rigid", scene.formulation)).history
        off = history["monitor:middle:ux"] * FREQUENCY - np.sin(FREQUENCY * history["time"])
        return float(abs(off).max()) / CYCLES
