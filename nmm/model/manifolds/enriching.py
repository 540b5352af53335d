"""Singular functions of a formulation: at tips of cracks, and at corners that it names."""

from typing import TYPE_CHECKING

import numpy as np

from covers.approximation.singular.enrichment import Enrichment
from integration.arrays import Floats, Ints
from nmm.errors import FormulationError
from nmm.geometry.tessellation.cover_types import functions_of
from nmm.scene.methods.cover_tables import EnrichmentTable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from covers.cutting.cut_cells import CutCells
    from nmm.formulation import CoverTable
    from nmm.fracture.corners import Corner


# Cells about a tip that may grow, up to which covers carry its functions. Where eight cells are
# across a beam intensities are off by 0.5 % with those alone that touch it, 0.12 % with one and a
# half cells, 0.04 % with three and 0.01 % with four, the radius of the integrals, which takes
# a fifth more time.
GROWING = 3.0
# Of the size of all cracks: a vertex nearer to a corner is at it.
AT_CORNER = 1e-6


def with_growing_tips(cover: "CoverTable") -> "CoverTable":
    """Return the cover of a scene whose cracks grow, with tip functions on more of the covers.

    What ``[cover.enrichment]`` says stays.
    """
    enriched = functions_of(cover).enriched
    if cover.enrichment is not None or cover.size is None or not enriched:
        return cover
    table = EnrichmentTable(radius=GROWING * cover.size)
    return cover.model_copy(update={"enrichment": table})


def without_opened_corners(cover: "CoverTable", lines: "Sequence[Floats]") -> "CoverTable":
    """Return the cover without the functions of corners from which a crack of ``lines`` goes.

    Stress there is bounded but for the tip's, which has functions of its own.
    """
    table = cover.enrichment
    if table is None or not table.corners or not lines:
        return cover
    vertices = np.concatenate(lines)
    size = float(np.hypot(*np.ptp(vertices, axis=0)))
    away = [np.hypot(*(vertices - place).T).min() for place in table.corners]
    pairs = zip(table.corners, away, strict=True)
    whole = tuple(place for place, far in pairs if far > AT_CORNER * size)
    return cover.model_copy(update={"enrichment": table.model_copy(update={"corners": whole})})


def enrichments(
    cut: "CutCells",
    cover: "CoverTable",
    kappa: Floats | None,
    bonded: "Sequence[int]" = (),
    lines: "Sequence[Floats]" = (),
) -> list[Enrichment]:
    """Return crack-tip functions and the corner functions that ``[cover.enrichment]`` names.

    The covers about a tip carry its functions, with the table those within its radius too; those
    that touch a sharp kink of one of the ``lines`` functions of its corner. Cracks with the numbers
    ``bonded`` have none.

    Raises
    ------
    FormulationError
        Points with different numbers of singular functions.
    """
    from covers.local_functions.corner_functions import corner_functions
    from nmm.fracture.corners import corner_at

    table = cover.enrichment
    size, tips = cover.size, _tips(cut, cover, bonded)
    assert size is not None
    constant = np.full(int(cut.element_region.max()) + 1, 2.0) if kappa is None else kappa
    radius = 0.0 if table is None else table.radius
    found = _about_tips(cut, tips, constant, size, radius)

    def about(corner: "Corner", reach: float, both: bool = False) -> Enrichment:
        modulus = float(constant[cut.element_region[corner.element]])
        functions = corner_functions(corner.angle, modulus, size, both)
        body = int(cut.element_body[corner.element])
        return Enrichment(functions, corner.point, corner.direction, reach, body)

    # Tips have two modes, and so must what stands beside them.
    found += [about(corner, 0.0, both=True) for corner in _kinks(cut, lines, tips)]
    corners = () if table is None else table.corners
    found += [about(corner_at(cut.boundary, np.array(place)), radius) for place in corners]
    if len({item.functions.number for item in found}) > 1:
        raise FormulationError(
            "[cover.enrichment]: points with different numbers of singular modes: expected one "
            "number: enrich crack tips, or corners of one angle"
        )
    return found


def _about_tips(
    cut: "CutCells", tips: Ints, constant: Floats, size: float, radius: float
) -> list[Enrichment]:
    """Return the functions of crack tips; ``constant`` (N,) is Kolosov's of the regions."""
    from covers.local_functions.crack_tip_functions import crack_tip_functions

    found = []
    for number in tips:  # a handful of tips
        element = cut.tips.element[number]
        functions = crack_tip_functions(float(constant[cut.element_region[element]]), size)
        point, ahead = cut.tips.point[number], cut.tips.direction[number]
        found.append(Enrichment(functions, point, ahead, radius, int(cut.element_body[element])))
    return found


def _kinks(cut: "CutCells", lines: "Sequence[Floats]", tips: Ints) -> "list[Corner]":
    """Corners at the sharp kinks of cracks that have one of the ``tips``."""
    from nmm.fracture.corners import kinks

    cracks = np.unique(cut.tips.crack[tips])
    return [corner for crack in cracks for corner in kinks(cut.boundary, lines[crack])]


def _tips(cut: "CutCells", cover: "CoverTable", bonded: "Sequence[int]") -> Ints:
    """Tips whose functions are wanted."""
    every = np.flatnonzero(~np.isin(cut.tips.crack, bonded))
    if cover.enrichment is not None:
        return every if cover.enrichment.tips else every[:0]
    return every if functions_of(cover).enriched else every[:0]
