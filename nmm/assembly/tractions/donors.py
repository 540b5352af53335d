"""Tractions extrapolated from an uncut neighbour: stabilisation by extension.

On a sliver the strain is free to be anything, and a penalty that outweighs its traction grows as
the sliver thins. So the traction is that of a *donor*: the element itself where a fair part of a
cell is left of it, else a larger neighbour whose polynomials are continued to the edge (Haslinger
and Renard 2009). The bound of traction by energy then knows nothing of the cut.
"""

from dataclasses import dataclass

import numpy as np

from covers.approximation.ghost import neighbours
from integration.arrays import Floats, Ints
from nmm.assembly.model import Model

# Share of its largest neighbour below which an element is no donor, and how many neighbours on
# the way to one.
FAIR, STEPS = 0.3, 3


@dataclass(frozen=True)
class Flux:
    """Weighted traction of one side at the points.

    Attributes
    ----------
    body
        (m,) whose axes the rows are in.
    unknowns, values
        (m, L) and (m, 2, L).
    elements, points
        (m,) and (m, 2) where the stress is asked for.
    normal
        (m, 2) normals of the first side times the weight of this one.
    """

    body: Ints
    unknowns: Ints
    values: Floats
    elements: Ints
    points: Floats
    normal: Floats

    def of_stress(self, stress: Floats) -> Floats:
        """Weighted traction (m, 2) in body axes of stresses (m, 3) at the points."""
        return across(stress, self.normal)


def donors(model: Model, elements: Ints) -> Ints:
    """Return for each of ``elements`` (m,) the element (m,) whose field gives its traction."""
    manifold, area = model.manifold, model.element_area
    found = np.arange(len(area))
    near = np.unique(elements)
    extends = manifold.extends
    for _ in range(STEPS):  # rings of neighbours
        first, second = neighbours(manifold, np.unique(found[near]))
        best = np.arange(len(area))
        size = area.copy()
        for one, two in ((first, second), (second, first)):
            use = extends[two] & (manifold.element_region[one] == manifold.element_region[two])
            order = np.argsort(area[two[use]], kind="stable")
            top = np.zeros(len(area))
            pick = np.arange(len(area))
            top[one[use][order]] = area[two[use]][order]
            pick[one[use][order]] = two[use][order]
            larger = top > size
            best, size = np.where(larger, pick, best), np.where(larger, top, size)
        poor = area < FAIR * size
        after = np.where(poor, best, np.arange(len(area)))
        moved = after[found[near]]
        if np.array_equal(moved, found[near]):
            break
        found[near] = moved
    return np.asarray(found[elements])


def across(stress: Floats, normal: Floats) -> Floats:
    """Tractions (m, 2) of stresses (m, 3) on planes with normals (m, 2)."""
    x, y, shear = stress.T
    return np.stack(
        [x * normal[:, 0] + shear * normal[:, 1], shear * normal[:, 0] + y * normal[:, 1]], 1
    )


def traction_rows(
    model: Model, elements: Ints, points: Floats, normal: Floats
) -> tuple[Ints, Floats]:
    """Unknowns (m, L) and rows (m, 2, L) of ``sigma n`` in body axes, less that of pressures.

    Points need not lie in the elements: polynomials are continued to them.
    """
    unknowns, gradient = model.manifold.gradient_rows(elements, points)
    strain = np.stack(
        [gradient[:, 0, 0], gradient[:, 1, 1], gradient[:, 0, 1] + gradient[:, 1, 0]], axis=1
    )
    stress = np.einsum("mij,mjl->mil", model.drained[elements], strain)
    n = normal[:, :, None]
    across = n[:, 0] * stress[:, 0] + n[:, 1] * stress[:, 2]
    up = n[:, 0] * stress[:, 2] + n[:, 1] * stress[:, 1]
    return unknowns, np.stack([across, up], axis=1)
