"""Matrices and loads of scalar fields from the exact integrals of the element groups."""

from collections.abc import Callable

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array

from covers.approximation.groups.element_group import ElementGroup
from covers.scalar.space import ScalarGroup, ScalarSpace
from integration.arrays import Floats
from nmm.assembly.elements.blocks import Part, assemble


def slopes(space: ScalarSpace, factor: Floats) -> csc_array:
    """Integrals (n, n) of ``grad phi_s . factor grad phi_t``; ``factor`` (E, 2, 2) symmetric."""
    columns = factor[:, [0, 0, 1], [0, 1, 1]]
    return _form(space, columns, slope_integrals)


def slope_integrals(group: ElementGroup) -> Floats:
    """Integrals (d, 3, S, S) that entries xx, xy and yy of a symmetric factor multiply."""
    found = group.gradient_products().copy()
    found[:, 1] += np.swapaxes(found[:, 1], 1, 2)
    return found


def products(space: ScalarSpace, factor: Floats) -> csc_array:
    """Integrals (n, n) of ``factor phi_s phi_t``; ``factor`` (E,) of the elements."""
    return _form(space, factor[:, None], lambda group: group.products()[:, None])


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


def _form(space: ScalarSpace, factor: Floats, of: Callable[[ElementGroup], Floats]) -> csc_array:
    """Sum of integrals (d, w, S, S) ``of`` a group times factors (E, w)."""
    parts = []
    for part in space.groups:  # a handful of groups
        group = part.group
        pairs, first, kind = np.unique(
            np.column_stack([group.shape, factor[group.elements]]),
            axis=0,
            return_index=True,
            return_inverse=True,
        )
        matrices = np.einsum("mw,mwst->mst", pairs[:, 1:], of(group)[group.shape[first]])
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
