"""Element matrices of mechanics from the integrals that any element group gives."""

import numpy as np

from covers.approximation.groups.element_group import ElementGroup
from integration.arrays import Floats, Ints


def stiffness(group: ElementGroup, shape: Ints, elasticity: Floats) -> Floats:
    """Integral of ``B^T D B`` (m, L, L) per unit thickness.

    Parameters
    ----------
    group
        The elements.
    shape, elasticity
        (m,) and (m, 3, 3) shapes of the group with stress from strain (xx, yy, 2 xy).
    """
    xx, xy, yy = np.moveaxis(_taken(group.gradient_products(), shape), 1, 0)
    yx = np.swapaxes(xy, 1, 2)
    d = elasticity[:, :, :, None, None]
    uu = d[:, 0, 0] * xx + d[:, 0, 2] * xy + d[:, 2, 0] * yx + d[:, 2, 2] * yy
    uv = d[:, 0, 1] * xy + d[:, 0, 2] * xx + d[:, 2, 1] * yy + d[:, 2, 2] * yx
    vv = d[:, 1, 1] * yy + d[:, 1, 2] * yx + d[:, 2, 1] * xy + d[:, 2, 2] * xx
    n, size, _ = xx.shape
    full = np.empty((n, size, 2, size, 2))
    full[:, :, 0, :, 0] = uu
    full[:, :, 0, :, 1] = uv
    full[:, :, 1, :, 0] = np.swapaxes(uv, 1, 2)
    full[:, :, 1, :, 1] = vv
    return _combine_both(group, full.reshape(n, 2 * size, 2 * size))


def mass(group: ElementGroup, shape: Ints, density: Floats) -> Floats:
    """Integral of ``rho T^T T`` (m, L, L) per unit thickness; shapes and ``density`` (m,)."""
    return _both_components(group, _taken(group.products(), shape) * density[:, None, None])


def lumped_mass(group: ElementGroup, shape: Ints, density: Floats) -> Floats:
    """Integral of ``rho w_k f_s f_t`` (m, L, L) over functions of one cover ``k`` at a time.

    A row sum for constant functions; for higher degrees the mass and the momentum of every field,
    and the energy of fields that all covers hold alike, rigid motions among them, are exact.
    ``shape`` and ``density`` (kg/m2) are those (m,) of the elements.
    """
    scalar = _taken(group.lumped_products(), shape) * density[:, None, None]
    return _both_components(group, scalar)


def _both_components(group: ElementGroup, scalar: Floats) -> Floats:
    n, size, _ = scalar.shape
    full = np.zeros((n, size, 2, size, 2))
    full[:, :, 0, :, 0] = scalar
    full[:, :, 1, :, 1] = scalar
    return _combine_both(group, full.reshape(n, 2 * size, 2 * size))


def body_load(group: ElementGroup, load: Floats) -> Floats:
    """Integral of ``T^T b`` (n, L) for a force density ``b`` (n, 2) constant on each element."""
    full = group.integrals()[group.shape][:, :, None] * load[:, None, :]
    return _combine(group, full.reshape(len(full), -1))


def stress_load(group: ElementGroup, stress: Floats) -> Floats:
    """Integral of ``B^T sigma`` (n, L) for a stress (n, 3) constant on each element."""
    tensor = stress[:, [[0, 2], [2, 1]]]
    full = np.einsum("nsj,ncj->nsc", group.gradient_integrals()[group.shape], tensor)
    return _combine(group, full.reshape(len(full), -1))


def mean_strain_rows(group: ElementGroup) -> Floats:
    """Rows (d, 3, L) of the integral of the strain over an element of each shape."""
    gradient = group.gradient_integrals()
    n, size, _ = gradient.shape
    full = np.zeros((n, 3, size, 2))
    full[:, 0, :, 0] = gradient[:, :, 0]
    full[:, 1, :, 1] = gradient[:, :, 1]
    full[:, 2, :, 0] = gradient[:, :, 1]
    full[:, 2, :, 1] = gradient[:, :, 0]
    rows = full.reshape(n, 3, 2 * size)
    return rows if group.combination is None else rows @ group.combination


def _taken(values: Floats, index: Ints) -> Floats:
    same = len(index) == len(values) and np.array_equal(index, np.arange(len(values)))
    return values if same else values[index]


def _combine(group: ElementGroup, full: Floats) -> Floats:
    return full if group.combination is None else full @ group.combination


def _combine_both(group: ElementGroup, full: Floats) -> Floats:
    if group.combination is None:
        return full
    return np.swapaxes(group.combination, 0, 1) @ full @ group.combination
