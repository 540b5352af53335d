"""Weights of a weighted least-squares fit at points, and their gradients."""

import numpy as np

from integration.arrays import Floats

# Weights that miss the sum one by more come from a singular fit.
UNDETERMINED = 1e-6


def fit(
    basis: Floats, steps: Floats, value: Floats, slope: Floats, points: Floats
) -> tuple[Floats, Floats]:
    """Weights c . p_i phi_i (m, k) with A c = e_1, and their gradients by the product rule.

    Parameters
    ----------
    basis, steps
        Basis (m, k, K) at the nodes as seen from the points, and how it changes (m, k, K, 2) when
        the points move.
    value, slope
        Kernels (m, k) and their gradients (m, k, 2).
    points
        (m, 2)

    Raises
    ------
    ValueError
        A point where the discs do not determine the fit.
    """
    moment = np.einsum("mk,mka,mkb->mab", value, basis, basis)
    turned = np.einsum("mk,mkai,mkb->miab", value, steps, basis)
    change = turned + turned.swapaxes(2, 3)
    change += np.einsum("mki,mka,mkb->miab", slope, basis, basis)
    c, c_slope = _solve(moment, change)
    share = np.einsum("mka,ma->mk", basis, c)
    lost = ~(np.abs((share * value).sum(axis=1) - 1) < UNDETERMINED)
    if lost.any():
        rows = np.flatnonzero(lost)
        row = int(rows[np.argmin(np.linalg.matrix_rank(moment[rows]))])
        raise ValueError(
            f"point {points[row].tolist()}: {(value[row] > 0).sum()} discs do not determine a fit: "
            f"at least {basis.shape[2]} in general position expected: enlarge the radius"
        )
    share_slope = np.einsum("mkai,ma->mki", steps, c) + np.einsum("mka,mai->mki", basis, c_slope)
    return share * value, share_slope * value[..., None] + share[..., None] * slope


def _solve(moment: Floats, change: Floats) -> tuple[Floats, Floats]:
    """Solution c of A c = e_1 and its derivative; not numbers when any A is singular."""
    first = np.zeros((*moment.shape[:2], 1))
    first[:, 0] = 1.0
    try:
        c = np.asarray(np.linalg.solve(moment, first)[..., 0], dtype=float)
        right = -np.einsum("miab,mb->mai", change, c)
        return c, np.asarray(np.linalg.solve(moment, right), dtype=float)
    except np.linalg.LinAlgError:
        return np.full(moment.shape[:2], np.nan), np.zeros((*moment.shape[:2], 2))
