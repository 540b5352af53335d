"""Free vibration: the lowest modes, dependent functions deflated."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, diags_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.errors import SolveError
from nmm.solvers.scaling import jacobi_scale

# Part of its diagonal added to the stiffness: dependent functions, which have no mass, get infinite
# frequencies by it.
SHIFT = 1e-10
# Part of the mass of a mode that its displacements carry, at least.
CARRIED = 0.5


@dataclass(frozen=True)
class Modes:
    """The lowest modes.

    Attributes
    ----------
    frequency
        (k,) circular frequencies (rad/s), rising; zero for rigid motions.
    shape
        (n, k) unknowns, of unit modal mass.
    """

    frequency: Floats
    shape: Floats


def lowest_modes(model: Model, number: int) -> Modes:
    """Return the lowest modes by inverse iteration on a subspace (Lanczos, shift and invert).

    Stiffness and mass share the null space of dependent functions. A small part of the diagonal
    added to the stiffness makes it definite there; as null functions carry no mass, every product
    with the mass takes them out of the iterates. A lumped mass gives them one, and modes to
    differences between covers that overlap: modes whose displacements carry less than half of
    their mass are left out.

    Parameters
    ----------
    model
        With densities.
    number
        Number of modes.

    Raises
    ------
    SolveError
        Without mass.
    """
    from scipy.sparse.linalg import LinearOperator, eigsh, splu

    stiffness = model.stiffness
    mass = model.mass
    if not mass.nnz or mass.diagonal().max() <= 0:
        raise SolveError("modes: the model has no mass: expected densities: give materials one")
    # A frequency well below the lowest elastic one, so that rigid motions are found too.
    ratio = stiffness.diagonal().sum() / mass.diagonal().sum()
    sigma = -1e-6 * ratio
    matrix = csc_array(stiffness - sigma * mass)
    scale = jacobi_scale(matrix)
    scaled = csc_array(diags_array(scale) @ matrix @ diags_array(scale))
    n = matrix.shape[0]
    factor = splu(
        csc_array(scaled + (SHIFT if model.manifold.dependent else 0.0) * diags_array(np.ones(n))),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )

    def inverse(load: Floats) -> Floats:
        return np.asarray(scale * factor.solve(scale * np.ravel(load)))

    operator = LinearOperator((n, n), matvec=inverse, dtype=np.float64)
    start = mass @ np.random.default_rng(0).normal(size=n)
    least, many = len(start) - 2, number
    while True:
        values, vectors = eigsh(
            stiffness, k=many, M=mass, sigma=sigma, OPinv=operator, v0=inverse(start)
        )
        if model.lumped:
            values, vectors = _of_displacements(model, values, vectors)
        if len(values) >= number or many >= least:
            break
        many = min(2 * many + model.manifold.dependent, least)
    order = np.argsort(values)[:number]
    # Rounding of K leaves rigid motions with squares of either sign near zero.
    squares = np.where(values > 1e-8 * np.abs(values).max(), values, 0.0)[order]
    return Modes(np.sqrt(squares), vectors[:, order])


def _of_displacements(model: Model, values: Floats, vectors: Floats) -> tuple[Floats, Floats]:
    """Modes whose displacements carry their mass; among those of frequency zero they are sought."""
    still = np.abs(values) <= 1e-8 * np.abs(values).max()
    zero = vectors[:, still]
    _, turn = np.linalg.eigh(zero.T @ (model.consistent_mass @ zero))
    vectors = np.concatenate([zero @ turn, vectors[:, ~still]], axis=1)
    values = np.concatenate([np.zeros(int(still.sum())), values[~still]])
    share = np.einsum("nk,nk->k", vectors, model.consistent_mass @ vectors)
    return values[share > CARRIED], vectors[:, share > CARRIED]
