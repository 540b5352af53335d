"""Inverses of many 2 x 2 matrices at once."""

from __future__ import annotations

import numpy as np

from integration.arrays import Floats


def inverses(matrices: Floats) -> Floats:
    """Inverses (..., 2, 2) by Cramer's rule; not finite where a matrix is singular."""
    a, b = matrices[..., 0, 0], matrices[..., 0, 1]
    c, d = matrices[..., 1, 0], matrices[..., 1, 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        factor = 1.0 / (a * d - b * c)
        out = np.stack([d * factor, -b * factor, -c * factor, a * factor], axis=-1)
    return np.asarray(out.reshape(matrices.shape))
