"""Scaling of systems with multipliers: bodies without springs, and conditions that say nothing."""

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array

from nmm.constraints.multipliers import independent
from nmm.solvers.saddle import bordered, saddle_scale


def chain(stiff: float, n: int) -> csc_array:
    """Springs of ``stiff`` and free translations in turn, each tied to the next by a condition."""
    matrix = np.zeros((2 * n, 2 * n))
    matrix[1::2, 1::2] = stiff * np.eye(n)  # strains
    matrix[0, 0] = stiff  # the first translation is held
    rows = np.zeros((n - 1, 2 * n))
    for i in range(n - 1):  # translation and strain of neighbours agree at the joint
        rows[i, 2 * i : 2 * i + 4] = [1, 0.5, -1, 0.5]
    return bordered(csc_array(matrix), csr_array(rows))


@pytest.mark.parametrize("stiff", [1e-6, 1.0, 1e12])
def test_a_chain_of_tied_blocks_is_conditioned_alike_at_any_stiffness(stiff: float) -> None:
    matrix = chain(stiff, 6)
    scale = saddle_scale(matrix)
    value = np.abs(np.linalg.eigvalsh(scale[:, None] * matrix.toarray() * scale))
    # The chain's own condition grows as the square of its length, 36.
    assert value.max() / value.min() < 200


def test_scaling_follows_the_unit_of_stiffness() -> None:
    one, other = saddle_scale(chain(1.0, 4)), saddle_scale(chain(1e10, 4))
    np.testing.assert_allclose(other[:8], one[:8] * 1e-5, rtol=1e-12)
    np.testing.assert_allclose(other[8:], one[8:] * 1e5, rtol=1e-12)


def test_rounding_beside_an_entry_links_nothing() -> None:
    matrix = bordered(
        csc_array(np.diag([1e10, 0.0, 0.0])), csr_array(np.array([[1.0, 1.0, 0.0], [1e-17, 1, 1]]))
    )
    scale = saddle_scale(matrix)
    assert np.isfinite(scale).all()
    assert scale.max() / scale.min() < 1e11


def test_conditions_that_others_imply_are_left_out_whatever_their_order() -> None:
    random = np.random.default_rng(4)
    free = random.normal(size=(5, 12))
    implied = np.concatenate([free, random.normal(size=(3, 5)) @ free, 1e-15 * free[:1]])
    # Half the unknowns are motions of whole bodies with springs of their modulus in their place.
    diagonal = np.where(np.arange(12) % 2, 1e9, 1e8)
    for _ in range(5):
        order = random.permutation(len(implied))
        kept = independent(csr_array(implied[order]), diagonal)
        assert len(kept) == 5
        assert np.linalg.matrix_rank(implied[order][kept]) == 5
