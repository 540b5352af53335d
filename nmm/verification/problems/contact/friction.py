"""Coulomb's cone: cyclic shear, admissible forces, and the strength of Mohr and Coulomb."""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import EXACT, Case, Check, Checks, SceneCase
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

LOAD, FRICTION, STIFFNESS, TRAVEL = 1e5, 0.3, 1e8, 1e-3
"""Normal force (N), tangent of the friction angle, shear stiffness (N/m), half travel (m)."""


class CyclicShear(SceneCase):
    """A joint is sheared to and fro under constant load: an elastic, then sliding, loop."""

    name = "B10 cycle"
    title = "Cyclic shear of a joint with friction"
    source = "Loop 4 T (d - T / kt) = 84 J with T = 0.3 x 1e5 N"
    formulations = ("rigid", "dda")

    def scene(self) -> str:
        """Return a block of 1 m on another, driven by 0, 1, -1, 1 mm with the load factor."""
        law = {"normal_stiffness": 1e10, "shear_stiffness": STIFFNESS}
        angle = float(np.degrees(np.arctan(FRICTION)))
        return text.scene(
            'title = "Cyclic shear"\nplane = "stress"\n[contact]\n[loading]\n'
            "scaled = []\nuntil = 5\n"
            f"[gravity]\nacceleration = [0, {-LOAD / 1e3!r}]\n"
            "[formulation.loading]\nincrement = 0.05\n",
            [
                text.material("rock", modulus=1e11, poisson=0.0, density=1000.0),
                text.interface("joint", angle, more=law),
                text.block("lower", "rock", text.rectangle((-1, -1), (2, 0))),
                text.block("upper", "rock", text.rectangle((0, 0), (1, 1))),
                text.fixed_block("lower"),
                '[[supports]]\nname = "drive"\nblock = "upper"\nfix = ["x"]\n'
                f"displacement = [{TRAVEL!r}, 0]\nhistory = [[0, 0], [1, 1], [3, -1], [5, 1]]\n",
                text.monitor("upper", (0.5, 0), "upper"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        h = run.history
        force, slip, factor = h["reaction:drive:x"], way(run, "upper")[:, 0], h["load_factor"]
        turn = int(np.argmin(np.abs(factor - 1)))
        slope = (force[turn + 1] - force[turn]) / (slip[turn + 1] - slip[turn])
        loss = h["friction_loss"][-1] - h["friction_loss"][turn]
        tilt = "the blocks give way by 1e-5 of the joint's stretch"
        return {
            "largest force (N)": Check(force.max(), FRICTION * LOAD, 2e-5, tilt),
            "smallest force (N)": Check(force.min(), -FRICTION * LOAD, 2e-5, tilt),
            "slope of unloading (N/m)": Check(slope, STIFFNESS, 1e-4, tilt),
            "energy lost in a cycle (J)": Check(float(loss), 84.0, 1e-4, tilt),
        }


class ForcedCycle(Case):
    """The same joint as one contact of two unknowns, by the enforcement alone."""

    name = "B10 enforcement"
    title = "Cyclic shear of one contact"
    source = "T = clip(T + kt du, -mu N, mu N) over the way it took"
    formulations = ("dda", "open-close", *EXACT)

    def checks(self, formulation: str) -> Checks:
        path = TRAVEL * np.interp(np.arange(0.0, 5.0, 0.02) + 0.02, [0, 1, 3, 5], [0, 1, -1, 1])
        slip, shear = driven_contact(formulation, path)
        expected, force = [], 0.0
        for step in np.diff(slip, prepend=0.0):
            force = float(np.clip(force + STIFFNESS * step, -FRICTION * LOAD, FRICTION * LOAD))
            expected.append(force)
        loop = slice(50, None)
        mean = (shear[loop] + shear[49:-1]) / 2
        loss = float(np.sum(mean * np.diff(slip)[49:]))
        kinks = "the kinks fall on ends of steps but for the give of the drive, 1e-4"
        return {
            "largest error of the force (N)": Check(
                float(np.abs(shear - expected).max()), 0.0, 1e-8, "residual", scale=LOAD
            ),
            "largest force (N)": Check(float(np.abs(shear).max()), 3e4, 1e-10, "rounding"),
            "energy lost in a cycle (J)": Check(loss, 84.0, 1e-3, kinks),
        }


def driven_contact(formulation: str, path: Floats) -> tuple[Floats, Floats]:
    """Way and shear force of one contact pressed by `LOAD` whose slip is driven along ``path``.

    A spring of 1e4 times the joint's stiffness drives it.
    """
    from scipy.sparse import csc_array, csr_array

    from nmm.contact.enforcement.base import make_enforcement
    from nmm.contact.problem.step_problem import Limits, StepProblem
    from nmm.solvers.linear import make_solver
    from nmm.verification.formulations import chosen

    method = chosen(formulation).contact
    enforcement = make_enforcement(method.enforcement, method.options)
    solver, drive = make_solver("auto", {}), 1e4 * STIFFNESS
    one, none = np.ones(1), np.zeros(1)
    gap, slip, normal, shear, state = none, none, none, none, np.zeros(1, dtype=np.int64)
    place, places, forces = 0.0, [], []
    for target in path:
        problem = StepProblem(
            matrix=csc_array(np.diag([drive, 0.0])),
            force=np.array([drive * (target - place), -LOAD]),
            normal_rows=csr_array(np.array([[0.0, 1.0]])),
            tangent_rows=csr_array(np.array([[1.0, 0.0]])),
            gap=gap,
            slip=slip,
            normal_stiffness=100 * STIFFNESS * one,
            shear_stiffness=STIFFNESS * one,
            limits=Limits(none, none, FRICTION * one),
            state=state,
            normal_force=normal,
            shear_force=shear,
            compliant=np.ones(1, dtype=bool),
        )
        answer = enforcement.solve(problem, solver)
        gap, slip, state = answer.gap, answer.slip, answer.state
        normal, shear = answer.normal_force, answer.shear_force
        place += float(answer.increment[0])
        places.append(place)
        forces.append(float(shear[0]))
    return np.array(places), np.array(forces)


class ConeProjection(Case):
    """Trial forces are brought back to the cone: pull cut off, shear cut at the bound."""

    name = "B10 cone"
    title = "Admissible forces of trial forces"
    source = "|T| <= c + mu max(-N, 0); N > 0 carries nothing unless bonded"

    def checks(self, formulation: str) -> Checks:
        from nmm.contact.problem.coulomb import project
        from nmm.contact.problem.step_problem import Limits

        # Trial N, T; tension, cohesion, friction; admissible N, T.
        table = np.array(
            [
                [-1e5, 2.0e4, 0, 0, 0.3, -1e5, 2.0e4],
                [-1e5, 4.0e4, 0, 0, 0.3, -1e5, 3.0e4],
                [-1e5, -4.0e4, 0, 0, 0.3, -1e5, -3.0e4],
                [-1e5, 4.0e4, 0, 5e3, 0.3, -1e5, 3.5e4],
                [1e3, 4.0e4, 0, 0, 0.3, 0, 0],
                [1e3, 4.0e4, 0, 5e3, 0.3, 0, 0],
                [1e3, 4.0e4, 2e3, 5e3, 0.3, 1e3, 5e3],
                [3e3, 4.0e4, 2e3, 5e3, 0.3, 2e3, 5e3],
                [0.0, 1.0, 0, 0, 0.3, 0, 0],
            ]
        )
        normal, shear, tension, cohesion, friction, want_n, want_t = table.T
        got_n, got_t = project(normal, shear, Limits(tension, cohesion, friction))
        off = max(np.abs(got_n - want_n).max(), np.abs(got_t - want_t).max())
        return {"largest error (N)": Check(float(off), 0.0, 1e-10, "rounding", scale=1e5)}


class Strength(Case):
    """Points of the Mohr-Coulomb envelope of concrete, and the strength in compression."""

    name = "C4"
    title = "Mohr-Coulomb strength with a tension cut-off"
    source = "tau = c - sigma tan phi; fc = 2 c cos phi / (1 - sin phi)"
    cohesion = 4.7e6
    tensile = 2.9e6
    friction = 37.0

    def overload(self, sigma: Floats, tau: Floats) -> Floats:
        """Stress over strength of joints under tractions (Pa)."""
        from nmm.interfaces.mohr_coulomb import MohrCoulomb

        angle = float(np.radians(self.friction))
        law = MohrCoulomb(angle, self.cohesion, self.tensile, bonded=True)
        return law.overload(sigma, tau)

    def shear_strength(self, sigma: float) -> float:
        """Shear stress at which a joint under ``sigma`` fails (Pa)."""
        unit = self.overload(np.array([sigma]), np.array([1e3]))
        return float(1e3 / unit[0])

    def checks(self, formulation: str) -> Checks:
        low = self.shear_strength(-self.tensile)
        turn = np.radians(np.linspace(0, 90, 90001))
        # Planes whose normal is at `turn` from a unit pressure.
        sigma, tau = -(np.cos(turn) ** 2), np.sin(turn) * np.cos(turn)
        worst, most = strongest(self, sigma, tau)
        plane = 90 - float(np.degrees(turn[worst]))
        printed = "printed digits"
        pull = self.overload(np.array([0.999, 1.001]) * self.tensile, np.zeros(2))
        return {
            "tau at 0 (Pa)": Check(self.shear_strength(0.0), 4.7e6, 1e-12, "rounding"),
            "tau at -2.9 MPa (Pa)": Check(low, 6.885307e6, 1e-7, printed),
            "strength in compression (Pa)": Check(most, 18.853483e6, 1e-7, printed),
            "N_phi": Check(most / self.cohesion / 2, np.sqrt(4.022791), 1e-6, printed),
            "plane from the pressure (degrees)": Check(plane, 26.5, 1e-4, "scan by 0.001 degrees"),
            "pull below the cut-off": Check(pull[0], 0.999, 1e-12, "rounding"),
            "pull above the cut-off": Check(pull[1], 1.001, 1e-12, "rounding"),
        }


def strongest(case: Strength, sigma: Floats, tau: Floats) -> tuple[int, float]:
    """Return the plane that fails first under a growing pressure, and the pressure (Pa)."""
    low, high = 0.0, 1e9
    for _ in range(60):  # halvings: 1e9 Pa to 1e-9 Pa
        pressure = (low + high) / 2
        load = case.overload(pressure * sigma, pressure * tau)
        low, high = (pressure, high) if load.max() < 1 else (low, pressure)
    return int(case.overload(high * sigma, high * tau).argmax()), high
