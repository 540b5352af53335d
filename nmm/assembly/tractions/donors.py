"""Tractions extrapolated from an uncut neighbour: stabilisation by extension.

On a sliver the strain is free to be anything, and a penalty that outweighs its traction grows as
the sliver thins. So the traction is that of a *donor*: the element itself where a fair part of a
cell is left of it, else a larger neighbour whose polynomials are continued to the edge (Haslinger
and Renard 2009). The bound of traction by energy then knows nothing of the cut.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.approximation.ghost import neighbours
from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.state import Frames
from nmm.assembly.stress_points import StressAt

# Share of its largest neighbour below which an element is no donor, and how many neighbours on
# the way to one.
FAIR, STEPS = 0.3, 3
# Digits of the logarithm of areas that tell elements apart by size.
ALIKE = 6


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


def in_global_axes(
    fluxes: Sequence[Flux], frames: Frames, at: Ints | slice = slice(None)
) -> tuple[Ints, Floats]:
    """Unknowns (k, L) and rows (k, 2, L) of the average traction at some of the points."""
    unknowns = np.concatenate([one.unknowns[at] for one in fluxes], axis=1)
    turned = [frames.rotation[one.body[at]] @ one.values[at] for one in fluxes]
    return unknowns, np.concatenate(turned, axis=2)


def added_traction(
    fluxes: Sequence[Flux],
    frames: Frames,
    stresses: Sequence[StressAt],
    time: float,
    at: Ints | slice = slice(None),
) -> Floats:
    """Average traction (k, 2) of stresses that effects add to those of the strain (Pa)."""
    total = np.zeros_like(fluxes[0].normal[at])
    for one in fluxes:  # at most two sides
        for stress in stresses:  # a handful of effects
            pull = one.of_stress(stress(one.elements, one.points, time))
            total += frames.to_global(one.body[at], pull[at])
    return total


def donors(model: Model, elements: Ints) -> Ints:
    """Return for each of ``elements`` (m,) the element (m,) whose field gives its traction."""
    area = model.element_area
    served, place = np.unique(elements, return_inverse=True)
    found = served
    for _ in range(STEPS):  # rings of neighbours
        best = _largest_about(model, np.unique(found))
        poor = area < FAIR * area[best]
        moved = np.where(poor, best, np.arange(len(area)))[found]
        if np.array_equal(moved, found):
            break
        found = moved
    return np.asarray(found[place.ravel()])


def _largest_about(model: Model, elements: Ints) -> Ints:
    """Largest (E,) of each element and its neighbours in its region that may be continued.

    Neighbours are those across edges of ``elements``; others are their own largest. Of whole cells,
    which are as large as each other, it is the one whose middle is nearest: not one that rounding
    chooses, and none that is continued far.
    """
    manifold, area = model.manifold, model.element_area
    first, second = neighbours(manifold, elements)
    one, two = np.concatenate([first, second]), np.concatenate([second, first])
    use = manifold.extends[two] & (manifold.element_region[one] == manifold.element_region[two])
    one, two, middle = one[use], two[use], manifold.elements.centroids
    away = np.hypot(*(middle[one] - middle[two]).T)
    rising = np.lexsort((-away, np.round(np.log(area[two] / area.max()), ALIKE)))
    best = np.arange(len(area))
    # Of several neighbours the last, the largest and nearest, stays.
    best[one[rising]] = two[rising]
    return np.where(area[best] > area, best, np.arange(len(area)))


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
    x, y = np.moveaxis(normal, 1, 0)[:, :, None]
    along_x = x * stress[:, 0] + y * stress[:, 2]
    along_y = x * stress[:, 2] + y * stress[:, 1]
    return unknowns, np.stack([along_x, along_y], axis=1)
