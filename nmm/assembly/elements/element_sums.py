"""Sums over elements, group by group: congruent elements of one material share a matrix."""

from collections.abc import Callable

import numpy as np

from covers.approximation.groups.element_group import ElementGroup
from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints
from integration.sparse import csc_array
from nmm.assembly.elements.blocks import Part, assemble

# From a group, shapes (m,) and material (m, ...) to the matrices (m, n, n) of such elements.
ElementMatrices = Callable[[ElementGroup, Ints, Floats], Floats]


def summed_matrix(manifold: Manifold, element: ElementMatrices, material: Floats) -> csc_array:
    """Sum element matrices; congruent elements of equal ``material`` (E, ...) share one."""
    parts = []
    for group in manifold.groups:  # a handful of groups
        shape, first, kind = _kinds(group.shape, material[group.elements])
        matrices = element(group, shape, material[group.elements[first]])
        parts.append(Part(group.unknowns, matrices, kind))
    return assemble(parts, manifold.n_unknowns, manifold.cover_offset)


def summed_vector(manifold: Manifold, element: Callable[[ElementGroup], Floats]) -> Floats:
    """Sum what ``element`` says of the unknowns of each element, (e, n) of a group."""
    total = np.zeros(manifold.n_unknowns)
    for group in manifold.groups:  # a handful of groups
        total += np.bincount(group.unknowns.ravel(), element(group).ravel(), minlength=len(total))
    return total


def _kinds(shape: Ints, material: Floats) -> tuple[Ints, Ints, Ints]:
    """Shape (m,) and first element (m,) of each kind of element, and the kind (n,) of each."""
    _, first = np.unique(shape, return_index=True)
    if np.array_equal(material[first][shape], material):
        return np.arange(len(first)), first, shape
    rows = np.column_stack([shape, material.reshape(len(shape), -1)])
    _, first, kind = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return shape[first], first, kind.ravel()
