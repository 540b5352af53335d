"""A layer of ground sheared under pressure: its cohesion and its friction fall in a band."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.formulation import Formulation
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.formulations import with_cover
from nmm.verification.reading import converged

if TYPE_CHECKING:
    from nmm.scene import Scene
    from nmm.stepping.run import Run

MODULUS, POISSON = 1e9, 0.25
SHEAR = MODULUS / 2 / (1 + POISSON)
COHESION, LEFT, ENERGY = 0.6e6, 0.1e6, 2e3
# Friction at first and in the end (rad), pressure from all sides (Pa), weight aside (N/m3).
PEAK, LAST, PRESSURE, PUSH = np.pi / 6, np.pi / 12, 1e6, 5e4
HEIGHT, WIDTH, WAY = 1.0, 0.25, 6e-3


def sheared_layer(
    material: str, size: text.Corner, way: float, push: float, increment: float
) -> list[str]:
    """Tables of a layer on its foot whose top is pushed aside by ``way`` (m), sides along x alone.

    Weight aside, ``push`` (N/m3), loads its foot a little more, so that it softens there.
    """
    width, height = size
    return [
        text.box("layer", (0, 0), size, material),
        text.fixed_edge("left", [(0, 0), (0, height)], "y"),
        text.fixed_edge("right", [(width, 0), (width, height)], "y"),
        text.fixed_edge("foot", [(0, 0), (width, 0)]),
        text.fixed_edge("top", [(0, height), (width, height)]) + f"displacement = [{way}, 0]\n",
        f'[[loads]]\nname = "more"\nkind = "body"\ndensity = [{push}, 0]\n',
        f'[loading]\nscaled = ["top"]\nuntil = 1.0\n[formulation.loading]\n'
        f"increment = {increment}\n",
    ]


@dataclass(frozen=True)
class SofteningLayer(SceneCase):
    """One row of cells at the foot softens, and what it takes for its area is that of any row.

    At a share ``D`` of the fall ``a t = xi0 c(D) + p b(D)`` is borne, a and b lines from 1 and eta0
    to ``xi0 / xir`` times 1 and etar, and the row has slipped by ``2 G_f (D + (xi0 / xir - 1) D^2 /
    2) / (xi0 dc)``; the rest of the layer unloads.
    """

    law: str = "mohr_coulomb"
    rows: int = 4
    name = "PL7"
    title = "Layer whose cohesion and friction fall in a band"
    source = "Shear of one row at constant volume, integrated over the share lost"
    formulations = ("bilinear quads",)
    parameters: ClassVar = {"law": ("mohr_coulomb", "drucker_prager"), "rows": (4, 8)}
    label = "{0.law}, {0.rows} rows"

    def formulation(self, scene: "Scene", name: str) -> Formulation:
        """Return cells of one row."""
        return with_cover(super().formulation(scene, name), size=HEIGHT / self.rows)

    def scene(self) -> str:
        """Return a layer whose top is pushed aside; weight aside loads its foot a little more."""
        sides = (("left", 0.0, 1), ("right", WIDTH, -1))
        return text.scene(
            'title = "Softening layer"\nplane = "strain"\n',
            [
                f'[materials.ground]\nlaw = "{self.law}"\nyoung_modulus = {MODULUS}\n'
                f"poisson_ratio = {POISSON}\ncohesion = {COHESION}\nfriction_angle = {PEAK!r}\n"
                f"softening_energy = {ENERGY}\nresidual_cohesion = {LEFT}\n"
                f"residual_friction_angle = {LAST!r}\n",
                *sheared_layer("ground", (WIDTH, HEIGHT), WAY, PUSH, 0.01),
                *(
                    text.pulled_edge(f"press {name}", [(x, 0), (x, HEIGHT)], (PRESSURE * sign, 0))
                    for name, x, sign in sides
                ),
                f'[[initial_stresses]]\nblock = "layer"\nstress = [{-PRESSURE}, {-PRESSURE}, 0]\n'
                f"across = {-PRESSURE}\n",
                '[formulation.supports]\nmethod = "lagrange"\n',
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Compare the force at the end."""
        implicit = "steps are of first order where planes turn"
        return {
            "force (N)": Check(
                run.history["reaction:top:x"][-1], self.end() * WIDTH, 1e-3, implicit
            ),
            "at rest": holds(converged(run), "every increment is in equilibrium"),
        }

    def end(self) -> float:
        """Return the stress (Pa) that the top bears at the end."""
        from scipy.optimize import brentq

        eta, xi = self._slopes()
        more, lost = xi[0] / xi[1] - 1, COHESION - LEFT

        def stress(share: float) -> float:
            friction = eta[0] + share * ((1 + more) * eta[1] - eta[0])
            borne = xi[0] * (COHESION - share * lost) + PRESSURE * friction
            return float(borne / (1 + more * share) - PUSH * HEIGHT * (1 - 1 / 2 / self.rows))

        def missing(share: float) -> float:
            slip = 2 * ENERGY / xi[0] / lost * (share + more * share**2 / 2)
            return stress(share) * HEIGHT / SHEAR + PUSH * HEIGHT**2 / 2 / SHEAR + slip - WAY

        return stress(float(brentq(missing, 0, 1, xtol=1e-14)))

    def _slopes(self) -> tuple[Sequence[float], Sequence[float]]:
        """Slopes eta and xi of both angles."""
        angles = np.array([PEAK, LAST])
        if self.law == "mohr_coulomb":
            return np.sin(angles).tolist(), np.cos(angles).tolist()
        root = np.sqrt(9 + 12 * np.tan(angles) ** 2)
        return (3 * np.tan(angles) / root).tolist(), (3 / root).tolist()
