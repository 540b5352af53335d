"""Plane waves that come aslant on a viscous boundary, which sends part of them back."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.formulations import with_cover
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run

# Poisson's ratio 1/4, a density and a shear wave speed of one; a pulse of so many seconds.
P_SPEED, PULSE = float(np.sqrt(3)), 0.6
SIDE = 1.0
CELLS = {"splines": 20}
LONGER = 0.3
"""Time (s) beyond that in which the last wave has passed the middle."""
KNOWN = {
    ("P", 30): 0.00031,
    ("P", 60): 0.03590,
    ("P", 75): 0.20269,
    ("SV", 15): 0.00297,
    ("SV", 30): 0.03590,
}
"""Share of the energy that comes back, by wave and angle from the normal (degrees)."""


@dataclass(frozen=True)
class PlaneWave:
    """A plane wave ``way f(t - slow . x - late)``."""

    way: Floats
    slow: Floats
    late: float

    @classmethod
    def of(cls, kind: str, along: float, upward: bool, late: float) -> Self:
        """Return a wave of a slowness along x (s/m) that goes up or down."""
        speed = P_SPEED if kind == "P" else 1.0
        sign = 1 if upward else -1
        slow = np.array([along, sign * np.sqrt(1 / speed**2 - along**2)])
        ahead = slow * speed
        return cls(ahead if kind == "P" else np.array([-ahead[1], ahead[0]]), slow, late)

    @property
    def traction(self) -> Floats:
        """Stress (xy, yy) where ``f' = 1``."""
        strain = -(np.outer(self.slow, self.way) + np.outer(self.way, self.slow)) / 2
        stress = (P_SPEED**2 - 2) * np.trace(strain) * np.eye(2) + 2 * strain
        return np.asarray(stress[:, 1])

    def expressions(self, size: float) -> list[str]:
        """Return both displacements as a scene writes them."""
        x, y = map(float, self.slow)
        time = f"t - ({x!r})*x - ({y!r})*y - ({self.late!r})"
        shape = f"sin(pi*min(max({time}, 0), {PULSE})/{PULSE})**4"
        return [f"({float(size * one)!r})*{shape}" for one in self.way]

    def pulse(self, times: Floats, point: Floats) -> Floats:
        """Return ``f`` (n,) at a point."""
        since = np.clip(times - self.slow @ point - self.late, 0, PULSE)
        return np.asarray(np.sin(np.pi * since / PULSE) ** 4)


@dataclass(frozen=True)
class ObliqueWave(SceneCase):
    """The exact field of an incoming wave and of what dashpots send back, held at three edges."""

    kind: str = "P"
    degrees: int = 60
    name = "BM3"
    title = "Waves that come aslant on a viscous boundary"
    source = "Lysmer and Kuhlemeyer (1969): balance of plane waves and dashpots"
    formulations = ("manifold degree 2", "quads degree 2", "splines")
    label = "{0.kind} at {0.degrees} degrees"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return waves whose reflections are all plane."""
        return [cls(*one) for one in KNOWN]

    @cached_property
    def waves(self) -> list[PlaneWave]:
        """The wave that comes, which enters at the top left, and those that go back."""
        speed = P_SPEED if self.kind == "P" else 1.0
        along = float(np.sin(np.radians(self.degrees))) / speed
        coming = PlaneWave.of(self.kind, along, upward=False, late=0.0)
        late = -float(coming.slow[1]) * SIDE
        return [
            PlaneWave(coming.way, coming.slow, late),
            PlaneWave.of("P", along, upward=True, late=late),
            PlaneWave.of("SV", along, upward=True, late=late),
        ]

    @cached_property
    def sizes(self) -> Floats:
        """Amplitudes (3,): stress at the edge is what dashpots of both wave speeds exert."""
        rest = np.stack([one.traction - [1.0, P_SPEED] * one.way for one in self.waves], axis=1)
        return np.append(1.0, np.linalg.solve(rest[:, 1:], -rest[:, 0]))

    def scene(self) -> str:
        """Return a square whose foot is the boundary."""
        each = [one.expressions(size) for one, size in zip(self.waves, self.sizes, strict=True)]
        field = [" + ".join(parts) for parts in zip(*each, strict=True)]
        edges: dict[str, list[text.Corner]] = {
            "left": [(0, 0), (0, SIDE)],
            "right": [(SIDE, 0), (SIDE, SIDE)],
            "top": [(0, SIDE), (SIDE, SIDE)],
        }
        return text.scene(
            f'title = "Oblique wave"\nplane = "strain"\nduration = {self._last!r}\n[inertia]\n'
            '[formulation.integrator]\ntype = "newmark"\nstep = 0.01\n'
            '[formulation.rotation]\nupdate = "small"\n',
            [
                text.material("ground", 2.5, 0.25, 1.0),
                text.box("ground", (0, 0), (SIDE, SIDE), "ground"),
                f'[[viscous_boundaries]]\nname = "foot"\nsegment = [[0, 0], [{SIDE}, 0]]\n',
                *(
                    text.fixed_edge(name, ends) + f'field = ["{field[0]}", "{field[1]}"]\n'
                    for name, ends in edges.items()
                ),
                text.monitor("foot", (SIDE / 2, 0), "ground"),
                text.monitor("middle", (SIDE / 2, SIDE / 2), "ground"),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return cells of a seventh of the shear pulse."""
        return with_cover(super().formulation(scene, name), size=SIDE / CELLS.get(name, 8))

    @property
    def _last(self) -> float:
        """Time (s) at which all waves have passed the middle."""
        middle = np.array([SIDE / 2, SIDE / 2])
        return float(max(one.slow @ middle + one.late for one in self.waves)) + PULSE + LONGER

    def measure(self, run: "Run") -> Checks:
        """Compare the amplitudes that fit what the monitors felt, and the energy sent back."""
        times = run.history["time"]
        rows, felt = [], []
        for name, point in (("foot", (SIDE / 2, 0)), ("middle", (SIDE / 2, SIDE / 2))):
            shapes = [np.outer(one.pulse(times, np.array(point)), one.way) for one in self.waves]
            rows.append(np.stack([one.ravel() for one in shapes], axis=1))
            felt.append(way(run, name)[:, :2].ravel())
        fitted = np.linalg.lstsq(np.concatenate(rows), np.concatenate(felt), rcond=None)[0]
        flux = [abs(float(one.slow[1])) * float(_power(one)) for one in self.waves]
        share = sum(f * a**2 for f, a in zip(flux[1:], fitted[1:], strict=True)) / flux[0]
        off = float(np.abs(np.concatenate(rows) @ self.sizes - np.concatenate(felt)).max())
        fine = "five cells of second degree in a shear pulse, steps of a sixtieth of it"
        return {
            "pressure wave sent back": Check(fitted[1], self.sizes[1], 2e-3, fine, 1.0),
            "shear wave sent back": Check(fitted[2], self.sizes[2], 2e-3, fine, 1.0),
            "energy sent back": Check(share, KNOWN[self.kind, self.degrees], 2e-3, fine, 1.0),
            "largest error over the largest way": Check(off, 0.0, 0.015, fine, 1.0),
        }


def _power(wave: PlaneWave) -> float:
    """Energy flux of a wave over its slowness along the normal: ``rho c^2`` for ``rho = 1``."""
    return float(1 / (wave.slow @ wave.slow))
