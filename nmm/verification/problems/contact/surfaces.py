"""Pressure between surfaces in closed form: Hertz's cylinder and the flat punch."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.formulations import with_cover_keys

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class Pressure(SceneCase):
    """Base of contacts whose pressure is known: stiff against soft, smooth, in plane strain."""

    formulations: ClassVar[tuple[str, ...]] = (
        "finite elements",
        "manifold",
        "bilinear quads",
        "quads",
    )
    enforcement: str = "penalty"
    label = "{0.enforcement}"

    def pressures(self, run: "Run") -> tuple[Floats, Floats, Floats]:
        """Return places, forces and lengths of the contacts that press, from left to right."""
        frame = run.frames[-1]
        place, force = frame.contact_position[:, 0], -frame.contact_force[:, 0]
        acts = np.flatnonzero(force > 1e-9 * force.sum())
        order = acts[np.argsort(place[acts])]
        return place[order], force[order], frame.contact_length[order]


class Hertz(Pressure):
    """A cylinder is pressed on a rigid plane."""

    name = "B21"
    title = "Hertz: cylinder of R = 0.05 m on a rigid plane, 1e6 N/m"
    source = "b^2 = 4 P R (1 - nu^2) / (pi E), p = 2 P sqrt(1 - x^2 / b^2) / (pi b)"
    radius = 0.05
    modulus = 200e9
    load = 1e6
    half_width = 5.38203e-4
    peak = 1.182863e9
    contacts = 15
    worst = 0.04
    reason = "the springs give way by 2 to 3.5 %"

    @property
    def step(self) -> float:
        """Distance of corners where bodies meet (m)."""
        return self.half_width / self.contacts

    def scene(self) -> str:
        """Return the lower half of the cylinder, pressed evenly on its cut, on a stiff block."""
        r = self.radius
        return text.scene(
            'title = "Cylinder on a plane"\nplane = "strain"\n[contact]\n'
            f'[formulation.contact]\nenforcement = "{self.enforcement}"\nnormal_penalty = 1e-3\n',
            [
                text.material("steel", modulus=self.modulus, poisson=0.3, density=None),
                text.material("rigid", modulus=1e4 * self.modulus, poisson=0.0, density=None),
                text.interface("smooth", 0.0),
                text.block("plane", "rigid", text.rectangle((-r, -r), (r, 0))),
                text.block("cylinder", "steel", self._arc()),
                text.fixed_block("plane"),
                *text.pins({"cylinder": (0.0, r)}),
                *text.pins({"cylinder": (0.0, r / 2)}, "axis"),
                f'[[loads]]\nname = "press"\nkind = "edge"\nblock = "cylinder"\n'
                f"segment = [[{-r}, {r}], [{r}, {r}]]\ntraction = [0, {-self.load / (2 * r)!r}]\n",
            ],
        )

    def _arc(self) -> Floats:
        """Corners of the half cylinder, near each other where it is pressed."""
        x = [0.0]
        while x[-1] < 0.98 * self.radius:
            x.append(x[-1] + max(self.step, 0.15 * (x[-1] - 1.3 * self.half_width)))
        right = np.array([*x[:-1], self.radius])
        corners = np.column_stack([right, self.radius - np.sqrt(self.radius**2 - right**2)])
        return np.concatenate([corners[:0:-1] * [-1, 1], corners])

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return a net that grows away from the contact; the plane is one cell or two."""
        return _graded(
            super().formulation(scene, name),
            size=self.step,
            options={"focus": [[0.0, 0.0]], "radius": 1.3 * self.half_width, "growth": 0.4},
            nets=[{"block": "plane", "size": 0.3, "shift": (0.3, 0.3)}],
        )

    def measure(self, run: "Run") -> Checks:
        """Compare half width and peak of the pressure that is nearest to the one found.

        Hertz's ``p^2`` falls linearly with ``x^2``.
        """
        x, force, length = self.pressures(run)
        near = np.abs(x) < 0.8 * self.half_width
        slope, top = np.polyfit(x[near] ** 2, (force / length)[near] ** 2, 1)
        reason = "the benchmark's, for 15 contacts in b"
        width = float(np.sqrt(4 * force @ x**2 / force.sum()))
        hertz = self.peak * np.sqrt(1 - (x[near] / self.half_width) ** 2)
        worst = float(np.abs((force / length)[near] - hertz).max()) / self.peak
        single = f"{self.reason}, over the peak, at |x| < 0.8 b"
        return {
            "force (N)": Check(float(force.sum()), self.load, 1e-6, "residual of the solution"),
            "half width from the second moment (m)": Check(width, self.half_width, 0.03, reason),
            "half width (m)": Check(float(np.sqrt(-top / slope)), self.half_width, 0.03, reason),
            "peak pressure (Pa)": Check(float(np.sqrt(top)), self.peak, 0.03, reason),
            "largest error of a single pressure": limit(worst, self.worst, single),
        }


