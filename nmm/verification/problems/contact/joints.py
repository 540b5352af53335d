"""Joints with stiffness and strength: jointed column, direct shear, pull-off, a chain of bonds."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import MESHES, Check, Checks, SceneCase
from nmm.verification.reading import last_way, way

if TYPE_CHECKING:
    from nmm.stepping.run import Run
ROUNDING = "the linear fields of blocks hold the solution; residual 1e-8"


class JointedColumn(SceneCase):
    """Blocks and joints in series: ``u = sigma (H / E + n / kn)``."""

    name = "B18 column"
    title = "Column with joints of given stiffness"
    source = "Springs in series"
    formulations = ("dda", "degree 2", *MESHES)
    joints = 4
    stress = -1e6
    modulus = 1e10
    stiffness = 5e9

    def scene(self) -> str:
        """Return a column of 5 m in 5 blocks, pressed on its top.

        Joints act at their Gauss points, where the forces of a uniform stress are those of a
        traction for every degree; two forces at the corners bend a block of degree 2.
        """
        high = self.joints + 1
        springs = {"normal_stiffness": self.stiffness, "shear_stiffness": self.stiffness}
        return text.scene(
            'title = "Jointed column"\nplane = "stress"\n[contact]\n'
            '[formulation.contact]\njoint_points = "gauss"\n',
            [
                text.material("rock", modulus=self.modulus, poisson=0.0, density=None),
                text.interface("joint", 30.0, more=springs),
                *(
                    text.block(f"block {n}", "rock", text.rectangle((0, n), (1, n + 1)))
                    for n in range(high)
                ),
                text.fixed_edge("foot", [[0, 0], [1, 0]]),
                text.pulled_edge("top", [[0, high], [1, high]], [0, self.stress]),
                text.monitor("foot", (0.5, 0), "block 0"),
                text.monitor("top", (0.5, high), f"block {self.joints}"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        short = last_way(run, "top")[1] - last_way(run, "foot")[1]
        length = self.joints + 1
        expected = self.stress * (length / self.modulus + self.joints / self.stiffness)
        stress = run.stress[:, 1]
        return {
            "shortening (m)": Check(short, expected, 1e-7, ROUNDING),
            "smallest stress (Pa)": Check(float(stress.min()), self.stress, 1e-7, ROUNDING),
            "largest stress (Pa)": Check(float(stress.max()), self.stress, 1e-7, ROUNDING),
        }


class DirectShear(SceneCase):
    """A bonded joint is sheared under constant load: slope, peak and residual resistance."""

    name = "B18 shear"
    title = "Direct shear of a bonded joint"
    source = "Slope ks A, peak c A + N tan phi, residual N tan phi"
    formulations = ("rigid", "dda")
    stiffness = 1e9
    cohesion = 2e5
    friction = 30.0
    load = 1e5
    travel = 1e-3

    def scene(self) -> str:
        """Return a block of 1 m on another, pressed by its weight and driven sideways.

        All of its outline is driven, so that it does not tilt and both ends of the joint carry
        alike. The displacement grows with the load factor.
        """
        law = {
            "cohesion": self.cohesion,
            "tensile_strength": 1e6,
            "bonded": True,
            "normal_stiffness": 100 * self.stiffness,
            "shear_stiffness": self.stiffness,
        }
        return text.scene(
            'title = "Direct shear"\nplane = "stress"\n[contact]\n[loading]\n'
            "scaled = []\nuntil = 1\n"
            f"[gravity]\nacceleration = [0, {-self.load / 1e3!r}]\n"
            "[formulation.loading]\nincrement = 0.01\ntolerance = 1e-4\n",
            [
                text.material("rock", modulus=1e12, poisson=0.0, density=1000.0),
                text.interface("bond", self.friction, more=law),
                text.block("lower", "rock", text.rectangle((-1, -1), (2, 0))),
                text.block("upper", "rock", text.rectangle((0, 0), (1, 1))),
                text.fixed_block("lower"),
                '[[supports]]\nname = "drive"\nblock = "upper"\nfix = ["x"]\n'
                f"displacement = [{self.travel!r}, 0]\nhistory = [[0, 0], [1, 1]]\n",
                text.monitor("upper", (0.5, 0), "upper"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        force, slip = run.history["reaction:drive:x"], way(run, "upper")[:, 0]
        friction = self.load * float(np.tan(np.radians(self.friction)))
        peak = int(force.argmax())
        slope = force[peak // 2] / slip[peak // 2]
        series = "ks A in series with the shear of blocks of 1e12 Pa held on their outline"
        return {
            "slope (N/m)": Check(slope, self.stiffness, 2e-3, series),
            "peak (N)": Check(
                force.max(), self.cohesion + friction, 1e-3, "tolerance of the load 1e-4 a step"
            ),
            "residual (N)": Check(force[-1], friction, 1e-5, "the sheared blocks tilt by 5e-6 rad"),
            "broken": Check(run.history["broken"][-1], 2.0, 0.0, "both points of the joint"),
        }


@dataclass(frozen=True)
class Chain(SceneCase):
    """Of bonds in series the weakest breaks, at its own strength."""

    name = "C3"
    title = "Bar of 100 mm with bonds of 3.0, 2.7 and 3.3 MPa"
    source = "Peak = smallest f_t times A; u = sigma L / E up to it"
    formulations = ("dda",)
    strengths: tuple[float, ...] = (3.0, 2.7, 3.3)
    area = 1e-4
    parameters: ClassVar = {"strengths": ((3.0,), (3.0, 2.7, 3.3))}  # one bond and three in series

    @property
    def variant(self) -> str:
        return f"{len(self.strengths)} bonds"

    def scene(self) -> str:
        """Return a bar of 10 mm x 10 mm that is held left and pulled right."""
        count = len(self.strengths) + 1
        x = np.linspace(0, 0.1, count + 1)
        names = [f"part{n}" for n in range(count)]
        law = {"cohesion": 30e6, "bonded": True}
        return text.scene(
            'title = "Chain of bonds"\nplane = "stress"\nthickness = 0.01\n[contact]\n[loading]\n'
            'until = "failure"\n[formulation.loading]\nincrement = 0.1\ntolerance = 1e-4\n',
            [
                *(text.material(n, modulus=30e9, poisson=0.0, density=None) for n in names),
                *(
                    text.interface(
                        f"bond{n}",
                        30.0,
                        (names[n], names[n + 1]),
                        {**law, "tensile_strength": strength * 1e6},
                    )
                    for n, strength in enumerate(self.strengths)
                ),
                *(
                    text.block(name, name, text.rectangle((low, 0), (high, 0.01)))
                    for name, low, high in zip(names, x[:-1], x[1:], strict=True)
                ),
                text.fixed_edge("left", [[0, 0], [0, 0.01]]),
                text.pulled_edge("pull", [[0.1, 0], [0.1, 0.01]], [1e6, 0]),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        weakest = min(self.strengths) * 1e6 * self.area
        found = run.summary.failure_load
        frame = run.frames[-1]
        strength = np.array(self.strengths) * 1e6 * self.area / 2
        bond = np.round(frame.contact_position[:, 0] * (len(self.strengths) + 1) / 0.1).astype(int)
        load = frame.contact_force[:, 0] / strength[bond - 1]
        return {
            "peak (N)": Check(
                float("nan") if found is None else found, weakest, 2e-4, "bracket of the load 1e-4"
            ),
            "bond that fails": Check(
                float(bond[load.argmax()] - 1), float(np.argmin(self.strengths)), 0.0, "one of them"
            ),
        }
