"""Cracks in motion: intensities behind a wave, and growth that does not hang on how it is laid."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.problems.cracks.crack_scenes import crack, net

if TYPE_CHECKING:
    from nmm.stepping.run import Run


class StruckCrack(SceneCase):
    """A wave of tension comes upon a crack: its intensity rises with the root of time."""

    name = "GR12"
    title = "Long crack under a wave of tension, intensity in time"
    source = (
        "K_I = 2 s / (1 - nu) sqrt(c_d t (1 - 2 nu) / pi) for a semi-infinite crack, t from the "
        "arrival of the wave (Freund 1990, 2.5)"
    )
    formulations = ("dda",)
    modulus = 210e9
    poisson = 0.3
    density = 8000.0
    stress = 500e6
    height = 2.0
    slow = True

    @property
    def fast(self) -> float:
        """Speed of waves of pressure (m/s)."""
        nu = self.poisson
        stiff = self.modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        return float(np.sqrt(stiff / self.density))

    @property
    def arrival(self) -> float:
        """When the wave arrives (s)."""
        return self.height / self.fast

    def scene(self) -> str:
        """Return a plate of ten by four, cracked half way, that is pulled all at once."""
        h = self.height
        motion = f'[formulation.integrator]\ntype = "newmark"\nstep = {self.arrival / 40!r}\n'
        tables: Sequence[str] = [
            text.material("m", self.modulus, self.poisson, self.density),
            text.block("plate", "m", text.rectangle((-5.0, -h), (5.0, h))),
            crack("c", [[-5.0, 0.0], [0.0, 0.0]]),
            text.pulled_edge("up", [[-5.0, h], [5.0, h]], [0.0, self.stress]),
            text.fixed_point("left", [-5.0, -h]),
            text.fixed_point("right", [5.0, -h], "y"),
            "[inertia]\n",
            "[fracture]\ntoughness = 1e12\nincrement = 1.0\n",
            net(0.2, 11.0),
            motion,
        ]
        return text.scene(f'plane = "strain"\nduration = {2.5 * self.arrival!r}', tables)

    def measure(self, run: "Run") -> Checks:
        time = run.history["time"] - self.arrival
        found = run.history["fracture:c:end:K_I"]
        nu = self.poisson
        root = np.sqrt(self.fast * np.maximum(time, 0.0) * (1 - 2 * nu) / np.pi)
        expected = 2 * self.stress / (1 - nu) * root
        late = (time > 0.4 * self.arrival) & (time < 1.4 * self.arrival)
        early = time < -0.2 * self.arrival
        unit = float(expected[late].max())
        return {
            "largest error once the wave is past": limit(
                float(np.abs(found / np.maximum(expected, 1e-300) - 1)[late].max()),
                0.05,
                "cells of a tenth of the way that the wave has come",
            ),
            "intensity before it arrives": limit(
                float(np.abs(found[early]).max()) / unit, 0.03, "what a sharp front leaves"
            ),
        }


@dataclass(frozen=True)
class RunningCrack(SceneCase):
    """Waves of tension from both sides meet on a long crack, which runs from then on.

    With s the sum of both, G = (4 s^2 c_d t (1 - 2 nu) / pi) (1 + nu) / ((1 - nu) E) of the crack
    at rest does not hang on its length, so that v = c_R (1 - t_0 / t) with G = G_c at t_0, and the
    tip has come c_R (t - t_0 - t_0 ln(t / t_0)). Rollers on the sides stand for an endless plate.
    """

    name = "GR17"
    title = "Long crack that runs under waves of tension, way in time"
    source = "Energy into a running tip (Freund 1990, 2.5 and 7.4), integrated by hand"
    formulations = ("dda",)
    modulus = 210e9
    poisson = 0.3
    density = 8000.0
    stress = 500e6
    half = 2.0
    piece = 0.14
    slow = True
    start: float = 0.075
    """When G is G_c, over the time that waves take to the crack."""
    parameters: ClassVar = {"start": (0.075, 0.3)}
    label = "from {0.start:g} of the way of the waves on"

    @property
    def arrival(self) -> float:
        """When the waves arrive (s)."""
        nu = self.poisson
        stiff = self.modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        return self.half / float(np.sqrt(stiff / self.density))

    @property
    def rayleigh(self) -> float:
        """Speed of Rayleigh's wave (m/s), by Viktorov's root for a Poisson ratio of 0.3."""
        return 0.9274126 * float(np.sqrt(self.modulus / (2 * (1 + self.poisson)) / self.density))

    def scene(self) -> str:
        """Return a square plate, cracked half way, that is pulled from both sides at once."""
        h, nu = self.half, self.poisson
        way = self.half * self.start
        rate = (4 * self.stress) ** 2 * way * (1 - 2 * nu) / np.pi * (1 + nu) / (1 - nu)
        sides = [text.fixed_edge(f"side {x:g}", [[x, -h], [x, h]], "x") for x in (-h, h)]
        motion = f'[formulation.integrator]\ntype = "newmark"\nstep = {self.arrival / 60!r}\n'
        tables: Sequence[str] = [
            text.material("m", self.modulus, nu, self.density),
            text.block("plate", "m", text.rectangle((-h, -h), (h, h))),
            crack("c", [[-h, 0.0], [0.0, 0.0]]),
            text.pulled_edge("up", [[-h, h], [h, h]], [0.0, self.stress]),
            text.pulled_edge("down", [[-h, -h], [h, -h]], [0.0, -self.stress]),
            *sides,
            "[inertia]\n",
            f'[fracture]\ncriterion = "straight_ahead"\nenergy = {float(rate) / self.modulus!r}\n'
            f"increment = {self.piece}\n",
            net(self.piece / 2, 11.0),
            f'{motion}[formulation.rotation]\nupdate = "small"\n',
        ]
        return text.scene(f'plane = "strain"\nduration = {2.4 * self.arrival!r}', tables)

    def measure(self, run: "Run") -> Checks:
        """Compare the way where pieces are cut, half of which tips have run through by then."""
        time = run.history["time"] - self.arrival
        grown = run.history["fracture:c:end:growth"]
        cut = np.flatnonzero(np.diff(grown) > 0) + 1
        start, late = self.start * self.arrival, time[cut]
        expected = self.rayleigh * (late - start - start * np.log(late / start))
        found = grown[cut] - self.piece / 2
        energies = ("loss:fracture", "fracture:energy")
        taken, asked = (float(run.history[name][cut[-1] - 1]) for name in energies)
        return {
            "way behind that of the closed form, largest, in pieces": limit(
                float(np.abs(found - expected).max()) / self.piece,
                0.6,
                "what flows in at rest is known from the piece before",
            ),
            "speed between the last two cuts over the closed form's": Check(
                float(np.diff(found)[-1] / np.diff(expected)[-1]), 1.0, 0.15, "the same"
            ),
            "energy taken over the fracture energy of the growth": Check(
                taken / asked, 1.0, 0.3, "tips run and stop, from piece to piece"
            ),
        }
