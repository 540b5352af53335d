"""A cover of one's own in one file: rectangles with weights that are smooth across cells."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Self

import numpy as np

from covers.mathematical.quads import Quads
from integration.monomials import count, multiply

# 1 - s and s with s = 3 t^2 - 2 t^3, whose slope vanishes at both ends of a cell.
STEPS = np.array([[1.0, 0.0, -3.0, 2.0], [0.0, 0.0, 3.0, -2.0]])


def weights() -> np.ndarray:
    """Coefficients (4, K) of the four products over the monomials of the unit square."""
    powers = np.arange(4)
    along, across = np.zeros((2, 2, count(3)))
    along[:, powers * (powers + 1) // 2] = STEPS
    across[:, powers * (powers + 1) // 2 + powers] = STEPS
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    return np.concatenate([multiply(along[[i]], 3, across[[j]], 3) for i, j in corners])


class Smooth(Quads):
    """Products of smooth steps: they sum to one and their slopes are continuous."""

    @property
    def precision(self) -> int:
        """Constants alone: linear fields need local functions of degree 1."""
        return 0

    @classmethod
    def regular(cls, bounds: Any, size: Any, **options: Any) -> Self:
        """Return a net of squares over a box."""
        return replace(super().regular(bounds, size, **options), table=weights(), degree=6)


def main() -> float:
    """Run Cook's membrane under the cover; return the displacement at (48, 52)."""
    import sys
    from pathlib import Path

    from nmm.formulation import parse_formulation
    from nmm.scene import read_scene
    from nmm.stepping.run import run

    here = Path(__file__).parent
    sys.path.insert(0, str(here))
    scene = read_scene(here.parent / "cook" / "membrane.toml")
    chosen = parse_formulation('[cover]\ntype = "smooth_cover:Smooth"\nsize = 3\ndegree = 1\n')
    return float(run(scene, chosen, allow_code=["smooth_cover"]).history["monitor:middle:uy"][-1])


if __name__ == "__main__":
    print(f"displacement {main():.3f} (reference 23.968)")
