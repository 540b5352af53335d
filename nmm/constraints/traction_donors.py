"""Tractions on cut edges from elements that are large enough to say what they are.

On a sliver the strain is free to be anything, and a penalty that outweighs its traction grows as
the sliver thins. So the traction is that of a *donor*: the element itself where a fair part of a
cell is left of it, else a larger neighbour whose polynomials are continued to the edge (Haslinger
and Renard 2009). The bound of traction by energy then knows nothing of the cut.
"""

import numpy as np

from covers.approximation.ghost import neighbours
from integration.arrays import Bools, Floats, Ints
from nmm.assembly import element_matrices
from nmm.assembly.model import Model

# Share of its largest neighbour below which an element is no donor, and how many neighbours on
# the way to one.
FAIR, STEPS = 0.3, 3
# Eigenvalues of a scaled element stiffness below this share of the largest are free motions.
FREE = 1e-11


def donors(model: Model, elements: Ints) -> Ints:
    """Return for each of ``elements`` (m,) the element (m,) whose field gives its traction."""
    manifold, area = model.manifold, model.element_area
    found = np.arange(len(area))
    near = np.unique(elements)
    extends = _extends(model)
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


def traction_bound(model: Model, donor: Ints, traction: Floats, weight: Floats) -> Floats:
    """Largest ``int |sigma n|^2 / a(u, u)`` (m,) of the donor of each point (Pa / m).

    The integral goes over all points that a donor serves, so that the bounds add up; zero where
    the donor has no stress at all (rigid functions).

    Parameters
    ----------
    donor
        (m,) element.
    traction
        (m, 2, L) rows.
    weight
        (m,) area of boundary (m2).
    """
    served, number = np.unique(donor, return_inverse=True)
    number = number.ravel()
    length = traction.shape[2]
    flux = np.zeros((len(served), length, length))
    each = np.einsum("mia,m,mib->mab", traction, weight, traction)
    np.add.at(flux, number, each)
    energy = element_stiffness(model, served, length)
    return np.asarray(_largest_ratio(flux, energy)[number])


def element_stiffness(model: Model, elements: Ints, length: int) -> Floats:
    """Stiffness (m, length, length) of elements, padded with zeros."""
    total = np.zeros((len(elements), length, length))
    for group in model.manifold.groups:  # a handful of groups
        place = np.full(len(model.density), -1)
        place[group.elements] = np.arange(len(group.elements))
        chosen = np.flatnonzero(place[elements] >= 0)
        if not len(chosen):
            continue
        shape = group.shape[place[elements[chosen]]]
        material = model.thickness * model.drained[elements[chosen]]
        own = element_matrices.stiffness(group, shape, material)
        total[chosen, : own.shape[1], : own.shape[2]] = own
    return total


def _largest_ratio(flux: Floats, energy: Floats) -> Floats:
    """Largest eigenvalue (m,) of ``flux x = r energy x`` over all but free motions."""
    diagonal = np.einsum("mii->mi", energy)
    scale = np.where(diagonal > 0, 1 / np.sqrt(np.where(diagonal > 0, diagonal, 1.0)), 0.0)
    both = scale[:, :, None] * scale[:, None, :]
    value, vector = np.linalg.eigh(energy * both)
    stiff = value > FREE * np.maximum(value[:, -1:], np.finfo(float).tiny)
    root = np.where(stiff, 1 / np.sqrt(np.where(stiff, value, 1.0)), 0.0)
    vector = vector * root[:, None, :]
    reduced = np.swapaxes(vector, 1, 2) @ (flux * both) @ vector
    return np.asarray(np.linalg.eigvalsh(reduced)[:, -1])


def _extends(model: Model) -> Bools:
    """Elements whose fields can be continued beyond them."""
    found = np.zeros(len(model.density), dtype=bool)
    for group in model.manifold.groups:  # a handful of groups
        found[group.elements] = group.extends
    return found
