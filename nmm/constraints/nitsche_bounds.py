"""How large Nitsche's penalty must be: the largest ratio of traction to energy."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from covers.approximation.ghost import neighbours
from integration.arrays import Floats, Ints
from nmm.assembly import element_matrices
from nmm.assembly.blocks import Part, assemble
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.constraints.interface import sparse_rows
from nmm.solvers.linear import make_solver

# Eigenvalues of a scaled element stiffness below this share of the largest are free motions.
FREE = 1e-11
# Part of the diagonal that makes the energy definite for fields without traction.
SHIFT = 1e-9
# Directions that the estimate of an edge keeps.
FEW = 20
# Residual of the estimate in the ratio, whose own error is of its square. Less would do for the
# safety, but what is left differs with the order in which a scene lists its blocks: by 1 % of the
# penalty at 5e-2, and supports that give way show it in the displacements.
TOLERANCE = 1e-4
# Wave numbers (x, y) of the two components the estimate starts from, over the size of the edge:
# alike nowhere, and symmetric about no axis.
WAVES = np.array([[61.3, 23.7], [37.9, 71.1]])


def element_bounds(
    model: Model, donor: Sequence[Ints], traction: Sequence[Floats], weight: Floats
) -> list[Floats]:
    """Largest ``int |sigma n|^2 / a(u, u)`` (m,) of the donor of each point, for each side (Pa/m).

    The integral goes over all points that a donor serves, on either side, so that the bounds add
    up: they draw on the same energy. Zero where the donor has no stress at all (rigid functions).

    Parameters
    ----------
    donor
        (m,) element, for each side.
    traction
        (m, 2, L) rows, for each side.
    weight
        (m,) area of boundary (m2).
    """
    served, number = np.unique(np.concatenate(donor), return_inverse=True)
    numbers = np.split(number.ravel(), len(donor))
    length = max(values.shape[2] for values in traction)
    flux = np.zeros((len(served), length, length))
    for place, values in zip(numbers, traction, strict=True):  # two sides
        own = values.shape[2]
        each = np.einsum("mia,m,mib->mab", values, weight, values)
        np.add.at(flux[:, :own, :own], place, each)
    ratio = largest_ratio(flux, element_stiffness(model, served, length))
    return [ratio[place] for place in numbers]


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
    from scipy.sparse.linalg import LinearOperator, eigsh

    energy = csc_array(_energy(model, place) + ghost)
    unknowns, values = traction
    weight = np.sqrt(place.weight * model.thickness)[:, None, None]
    rows = sparse_rows(unknowns, weight * values, energy.shape[0])
    active = np.flatnonzero(energy.diagonal() > 0)
    energy, rows = energy[active][:, active], csr_array(rows[:, active])
    scale = 1 / np.sqrt(energy.diagonal())
    scaled = csc_array(diags_array(scale) @ energy @ diags_array(scale))
    shifted = csc_array(scaled + SHIFT * diags_array(np.ones(len(scale))))
    factor = make_solver().decompose(shifted)
    rows = csr_array(rows @ diags_array(scale))

    def product(x: Floats) -> Floats:
        return np.asarray(rows @ factor.solve(rows.T @ np.ravel(x)))

    m = len(place)
    operator = LinearOperator((2 * m, 2 * m), matvec=product, dtype=np.float64)
    few: dict[str, Any] = {"ncv": min(FEW, 2 * m), "tol": TOLERANCE, "return_eigenvectors": False}
    largest = eigsh(operator, k=1, which="LA", v0=_start(place.position), **few)
    return float(largest[0])


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
        elasticity = model.thickness * model.drained[group.elements[chosen]]
        values = element_matrices.stiffness(group, group.shape[chosen], elasticity)
        parts.append(Part(group.unknowns[chosen], values, np.arange(len(chosen))))
    return assemble(parts, n, manifold.cover_offset)


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
