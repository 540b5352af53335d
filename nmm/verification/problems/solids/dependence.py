"""Dependent functions: how many there are, and that the field does not feel them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from covers.approximation.mesh_manifold import mesh_manifold
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Monomials
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.formulation import Formulation, Solver
from nmm.materials.elastic import Elastic
from nmm.verification.base import Case, Check, Checks, limit
from nmm.verification.continuum import ContinuumCase, Problem, edge_support, everywhere, on_mesh
from nmm.verification.problems.solids.patches.body import HOLED, LAW

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
CRACKS: dict[str, list[list[list[float]]]] = {
    "whole": [],
    "cracked": [[[0.5, -0.5], [0.52, 0.5]]],
    "cut in two": [[[0.5, -0.5], [0.45, 1.5]]],
}


@dataclass(frozen=True)
class Nullity(Case):
    """Polynomials of degree p times hats depend on each other in 2 p (p + 2) ways a body.

    The stiffness of a free body has as many null vectors besides its three motions; a crack that
    cuts it in two doubles them, one that ends inside does not.
    """

    name = "D2 nullity"
    title = "Null vectors of the stiffness of free bodies"
    source = "2 p (p + 2) + 3 for each body, counted by rank over rationals"
    formulations = ("triangles",)
    degree: int = 1
    body: str = "whole"
    label = "degree {0.degree}, {0.body}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return degrees 1 to 3 of a whole square, and squares with cracks."""
        whole = [cls(degree) for degree in (1, 2, 3)]
        return [*whole, cls(1, "cut in two"), cls(2, "cut in two"), cls(2, "cracked")]

    def checks(self, formulation: str) -> Checks:
        """Count eigenvalues of the scaled stiffness."""
        cover = Triangles.regular([[0, 0], [1, 1]], 0.3, angle=0.4, shift=(0.21, 0.37))
        pieces = cut(cover, SQUARE, CRACKS[self.body])
        manifold = mesh_manifold(cover, pieces, Monomials(self.degree))
        n, bodies = len(manifold.elements), 2 if self.body == "cut in two" else 1
        d = np.broadcast_to(Elastic(1.0, 0.3).stiffness("stress"), (n, 3, 3)).copy()
        stiffness = Model(manifold, d, np.ones(n), np.ones(n), 1.0, pieces).stiffness.toarray()
        scale = 1 / np.sqrt(stiffness.diagonal())
        values = np.sort(np.abs(np.linalg.eigvalsh(stiffness * scale * scale[:, None])))
        dependent = bodies * 2 * self.degree * (self.degree + 2)
        null = dependent + 3 * bodies
        counted = float((values < 1e-10 * values[-1]).sum())
        return {
            "null vectors": Check(counted, float(null), 0.0, "a count"),
            "dependent functions that are said": Check(
                float(manifold.dependent), float(dependent), 0.0, "a count"
            ),
            "largest that is zero over all": limit(
                values[null - 1] / values[-1], 1e-13, "rounding"
            ),
            "least that is not over all": Check(
                values[null] / values[-1], 1e-7, 0.0, "a gap of six figures", bound="at_least"
            ),
        }


class OneField(ContinuumCase):
    """The field of displacements is one, however small the shift that makes the system regular."""

    name = "D2 field"
    title = "Field of dependent functions under different shifts"
    source = "The field is unique; its unknowns are not"
    formulations = ("manifold", "manifold degree 2", "manifold degree 3")
    size = 0.4

    def problem(self, formulation: Formulation) -> Problem:
        """Return a body under displacements (y^4, x^3) all around."""
        from nmm.model.from_polygons import solid

        def field(p: Floats) -> Floats:
            return np.stack([p[:, 1] ** 4, p[:, 0] ** 3], axis=1)

        model = solid(HOLED, formulation.cover, [LAW], "stress")
        return Problem(model, [edge_support(model, formulation, everywhere(model, 10), field)])

    def checks(self, formulation: str) -> Checks:
        problem = self.problem(on_mesh(formulation, self.size))
        points = problem.model.manifold.vertex_rows
        usual = problem.solve()
        one = points.apply(usual.state.deformation)
        checks = {"residual": limit(usual.residual, 1e-10, "the benchmark's limit")}
        for shift in (1e-14, 1e-12, 1e-10, 1e-8):
            solver = Solver(options={"shift": shift, "refinements": 8})
            other = problem.solve(solver)
            two = points.apply(other.state.deformation)
            change = float(np.abs(one - two).max() / np.abs(one).max())
            checks[f"change of the field, shift {shift:.0e}"] = limit(
                change, 1e-8, "the benchmark's limit"
            )
            checks[f"residual, shift {shift:.0e}"] = limit(
                other.residual, 1e-10, "the benchmark's limit"
            )
        return checks
