"""What local functions of covers are held to."""

import numpy as np

from covers.local_functions.polynomials import LocalFunctions
from integration.monomials import evaluate
from nmm.testing.claims import claim, close, finite

# Of combinations of size one, in a few products.
ROUNDING = 1e-12


def check_local_functions(functions: LocalFunctions, seed: int = 0) -> None:
    """Hold local functions of one cover to what all promise.

    They are independent combinations of the monomials of their degree, and move the cover as a
    rigid body, constants without turn, where `linear_field` gives the unknowns of such a motion.

    Parameters
    ----------
    functions
        Of any degree.
    seed
        Of places and motions.

    Raises
    ------
    AssertionError
        Naming the property that does not hold.
    """
    size = 2 * functions.n_functions
    combination = np.eye(size) if functions.combination is None else functions.combination
    finite("combination", combination)
    expected = size, functions.n_unknowns
    claim(
        combination.shape == expected,
        f"combination: shape {combination.shape}, expected {expected}",
    )
    rank = int(np.linalg.matrix_rank(combination))
    claim(rank == expected[1], f"{expected[1]} functions: {rank} of them independent")
    random = np.random.default_rng(seed)
    place, shift = random.uniform(-1, 1, (50, 2)), random.normal(size=2)
    turn = random.normal() if functions.degree else 0.0
    gradient = np.array([[0, -turn], [turn, 0]])
    scale = np.eye(2) if functions.physical_length else np.diag(random.uniform(0.5, 2, 2))
    unknowns = functions.linear_field(shift[None], gradient[None], scale[None])[0]
    monomials = evaluate(place @ scale.T, functions.degree)
    moved = monomials @ (combination @ unknowns).reshape(-1, 2)
    close("a rigid motion", moved, shift + place @ gradient.T, ROUNDING)