class ExactHertz(Hertz):
    """The same without penetration.

    Exact conditions at all points of both faces ask too much of fields: single forces would jump
    by five times the peak. So faces of meshes are held apart in the mean.
    """

    name = "B21 exact"
    formulations = ("finite elements", "bilinear quads")
    worst = 0.03
    reason = "the benchmark's"
    parameters: ClassVar = {"enforcement": ("lagrange", "augmented", "cone")}


class LinearHertz(ExactHertz):
    """The same with covers of degree 1."""

    name = "B21 degree 1"
    formulations = ("manifold", "quads")
    slow = True


class QuadraticHertz(LinearHertz):
    """The same with covers of degree 2."""

    name = "B21 degree 2"
    formulations = ("manifold degree 2", "quads degree 2")
    contacts = 8
    reason = "the benchmark's; half the contacts hold what is quadratic in a cell"
    parameters: ClassVar = {"enforcement": ("augmented",)}


class Punch(Pressure):
    """A rigid block with a flat face is pressed on a body that is large beside it."""

    name = "B22"
    title = "Flat rigid punch of half width a on a half plane"
    source = "p = P / (pi sqrt(a^2 - x^2)): a third of P in |x| < a / 2"
    extent = 20.0

    def scene(self) -> str:
        """Return the punch, 2 m wide, on a body 20 times as wide and deep as half of it."""
        w = self.extent
        return text.scene(
            'title = "Flat punch"\nplane = "strain"\n[contact]\n'
            f'[formulation.contact]\nenforcement = "{self.enforcement}"\nnormal_penalty = 1e-2\n',
            [
                text.material("soft", modulus=1e9, poisson=0.3, density=None),
                text.material("rigid", modulus=1e13, poisson=0.0, density=None),
                text.interface("smooth", 0.0),
                text.block("body", "soft", text.rectangle((-w, -w), (w, 0))),
                text.block("punch", "rigid", text.rectangle((-1, 0), (1, 1))),
                text.fixed_edge("foot", [[-w, -w], [w, -w]]),
                *text.pins({"punch": (0.0, 1.0)}),
                *text.pins({"punch": (0.0, 0.5)}, "axis"),
                '[[loads]]\nname = "press"\nkind = "edge"\nblock = "punch"\n'
                "segment = [[-1, 1], [1, 1]]\ntraction = [0, -1e3]\n",
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return a net that grows away from the corners; the punch is one cell or two."""
        return _graded(
            super().formulation(scene, name),
            size=1 / 40,
            options={"focus": [[-1.0, 0.0], [1.0, 0.0]], "radius": 0.1, "growth": 0.12},
            nets=[{"block": "punch", "size": 3.0, "shift": (0.3, 0.3)}],
        )

    def measure(self, run: "Run") -> Checks:
        x, force, length = self.pressures(run)
        ends = x[0] - length[0] / 2 + np.concatenate([[0.0], np.cumsum(length)])
        sums = np.concatenate([[0.0], np.cumsum(force)])
        low, high = np.interp([-0.5, 0.5], ends, sums)
        share = float((high - low) / sums[-1])
        reason = "the benchmark's; 0.1 % of it from the depth of 20 a"
        return {"force in the middle half over all": Check(share, 1 / 3, 0.02, reason)}


class ExactPunch(Punch):
    """The same without penetration."""

    name = "B22 exact"
    formulations: ClassVar[tuple[str, ...]] = ("finite elements", "manifold", "bilinear quads")
    parameters: ClassVar = {"enforcement": ("lagrange", "augmented", "cone")}


class FinePunch(ExactPunch):
    """The same with covers of degree 1 on quads."""

    name = "B22 fine"
    formulations = ("quads",)
    parameters: ClassVar = {"enforcement": ("augmented",)}
    slow = True


def _graded(formulation: "Formulation", **changes: Any) -> "Formulation":
    """Return a formulation with nets of triangles or quads that grow away from foci."""
    quads = formulation.cover.type == "quads"
    kind = "nmm.verification.graded_quads:GradedQuads" if quads else "graded"
    return with_cover_keys(formulation, type=kind, **changes)
