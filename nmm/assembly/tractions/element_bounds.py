"""The largest ratio of traction to energy of single elements: what a penalty must outweigh."""

from collections.abc import Sequence

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.elements import element_matrices
from nmm.assembly.model import Model

# Eigenvalues of a scaled element stiffness below this share of the largest are free motions.
FREE = 1e-11


def element_bounds(
    model: Model,
    donor: Sequence[Ints],
    traction: Sequence[Floats],
    weight: Floats,
    reach: Sequence[Floats] | None = None,
) -> list[Floats]:
    """Bounds ``r`` (m,) with ``int |sigma n|^2 / r <= a(u, u)`` of donors, for each side (Pa/m).

    The integral goes over all points that a donor serves, on either side, so that the bounds add
    up: they draw on the same energy. Zero where the donor has no stress at all (rigid functions).
    They are the same at all points of a donor, or go as the inverse of ``reach``: a short edge far
    from an element's middle is then held less firmly than a long one near it.

    Parameters
    ----------
    donor
        (m,) element, for each side.
    traction
        (m, 2, L) rows, for each side.
    weight
        (m,) area of boundary (m2).
    reach
        (m,) lengths (m), for each side; None for the same everywhere.
    """
    reach = reach or [np.ones(len(weight)) for _ in donor]
    served, number = np.unique(np.concatenate(donor), return_inverse=True)
    numbers = np.split(number.ravel(), len(donor))
    length = max(values.shape[2] for values in traction)
    flux = np.zeros((len(served), length, length))
    for place, values, far in zip(numbers, traction, reach, strict=True):  # two sides
        own = values.shape[2]
        each = np.einsum("mia,m,mib->mab", values, weight * far, values)
        np.add.at(flux[:, :own, :own], place, each)
    ratio = largest_ratio(flux, element_stiffness(model, served, length))
    return [ratio[place] / far for place, far in zip(numbers, reach, strict=True)]


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


def largest_ratio(flux: Floats, energy: Floats) -> Floats:
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
