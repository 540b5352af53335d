"""What each enforcement of contact must give exactly, and what stiffness must not change."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import EXACT, Case, Check, Checks, SceneCase, limit
from nmm.verification.reading import joint_force
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

DENSITY, MODULUS = 2600.0, 20e9


@dataclass(frozen=True)
class Penetration(SceneCase):
    """A block on two equal contacts: springs give way by ``m g / (2 p)``, exact contact by 0."""

    name = "B11 penetration"
    title = "Penetration of a block at rest"
    source = "Balance: 2 p g = m g"
    formulations = ("rigid", "dda", "open-close", *EXACT)
    penalty: float = 100.0
    # Penalties from 1 to 1e6 times the modulus.
    parameters: ClassVar = {"penalty": (1.0, 100.0, 1e6)}
    label = "p / E {0.penalty:g}"

    def scene(self) -> str:
        """Return a block of 1 m on a held one."""
        return text.scene(
            'title = "Block at rest"\nplane = "stress"\n[gravity]\n[contact]\n'
            f"[formulation.contact]\nnormal_penalty = {self.penalty!r}\n",
            [
                text.material("rock", modulus=MODULUS, poisson=0.0, density=DENSITY),
                text.interface("contact", 30.0),
                text.block("floor", "rock", text.rectangle((-1, -1), (2, 0))),
                text.block("block", "rock", text.rectangle((0, 0), (1, 1))),
                text.fixed_block("floor"),
            ],
        )

    def checks(self, formulation: str) -> Checks:
        """Run and measure; only springs give way."""
        from nmm.verification.formulations import chosen

        run = self.run(formulation)
        found = self.measure(run)
        if chosen(formulation).contact.enforcement != "penalty":
            gap = float(np.abs(run.frames[-1].contact_gap).max())
            found["penetration (m)"] = limit(gap, 1e-10, "benchmark D4's limit")
        return found

    def measure(self, run: "Run") -> Checks:
        gap, force = run.frames[-1].contact_gap, run.contact_forces[:, 0]
        weight = DENSITY * G
        expected = weight / 2 / (self.penalty * MODULUS)
        level = "coordinates of 1 m are rounded to 1e-16, 1.6e-14 at p / E = 1e6 is the gap"
        reason = level if self.penalty > 1e4 else "rounding"
        rounding = 0.05 if self.penalty > 1e4 else 1e-6
        return {
            "contacts": Check(float(len(gap)), 2.0, 0.0, "the ends of the face"),
            "penetration (m)": Check(float(-gap.min()), expected, rounding, reason),
            "left force (N)": Check(-float(force[0]), weight / 2, 1e-8, "residual"),
            "right force (N)": Check(-float(force[-1]), weight / 2, 1e-8, "residual"),
            "residual": limit(run.summary.equilibrium_residual or 0.0, 1e-8, "the benchmark's"),
        }


@dataclass(frozen=True)
class Groove(SceneCase):
    """A square lies on its corner in a right-angled groove without friction."""

    name = "D4"
    title = "Square in a right-angled groove, penalty from E to 1e6 E"
    source = "Each flank carries W / sqrt(2)"
    formulations = ("rigid", "dda", *EXACT)
    penalty: float = 100.0
    parameters: ClassVar = {"penalty": (1.0, 1e2, 1e4, 1e6)}
    label = "p / E {0.penalty:g}"

    def scene(self) -> str:
        """Return two held flanks that meet in the origin, and the square."""
        turn = np.pi / 4
        return text.scene(
            'title = "Square in a groove"\nplane = "stress"\n[gravity]\n[contact]\n'
            f"[formulation.contact]\nnormal_penalty = {self.penalty!r}\n",
            [
                text.material("rock", modulus=MODULUS, poisson=0.0, density=DENSITY),
                text.interface("contact", 0.0),
                text.block("right", "rock", text.turned(text.rectangle((0, -1), (3, 0)), turn)),
                text.block("left", "rock", text.turned(text.rectangle((-1, -1), (0, 3)), turn)),
                text.block("square", "rock", text.turned(text.rectangle((0, 0), (1, 1)), turn)),
                text.fixed_block("right"),
                text.fixed_block("left"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        expected = DENSITY * G / np.sqrt(2)
        origin, reason = np.zeros(2), "the benchmark's tolerance"
        flanks = {"right": np.array([-1.0, 1.0]), "left": np.array([1.0, 1.0])}
        checks = {
            f"{name} flank (N)": Check(
                -float(joint_force(run, origin, normal / np.sqrt(2))[0]), expected, 1e-6, reason
            )
            for name, normal in flanks.items()
        }
        residual = run.summary.equilibrium_residual or 0.0
        return {**checks, "residual": limit(residual, 1e-8, "the benchmark's")}


@dataclass(frozen=True)
class Rounds(Case):
    """The augmented Lagrangian presses a spring of stiffness k: the force after n rounds."""

    name = "B11 rounds"
    title = "Rounds of the augmented Lagrangian"
    source = "lambda_n = F (1 - (k / (k + p))^n)"
    formulations = ("augmented",)
    ratio: float = 1.0
    # Penalties from a tenth to ten times the spring.
    parameters: ClassVar = {"ratio": (0.1, 1.0, 10.0)}
    label = "p / k {0.ratio:g}"

    def checks(self, formulation: str) -> Checks:
        reason = "the benchmark's"
        found = {}
        for count in (1, 2, 3, 4):
            expected = 1.0 - (1 / (1 + self.ratio)) ** count
            found[f"force after {count} rounds over F"] = Check(
                self._force(count), expected, 1e-10, reason
            )
        return found

    def _force(self, rounds: int) -> float:
        """Push on a body on a spring of 1 N/m that 1 N presses against a wall."""
        from scipy.sparse import csc_array, csr_array

        from nmm.contact.enforcement.augmented import Augmented
        from nmm.contact.problem.step_problem import Limits, StepProblem
        from nmm.solvers.linear import make_solver

        one, none = np.ones(1), np.zeros(1)
        problem = StepProblem(
            matrix=csc_array(np.diag([1.0, 1.0])),
            force=np.array([0.0, -1.0]),
            normal_rows=csr_array(np.array([[0.0, 1.0]])),
            tangent_rows=csr_array(np.array([[1.0, 0.0]])),
            gap=none,
            slip=none,
            normal_stiffness=one,
            shear_stiffness=one,
            limits=Limits(none, none, none),
            state=np.zeros(1, dtype=np.int64),
            normal_force=none,
            shear_force=none,
        )
        method = Augmented(scale=self.ratio, growth=1.0, max_rounds=rounds, rescue=0)
        return -float(method.solve(problem, make_solver("auto", {})).normal_force[0])
