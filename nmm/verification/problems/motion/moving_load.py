"""A force that travels over a beam."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.formulations import with_cover
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run


class MovingForce(SceneCase):
    """A force crosses a simply supported beam at half of its critical speed.

    The deflection of the middle is a sum of modes, each driven at ``n pi c / L``.
    """

    name, title = "ML1", "Force that travels over a beam"
    source = "Fryba (1972): modes of Euler and Bernoulli's beam under a moving force"
    formulations = ("manifold degree 2", "quads degree 2")
    length = 10.0
    height = 0.4
    modulus = 30e9
    density = 2500.0
    force = 1e4

    @property
    def first(self) -> float:
        """Lowest circular frequency (rad/s)."""
        radius = np.sqrt(self.height**2 / 12 * self.modulus / self.density)
        return float(np.pi**2 / self.length**2 * radius)

    @property
    def speed(self) -> float:
        """Half of the critical speed (m/s)."""
        return self.first * self.length / np.pi / 2

    def scene(self) -> str:
        """Return the beam on two points at mid height."""
        long, high, crossing = self.length, self.height, self.length / self.speed
        return text.scene(
            f'title = "Moving force"\nplane = "stress"\nduration = {crossing!r}\n[inertia]\n'
            f'[formulation.integrator]\ntype = "newmark"\nstep = {crossing / 150!r}\n'
            '[formulation.rotation]\nupdate = "small"\n',
            [
                text.material("concrete", self.modulus, 0.0, self.density),
                text.block("beam", "concrete", text.rectangle((0, 0), (long, high))),
                text.fixed_point("pin", [0, high / 2]),
                text.fixed_point("roller", [long, high / 2], "y"),
                f'[[loads]]\nname = "wheel"\nkind = "moving"\nspeed = {self.speed!r}\n'
                f"segment = [[0, {high}], [{long}, {high}]]\nforce = [0, {-self.force}]\n",
                text.monitor("middle", (long / 2, high / 2), "beam"),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return cells of an eighth of the beam."""
        return with_cover(super().formulation(scene, name), size=self.length / 8)

    def measure(self, run: "Run") -> Checks:
        time, found = run.history["time"], -way(run, "middle")[:, 1]
        expected = np.zeros_like(time)
        mass = self.density * self.height * self.length
        for n in range(1, 10, 2):
            own, driven = n**2 * self.first, n * np.pi * self.speed / self.length
            swing = np.sin(driven * time) - driven / own * np.sin(own * time)
            size = 2 * self.force / mass * np.sin(n * np.pi / 2) / (own**2 - driven**2)
            expected += size * swing
        reason = "shear adds 0.3 % to the first mode, and supports are springs"
        off = float(np.abs(found - expected).max())
        return {
            "largest deflection (m)": Check(found.max(), expected.max(), 0.02, reason),
            "largest error over the crossing": Check(off, 0.0, 0.02, reason, expected.max()),
        }
