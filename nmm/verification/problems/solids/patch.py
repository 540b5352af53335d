"""Patch tests: fields that covers hold must come out exactly, on any cut mesh (Taylor 1986)."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.assembly.errors import stresses
from nmm.assembly.material_points import vertex_points
from nmm.assembly.moving.motion import move
from nmm.assembly.state import initial_state
from nmm.formulation import Formulation
from nmm.materials.elastic import Elastic
from nmm.verification import text
from nmm.verification.base import MESHES, Check, Checks, SceneCase, limit
from nmm.verification.continuum import (
    ContinuumCase,
    Exact,
    Problem,
    edge_support,
    errors_of,
    everywhere,
    fine,
    load,
    on_mesh,
    pin,
)
from nmm.verification.reading import last_way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

HOLED = Polygons.from_rings(
    [
        [
            [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.6], [0.0, 1.0]],
            [[0.9, 0.2], [1.2, 0.2], [1.2, 0.4], [0.9, 0.4]],
        ]
    ]
)
LAW = Elastic(1000.0, 0.3)
STRAIN = np.array([1e-3, -2e-4, 5e-4])
STRESS = np.array([1.032967033, 0.1098901099, 0.1923076923])
ENERGY = 5.535714286e-4
PRINTED = "the reference is printed with ten digits"
ROUNDING = "rounding: the solution is in the space of the functions"


def uniform() -> Exact:
    """Return the field of one strain."""
    half = STRAIN[2] / 2
    gradient = np.array([[STRAIN[0], half], [half, STRAIN[1]]])
    return Exact(lambda x: np.asarray(x @ gradient), lambda x: np.tile(STRESS, (len(x), 1)))


class HoledPatch(ContinuumCase):
    """Body of patch tests: not convex, with a hole, in a mesh that follows none of its edges."""

    size = 0.31

    def body(self, formulation: Formulation) -> Problem:
        """Return the body, free."""
        from nmm.model.from_polygons import solid

        return Problem(solid(HOLED, formulation.cover, [LAW], "stress"))

    def compared(self, formulation: str, tolerance: float, reason: str) -> Checks:
        """Compare stresses in every element, energy and balance."""
        found = self.solved(formulation)
        manifold = found.model.manifold
        rule = polygon_rule(manifold.elements, 2)
        miss = np.abs(stresses(found.model, found.state.deformation, rule) - STRESS)
        mean = float(np.sqrt(rule.weights @ (miss**2).sum(axis=1) / rule.weights.sum()))
        area = float(found.model.element_area.sum())
        return {
            "largest error of stress (Pa)": limit(float(miss.max()), tolerance, reason),
            "mean error of stress (Pa)": limit(mean, tolerance, reason),
            "energy per area (J/m2)": Check(found.energy / area, ENERGY, tolerance, reason),
            "residual": limit(found.residual, 1e-10, "relative to the forces of all unknowns"),
        }


class HeldPatch(HoledPatch):
    """Exact displacements all around a body give one stress in every element, cut ones too."""

    name = "A1 displacements"
    title = "Linear patch test, displacements given"
    source = "Hooke's law in plane stress for strains (1, -0.2, 0.5) 1e-3"
    formulations: ClassVar[tuple[str, ...]] = (
        *MESHES,
        *("manifold degree 2", "quads", "splines", "multipliers", "multipliers degree 2"),
    )

    def problem(self, formulation: Formulation) -> Problem:
        """Hold the whole boundary."""
        model = self.body(formulation).model
        place = everywhere(model, 10)
        return Problem(model, [edge_support(model, formulation, place, uniform().displacement)])

    def checks(self, formulation: str) -> Checks:
        return self.compared(formulation, 2e-9, PRINTED)


class MeshlessPatch(HeldPatch):
    """Moving least squares pass the patch test up to their quadrature.

    Their weights are rational and have jumps in higher derivatives within cells, which no rule of
    points integrates exactly.
    """

    name = "A1 meshless"
    title = "Linear patch test of moving least squares"
    formulations = ("meshless",)
    size = 0.2

    def checks(self, formulation: str) -> Checks:
        reason = "measured 2.3e-4 of a stress of about 1: quadrature"
        found = self.compared(formulation, 1e-3, reason)
        del found["largest error of stress (Pa)"]
        return found


class PulledPatch(HoledPatch):
    """Exact tractions all around and three pins that carry nothing give the stress too."""

    name = "A1 tractions"
    title = "Linear patch test, tractions given"
    source = "Hooke's law in plane stress for strains (1, -0.2, 0.5) 1e-3"
    formulations = (*MESHES, "manifold degree 2", "quads")

    def problem(self, formulation: Formulation) -> Problem:
        """Load the whole boundary."""
        model = self.body(formulation).model
        pins = [pin(model, [0.0, 0.0]), pin(model, [2.0, 0.0], (False, True))]
        return Problem(model, pins, [load(model, everywhere(model, 10), uniform().traction)])

    def checks(self, formulation: str) -> Checks:
        return self.compared(formulation, 2e-9, PRINTED)


class QuadraticPatch(HoledPatch):
    """A quadratic field under its body force: exact from linear covers on."""

    name = "A1 quadratic"
    title = "Quadratic patch test"
    source = "u = (x2 + 2 x y - y2, -x2 + x y + 3 y2), b = -div sigma"
    formulations = ("manifold", "manifold degree 2", "quads", "multipliers", "multipliers degree 2")

    @staticmethod
    def exact() -> Exact:
        """Return the field, of strains (2x + 2y, x + 6y, -y)."""
        elasticity = LAW.stiffness("stress")

        def u(p: Floats) -> Floats:
            x, y = p.T
            return np.stack([x**2 + 2 * x * y - y**2, -(x**2) + x * y + 3 * y**2], axis=1)

        def stress(p: Floats) -> Floats:
            x, y = p.T
            return np.stack([2 * x + 2 * y, x + 6 * y, -y], axis=1) @ elasticity

        return Exact(u, stress)

    def problem(self, formulation: Formulation) -> Problem:
        """Hold the whole boundary under the body force."""
        from nmm.stepping.drive.linear_statics import body_force

        model, d = self.body(formulation).model, LAW.stiffness("stress")
        # sxx_x + sxy_y and sxy_x + syy_y.
        divergence = [d[0, 0] * 2 + d[0, 1] - d[2, 2], d[1, 0] * 2 + d[1, 1] * 6]
        force = body_force(model, lambda p: -np.tile(divergence, (len(p), 1)), fine(formulation))
        place = everywhere(model, 10)
        held = edge_support(model, formulation, place, self.exact().displacement)
        return Problem(model, [held], forces=[force])

    def checks(self, formulation: str) -> Checks:
        found = self.solved(formulation)
        errors = errors_of(found, self.exact(), 6)
        return {
            "error in energy": limit(errors.energy, 1e-8, ROUNDING),
            "error in displacement": limit(errors.displacement, 1e-8, ROUNDING),
            "residual": limit(found.residual, 1e-10, "relative to the forces of all unknowns"),
        }


class RigidTurn(HoledPatch):
    """A finite turn by 30 degrees strains nothing and keeps every element's area."""

    name = "A1 turn"
    title = "Finite turn of a meshed body"
    source = "A rotation has no strain"
    formulations = (*MESHES, "manifold degree 2", "quads", "splines", "meshless")

    def problem(self, formulation: Formulation) -> Problem:
        """Return the free body."""
        return self.body(formulation)

    def checks(self, formulation: str) -> Checks:
        """Turn the body by its rigid mode and look at angle, strain and areas."""
        model = self.problem(on_mesh(formulation, self.size)).model
        turn = np.zeros(3 * model.manifold.n_bodies)
        turn[2] = np.pi / 6
        state = move(model, initial_state(model.manifold), model.manifold.rigid_modes @ turn)
        placed = vertex_points(model.manifold).place(state.frames, state.deformation)
        areas = model.manifold.elements.with_points(placed).areas / model.element_area
        strain = np.abs(model.mean_strain(state.deformation)).max()
        return {
            "angle (rad)": Check(float(state.frames.angle[0]), np.pi / 6, 1e-12, ROUNDING),
            "strain": limit(float(strain), 1e-12, ROUNDING),
            "change of areas": limit(
                float(np.abs(areas - 1).max()), 1e-9, "slivers: rounding over their thickness"
            ),
        }


