"""Patch tests of fields beyond one strain: a quadratic one, and a finite turn."""

import numpy as np

from integration.arrays import Floats
from nmm.assembly.material_points import vertex_points
from nmm.assembly.moving.motion import move
from nmm.assembly.state import initial_state
from nmm.formulation import Formulation
from nmm.verification.base import MESHES, Check, Checks, limit
from nmm.verification.continuum import (
    Exact,
    Problem,
    edge_support,
    errors_of,
    everywhere,
    fine,
    on_mesh,
)
from nmm.verification.problems.solids.patches.body import LAW, ROUNDING, HoledPatch


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
