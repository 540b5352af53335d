"""Ground shaken from below: a layer on rock, and level ground cut out of it."""

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.geometry.tessellation.cover_types import highest_degree
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.formulations import with_cover
from nmm.verification.problems.motion.shaking import NEWMARK, SMALL, record
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run
PULSE = 0.1 * np.sin(np.pi * np.arange(41) / 40) ** 2
"""Velocity (m/s) of a wave going up, every 5 ms."""


class LayerOnRock(SceneCase):
    """A column of soil on rock: a shear wave comes in through a viscous boundary and rings."""

    name, title = "BM2", "Soil on rock under a pulse that comes from below"
    source = "d'Alembert: 2 T R^n v(t - (2 n + 1) H / Vs), T = 1.65517241, R = -0.65517241"
    formulations: ClassVar[tuple[str, ...]] = (
        *("finite elements", "bilinear quads", "manifold", "quads", "splines"),
    )
    width = 3.0
    sides: ClassVar[tuple[str, ...]] = (
        '[[supports]]\nname = "level"\nblock = "soil"\nfix = ["y"]\n',
    )

    def scene(self) -> str:
        """Return the ground, 30 m of soil."""
        wide = self.width
        return text.scene(
            'title = "Layer on rock"\nplane = "strain"\nduration = 0.5\n[inertia]\n'
            + NEWMARK.format(step=0.0025)
            + SMALL,
            [
                text.material("soil", 450e6, 0.25, 2000.0),
                text.block("soil", "soil", text.rectangle((0, 0), (wide, 30))),
                record("wave", PULSE.round(12).tolist(), 0.005, 'quantity = "velocity"\n'),
                '[[viscous_boundaries]]\nname = "base"\nincoming = { x = "wave" }\n'
                f"segment = [[0, 0], [{wide}, 0]]\n"
                "density = 2400.0\np_velocity = 2400.0\ns_velocity = 1200.0\n",
                *self.sides,
                text.monitor("left", (0.0, 30.0), "soil"),
                text.monitor("middle", (wide / 2, 30.0), "soil"),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return twenty cells a wave, or thirty where functions are linear or constant."""
        degree = highest_degree(super().formulation(scene, name).cover)
        return with_cover(super().formulation(scene, name), size=3.0 if degree else 1.5)

    def measure(self, run: "Run") -> Checks:
        speed, time = surface(run, "left")
        reason = "dispersion of the mesh: 2 % of peaks at twenty cells a wave"
        first = time[np.argmax(speed)]
        return {
            "first peak (m/s)": Check(speed.max(), 0.33103448, 0.02, reason),
            "second peak (m/s)": Check(speed.min(), -0.21688466, 0.02, reason),
            "time of the first peak (s)": Check(float(first), 0.2, 0.01, reason),
        }


class LevelGround(LayerOnRock):
    """The same ground 60 m wide between free fields: every line moves as the column."""

    name, title = "BM4", "Level ground between free fields"
    formulations = ("bilinear quads", "quads")
    width = 60.0
    sides = tuple(
        f'[[free_fields]]\nname = "{name}"\nbase = "base"\nsegment = [[{x}, 0], [{x}, 30]]\n'
        for name, x in (("left", 0.0), ("right", 60.0))
    )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return cells of 2.5 m, or of 6 m with functions of degree 1."""
        degree = highest_degree(super().formulation(scene, name).cover)
        return with_cover(super().formulation(scene, name), size=6.0 if degree else 2.5)

    def measure(self, run: "Run") -> Checks:
        found = super().measure(run)
        middle, _ = surface(run, "middle")
        side, _ = surface(run, "left")
        rise = np.abs(way(run, "left")[:, 1]).max() / np.abs(way(run, "left")[:, 0]).max()
        unlike = float(np.abs(middle - side).max() / np.abs(middle).max())
        return {
            **found,
            "difference of side and middle": limit(unlike, 0.02, "the free field is level ground"),
            "rise over sway": limit(float(rise), 1e-3, "a wave straight up moves along x alone"),
        }


def surface(run: "Run", monitor: str) -> tuple[Floats, Floats]:
    """Velocity along x (m/s) of a monitor at the middles of steps, and their times (s)."""
    moved, time = way(run, monitor)[:, 0], run.history["time"]
    return np.diff(moved) / np.diff(time), (time[1:] + time[:-1]) / 2
