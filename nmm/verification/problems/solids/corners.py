"""A re-entrant corner: singular stresses, with and without the functions that hold them."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.places import on_edges
from nmm.formulation import EnrichmentTable, Formulation
from nmm.materials.elastic import Elastic
from nmm.verification.base import Check, Checks, limit, order
from nmm.verification.continuum import (
    FITTED,
    ContinuumCase,
    Problem,
    load,
    middles,
    on_mesh,
    pin,
    polygon,
    traction_of,
)
from nmm.verification.series import Series

if TYPE_CHECKING:
    from covers.local_functions.singular_functions import SingularFunctions

LAW = Elastic(1.0, 0.3)
POWER, RATIO = 0.5444837367824639, 0.5430755788367365
ENERGY = 4.1545442274
A, B = np.sqrt(0.5), np.sqrt(2.0)
RING = np.array([[0, 0], [-A, -A], [0, -B], [B, 0], [0, B], [-A, A]])


def williams() -> "SingularFunctions":
    """Return the functions of a corner of 270 degrees."""
    from covers.local_functions.corner_functions import corner_functions

    return corner_functions(1.5 * np.pi, LAW.kolosov("strain"), 1.0)


def tractions(points: Floats, normals: Floats) -> Floats:
    """Tractions (m, 2) of the first mode, of unit strength."""
    elasticity = LAW.stiffness("strain")
    r, angle = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
    g = williams().evaluate(r, angle)[1][:, 0] / (2 * elasticity[2, 2])
    strain = np.stack([g[:, 0, 0], g[:, 1, 1], g[:, 0, 1] + g[:, 1, 0]], axis=1)
    return traction_of(strain @ elasticity, normals)


class LShapedBody(ContinuumCase):
    """An L-shaped body with arms of 1, loaded by the tractions of the first mode of its corner."""

    source = "Williams (1952): exponent 0.5444837, energy 4.1545442 from the tractions' work"
    radius: float | None = None

    def problem(self, formulation: Formulation) -> Problem:
        """Return the body with exact tractions and three pins."""
        from nmm.model.from_polygons import solid

        cover = formulation.cover
        if self.radius is not None:
            extra = EnrichmentTable(radius=self.radius, corners=((0.0, 0.0),))
            cover = cover.model_copy(update={"enrichment": extra})
        model = solid(polygon(RING), cover, [LAW], "strain")
        x, y = middles(model).T
        loaded = on_edges(model.manifold, np.abs(x + np.abs(y)) > 1e-9, 16)
        pins = [pin(model, [B, 0.0]), pin(model, [0.0, B], (True, False))]
        return Problem(model, pins, [load(model, loaded, tractions)])


class Exponents(LShapedBody):
    """Exponents of stress singularities at a corner and at a crack."""

    name = "A13 exponents"
    title = "Exponents of a re-entrant corner"
    source = (
        "Williams (1952): sin(3 pi l / 2) = -+ l sin(3 pi / 2), solved in 16 digits; 1/2 at a crack"
    )
    size = 0.3

    def checks(self, formulation: str) -> Checks:
        from covers.local_functions.corner_functions import corner_functions

        corner = williams()
        crack = corner_functions(2 * np.pi, LAW.kolosov("strain"), 1.0)
        digits, crude = "digits of the reference", "a double root's"
        return {
            "exponent of mode 1": Check(corner.exponent[0], POWER, 1e-12, digits),
            "ratio of mode 1": Check(corner.ratio[0], RATIO, 1e-12, digits),
            "exponent of mode 2": Check(corner.exponent[1], 0.908529189846, 1e-11, digits),
            "ratio of mode 2": Check(corner.ratio[1], -0.218923236249, 1e-10, digits),
            "exponent at a crack, mode 1": Check(crack.exponent[0], 0.5, 1e-9, crude),
            "exponent at a crack, mode 2": Check(crack.exponent[1], 0.5, 1e-9, crude),
        }


class PlainCorner(LShapedBody):
    """Without the functions of the corner errors fall by its exponent, whatever the degree.

    How large they are depends on how the corner lies in its cell, so sizes are chosen that leave it
    at one place: the offsets of the corner from the mesh's first are whole numbers of cells.
    """

    name = "A13 plain"
    title = "Re-entrant corner without functions of its own"
    formulations = ("bilinear quads", "quads", "quads degree 2")
    size = A / 5

    def checks(self, formulation: str) -> Checks:
        """Refine the covers three times."""
        numbers = (8, 12, 20, 30) if formulation == "bilinear quads" else (3, 5, 8, 12)
        sizes = [A / number for number in numbers]
        errors = [self.error(formulation, size) for size in sizes]
        reason = "a few covers a side are not yet in the range of powers"
        return {"order in energy": order(Series.of(sizes, errors, POWER), 0.03, reason)}

    def error(self, formulation: str, size: float) -> float:
        """Relative error in energy on an upright mesh, a little moved."""
        chosen = on_mesh(formulation, size, FITTED)
        cover = chosen.cover.model_copy(update={"shift": (0.3, 0.1)})
        found = self.problem(chosen.model_copy(update={"cover": cover})).solve()
        return float(np.sqrt(1 - found.energy / ENERGY))


@dataclass(frozen=True)
class EnrichedCorner(LShapedBody):
    """With the functions of the corner the energy is right with a few hundred unknowns."""

    name = "A13 enriched"
    title = "Re-entrant corner with its singular functions"
    formulations = ("manifold",)
    size = 0.2
    radius: float | None = 0.35

    def checks(self, formulation: str) -> Checks:
        found = self.solved(formulation)
        plain = 1 - replace(self, radius=None).solved(formulation).energy / ENERGY
        lack = 1 - found.energy / ENERGY
        return {
            "energy (J)": Check(found.energy, ENERGY, 5e-4, "measured 3.6e-4"),
            "lack of energy without over with": Check(
                plain / lack, 50.0, 0.0, "measured 100", bound="at_least"
            ),
            "unknowns": limit(float(found.model.manifold.n_unknowns), 1000, "a cheap remedy"),
        }