@dataclass(frozen=True)
class Jump(SceneCase):
    """A body split in two and tied by springs opens by traction over stiffness.

    The parts carry the traction undisturbed, whatever covers they have and whether their meshes
    match.
    """

    name = "A1 jump"
    title = "Split patch tied by springs"
    source = "Jump t / k, elongation t (L / E + 1 / k)"
    formulations = ("dda", "degree 2", *MESHES)
    stiffness: float = 4.0
    # A soft and a stiff joint, and glue.
    parameters: ClassVar = {"stiffness": (4.0, 4e3, float("inf"))}

    @property
    def variant(self) -> str:
        return f"k = {self.stiffness:g} Pa/m" if self.stiffness < float("inf") else "glued"

    def scene(self) -> str:
        """Return two unit squares of E = 1 under a pull of 1 Pa."""
        bond: dict[str, float | bool] = {"bonded": True}
        if self.stiffness < float("inf"):
            bond |= {"normal_stiffness": self.stiffness, "shear_stiffness": self.stiffness / 2}
        return text.scene(
            'title = "Split patch"\nplane = "stress"\n',
            [
                text.material("soft", modulus=1.0, poisson=0.0, density=None),
                text.interface("joint", 0.0, more=bond),
                text.box("left", (0, 0), (1, 1), "soft"),
                text.box("right", (1, 0), (1, 1), "soft"),
                text.fixed_edge("wall", [[0, 0], [0, 1]]),
                text.pulled_edge("pull", [[2, 0], [2, 1]], [1, 0]),
                text.monitor("root", (0, 0.5), "left"),
                text.monitor("near", (1, 0.5), "left"),
                text.monitor("far", (1, 0.5), "right"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        near, far = last_way(run, "near")[0], last_way(run, "far")[0]
        reason = "residual 1e-8 of the solution, relative to the forces of all unknowns"
        stress = run.stress[:, 0]
        allowed = 1e-7 if self.stiffness < float("inf") else 1e-9
        return {
            "jump (m)": Check(far - near, 1 / self.stiffness, allowed, reason),
            "elongation on the left (m)": Check(near - last_way(run, "root")[0], 1.0, 1e-7, reason),
            "smallest stress (Pa)": Check(float(stress.min()), 1.0, 1e-7, reason),
            "largest stress (Pa)": Check(float(stress.max()), 1.0, 1e-7, reason),
        }
