"""A mathematical cover of one's own: a net of triangles in rings about a hole, finer inwards."""

from typing import Any, Self

import numpy as np
import numpy.typing as npt
from skfem import MeshTri

from covers.mathematical.triangles import Triangles


class Radial(Triangles):
    """Hat weights on rings of triangles; a ring is as wide as its cells are long."""

    @classmethod
    def regular(
        cls,
        bounds: npt.ArrayLike,
        size: float,
        *,
        angle: float = 0.0,
        shift: tuple[float, float] = (0.0, 0.0),
        centre: tuple[float, float] = (0.0, 0.0),
        inner: float = 1.0,
    ) -> Self:
        """Cover a box but for the circle of radius ``inner`` (m) about ``centre``.

        ``size`` is the length of the innermost cells; ``angle`` turns the net. Formulations pass
        ``shift`` to every cover; this one has no use for it.
        """
        low, high = np.array(bounds, dtype=float)
        reach = float(np.hypot(*np.maximum(high - centre, centre - low)))
        sectors = max(round(2 * np.pi * inner / size), 8)
        growth = 1 + 2 * np.pi / sectors
        # The last ring's chords must lie beyond the box.
        far = reach / inner / np.cos(np.pi / sectors)
        rings = int(np.ceil(np.log(far) / np.log(growth))) + 1
        radius = inner * growth ** np.arange(rings + 1)
        turn = angle + 2 * np.pi * np.arange(sectors) / sectors
        points = radius[:, None, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        i, j = np.meshgrid(np.arange(rings), np.arange(sectors), indexing="ij")
        a, b = (i * sectors + j).ravel(), (i * sectors + (j + 1) % sectors).ravel()
        c, d = a + sectors, b + sectors
        corners: Any = np.concatenate([np.stack([a, c, d]), np.stack([a, d, b])], axis=1)
        return cls.from_mesh(MeshTri((points.reshape(-1, 2) + centre).T.copy(), corners))
