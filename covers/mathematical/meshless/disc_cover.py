"""Discs about nodes, with kernels that vanish at their rims."""

from __future__ import annotations

from abc import ABC
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from covers.mathematical.base import Cover
from covers.mathematical.meshless.discs import discs_of_cells
from covers.mathematical.meshless.kernels import kernel
from integration.arrays import Bools, Floats, Ints
from integration.monomials import evaluate

# Smallest sum of kernels at a point, and eigenvalue of its scaled moments by degree of the basis.
MIN_KERNEL_SUM = 0.02
MIN_EIGENVALUE = {0: 0.0, 1: 1e-2, 2: 1e-3, 3: 1e-4}


@dataclass(frozen=True, eq=False)
class DiscCover(Cover, ABC):
    """Base of covers whose patches are discs.

    Attributes
    ----------
    radius : (N,)
        radii of the discs, m.
    degree : int
        degree of the basis.
    kernel : str
        one of `covers.mathematical.meshless.kernels.KERNELS`.
    left_out, enlarged : int
        pieces of discs that reach the material too little to carry functions, and discs whose
        radius has grown in their place (`covers.mathematical.meshless.disc_supports`).
    """

    radius: Floats
    degree: int
    kernel: str
    left_out: int = 0
    enlarged: int = 0

    @property
    def disc_radius(self) -> Floats:
        """Radii (N,) of the discs, m."""
        return self.radius

    @property
    def mended(self) -> dict[str, int]:
        said = {
            "pieces of discs left out that hardly reach the material": self.left_out,
            "discs enlarged where others hardly reach": self.enlarged,
        }
        return {words: number for words, number in said.items() if number}

    def kernels(self, cells: Ints, points: Floats) -> Floats:
        """Kernels (m, k) of the patches of ``cells`` (m,) at points; zero where there is none."""
        return self.about(cells, points)[2]

    def determined(self, cells: Ints, points: Floats) -> Bools:
        """Whether (m,) the discs of ``cells`` determine the fit at a point.

        The kernels add up to `MIN_KERNEL_SUM`, and the moment matrix, scaled to a diagonal of ones,
        has no eigenvalue below `MIN_EIGENVALUE` of the degree.
        """
        away, radius, value, _ = self.about(cells, points)
        length = radius.max(axis=1, initial=0.0)
        basis = evaluate(-away / length[:, None, None], self.degree)
        moment = np.einsum("mk,mka,mkb->mab", value, basis, basis)
        scale = 1 / np.sqrt(np.maximum(np.einsum("maa->ma", moment), 1e-300))
        least = np.linalg.eigvalsh(moment * scale[:, :, None] * scale[:, None, :])[:, 0]
        enough = value.sum(axis=1) >= MIN_KERNEL_SUM
        return np.asarray(enough & (least >= MIN_EIGENVALUE[self.degree]))

    def wider(self, radius: Floats) -> Self:
        """Return the cover with other radii (N,)."""
        cells = discs_of_cells(self.patch_centre, radius, self.vertices[self.cell_vertices])
        return replace(self, cell_patches=cells, patch_size=radius, radius=radius)

    def about(self, cells: Ints, points: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """Return offsets (m, k, 2) from the nodes, radii, kernels (m, k), gradients (m, k, 2).

        Kernels are zero where the patch is not active.
        """
        patches = self.cell_patches[cells]
        away, radius = points[:, None] - self.patch_centre[patches], self.radius[patches]
        distance = np.linalg.norm(away, axis=2)
        value, slope = kernel(self.kernel)(distance / radius)
        inside = (patches >= 0) & (distance < radius)
        direction = away / np.where(distance > 0, distance, 1.0)[..., None]
        gradient = (np.where(inside, slope, 0.0) / radius)[..., None] * direction
        return away, radius, np.where(inside, value, 0.0), gradient
