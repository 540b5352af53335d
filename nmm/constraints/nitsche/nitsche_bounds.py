"""Least penalty of a support: the largest ratio of traction to energy on an edge."""

from typing import Any

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from covers.approximation.ghost import neighbours
from integration.arrays import Floats, Ints
from nmm.assembly.elements import element_matrices
from nmm.assembly.elements.blocks import Part, assemble
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.constraints.interface import sparse_rows
from nmm.solvers.linear import make_solver

# Part of the diagonal that makes the energy definite for fields without traction.
SHIFT = 1e-9
# Unknowns and rows up to which the ratio is that of full matrices, some milliseconds.
FULL = 600
# Directions that the estimate of a longer edge keeps.
FEW = 20
# Residual of that estimate. Less would do for the safety, but what is left differs with the order
# in which a scene lists its blocks, and supports that give way show it in the displacements: 5e-6
# of them at 1e-4.
TOLERANCE = 1e-8
# Wave numbers (x, y) of the two components the estimate starts from, over the size of the edge:
# alike nowhere, and symmetric about no axis.
WAVES = np.array([[61.3, 23.7], [37.9, 71.1]])


def edge_bound(
    model: Model, place: Place, traction: tuple[Ints, Floats], ghost: csc_array
) -> float:
    """Return the largest ``int |sigma n|^2 / (a(u, u) + ghost)`` over displacements (Pa/m).

    The energy is that of the elements on the edge and of their neighbours: element by element, as
    in `element_bounds`, small cuts have no bound; the ghost term gives one.

    Parameters
    ----------
    traction
        Unknowns (m, L) and rows (m, 2, L).
    """
    energy = csc_array(_energy(model, place) + ghost)
    unknowns, values = traction
    weight = np.sqrt(place.weight * model.thickness)[:, None, None]
    rows = sparse_rows(unknowns, weight * values, energy.shape[0])
    active = np.flatnonzero(energy.diagonal() > 0)
    energy, rows = energy[active][:, active], csr_array(rows[:, active])
    scale = diags_array(1 / np.sqrt(energy.diagonal()))
    shifted = csc_array(scale @ energy @ scale + SHIFT * diags_array(np.ones(len(active))))
    rows = csr_array(rows @ scale)
    if max(rows.shape) <= FULL:
        return _largest(rows.toarray(), shifted.toarray())
    return _estimate(rows, shifted, place.position)


def _largest(rows: Floats, energy: Floats) -> float:
    """Largest eigenvalue of ``rows energy^-1 rows^T``, all of them full."""
    from scipy.linalg import eigh

    ratio = rows @ np.linalg.solve(energy, rows.T)  # integrated energies need not be definite
    last = len(ratio) - 1
    return float(eigh((ratio + ratio.T) / 2, eigvals_only=True, subset_by_index=[last, last])[0])


def _estimate(rows: csr_array, energy: csc_array, position: Floats) -> float:
    """The same of sparse matrices, by Lanczos's method."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    factor = make_solver().decompose(energy)

    def product(x: Floats) -> Floats:
        return np.asarray(rows @ factor.solve(rows.T @ np.ravel(x)))

    m = rows.shape[0]
    operator = LinearOperator((m, m), matvec=product, dtype=np.float64)
    few: dict[str, Any] = {"ncv": FEW, "tol": TOLERANCE, "return_eigenvectors": False}
    return float(eigsh(operator, k=1, which="LA", v0=_start(position), **few)[0])


def _start(position: Floats) -> Floats:
    """Vector (2m,) to start the estimate from: a function of place, whatever the points' order.

    What it misses of the largest ratio would else differ with the order of a scene's blocks and
    vertices, and the solution with it.
    """
    away = position - position.mean(axis=0)
    phase = away / max(float(np.abs(away).max(initial=0.0)), 1e-300) @ WAVES
    return np.asarray(np.cos(phase + np.arange(2)).ravel())


def _energy(model: Model, place: Place) -> csc_array:
    """Stiffness of the elements on the edge and of their neighbours."""
    manifold = model.manifold
    own = np.unique(place.elements)
    first, second = neighbours(manifold, own)
    near = np.zeros(len(manifold.elements), dtype=bool)
    near[own] = near[first] = near[second] = True
    n = manifold.n_unknowns
    parts = []
    for group in manifold.groups:  # a handful of groups
        chosen = np.flatnonzero(near[group.elements])
        if not len(chosen):  # integrals of a group about a tip take longer than all the others
            continue
        elasticity = model.thickness * model.drained[group.elements[chosen]]
        values = element_matrices.stiffness(group, group.shape[chosen], elasticity)
        parts.append(Part(group.unknowns[chosen], values, np.arange(len(chosen))))
    return assemble(parts, n, manifold.cover_offset)
