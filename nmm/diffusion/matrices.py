"""Matrices and loads of scalar fields from the exact integrals of the element groups."""

from collections.abc import Callable

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array

from covers.scalar.space import ScalarGroup, ScalarSpace
from integration.arrays import Floats
from nmm.assembly.elements.blocks import Part, assemble


def slopes(space: ScalarSpace, factor: Floats) -> csc_array:
    """Integrals (n, n) of ``factor grad phi_s . grad phi_t``; ``factor`` (E,) of the elements."""

    def of(part: ScalarGroup) -> Floats:
        products = part.group.gradient_products()
        return np.asarray(products[:, 0] + products[:, 2])

    return _form(space, factor, of)


def products(space: ScalarSpace, factor: Floats) -> csc_array:
    """Integrals (n, n) of ``factor phi_s phi_t``."""
    return _form(space, factor, lambda part: part.group.products())


def integrals(space: ScalarSpace, factor: Floats) -> Floats:
    """Integrals (n,) of ``factor phi_s``."""
    total = np.zeros(space.n)
    for part in space.groups:  # a handful of groups
        group = part.group
        values = group.integrals()[group.shape] * factor[group.elements, None]
        total += np.bincount(part.numbers.ravel(), values.ravel(), minlength=space.n)
    return total


def element_means(space: ScalarSpace) -> csr_array:
    """Rows (E, n) of the mean of the field over each element."""
    return _by_element(space, lambda part: part.group.integrals())


def element_slopes(space: ScalarSpace) -> tuple[csr_array, csr_array]:
    """Rows (E, n) of the mean slopes along x and y over each element."""
    x, y = (
        _by_element(space, lambda part, i=i: part.group.gradient_integrals()[:, :, i])  # type: ignore[misc]
        for i in (0, 1)
    )
    return x, y


def stress_coupling(space: ScalarSpace, stress: Floats) -> csr_array:
    """Matrix (n_unknowns, n): internal force of the stress ``stress`` (E, 3) times the field.

    ``int B^T stress phi_t`` over the elements, per unit thickness, in body axes.
    """
    rows, columns, values = [], [], []
    for part in space.groups:  # a handful of groups
        group = part.group
        own = stress[group.elements]
        # (d, T, S, 2): integrals of phi_t times the slopes of phi_s.
        by_slope = group.value_gradients(np.arange(len(group.carriers)))[group.shape]
        tensor = own[:, [[0, 2], [2, 1]]]
        full = np.einsum("ntsj,ncj->ntsc", by_slope, tensor)
        full = full.reshape(*full.shape[:2], -1)
        if group.combination is not None:
            full = full @ group.combination
        n_fields, n_unknowns = full.shape[1:]
        rows.append(np.repeat(group.unknowns[:, None, :], n_fields, axis=1).ravel())
        columns.append(np.repeat(part.numbers[:, :, None], n_unknowns, axis=2).ravel())
        values.append(full.ravel())
    places = np.concatenate(rows), np.concatenate(columns)
    shape = space.manifold.n_unknowns, space.n
    return csr_array(coo_array((np.concatenate(values), places), shape=shape))


def _form(space: ScalarSpace, factor: Floats, of: Callable[[ScalarGroup], Floats]) -> csc_array:
    parts = []
    for part in space.groups:  # a handful of groups
        group = part.group
        pairs, first, kind = np.unique(
            np.stack([group.shape, factor[group.elements]], axis=1),
            axis=0,
            return_index=True,
            return_inverse=True,
        )
        matrices = of(part)[group.shape[first]] * pairs[:, 1, None, None]
        parts.append(Part(part.numbers, matrices, kind.ravel()))
    return assemble(parts, space.n, space.offset)


def _by_element(space: ScalarSpace, of: Callable[[ScalarGroup], Floats]) -> csr_array:
    elements, numbers, values = [], [], []
    area = space.manifold.elements.areas
    for part in space.groups:  # a handful of groups
        group = part.group
        own = of(part)[group.shape] / area[group.elements, None]
        elements.append(np.repeat(group.elements, own.shape[1]))
        numbers.append(part.numbers.ravel())
        values.append(own.ravel())
    places = np.concatenate(elements), np.concatenate(numbers)
    shape = len(area), space.n
    return csr_array(coo_array((np.concatenate(values), places), shape=shape))
