"""Mathematical covers: overlapping patches with weights that sum to one (Shi 1991)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import numpy.typing as npt

from covers.mathematical.patch_mesh import PatchMesh
from integration.arrays import Floats, Ints

if TYPE_CHECKING:
    from collections.abc import Callable

    from covers.cutting.cut_cells import CutCells

    Recut = Callable[["Cover"], CutCells]

# Largest number of cells along a side that is counted exactly.
MOST_ALONG = 1e6


class CoverType:
    """A type of cover: patches over all of the material, or one cover for each block.

    Attributes
    ----------
    coordinates
        options that are points in the axes of the scene.
    family
        "manifold", or "DDA" where blocks are covered one by one: what studies compare.
    usual_functions, usual_degree
        Local functions of its covers where none are named, and their degree where none is given;
        None asks for one.
    """

    coordinates: ClassVar[tuple[str, ...]] = ()
    family: ClassVar[str] = "manifold"
    usual_functions: ClassVar[str] = "monomials"
    usual_degree: ClassVar[int | None] = 1


@dataclass(frozen=True, eq=False)
class Cover(CoverType, PatchMesh, ABC):
    """Weights of the patches over a mesh of convex cells.

    The mesh does not follow the material: the cut determines what is covered. Its fields are those
    of `covers.mathematical.patch_mesh.PatchMesh`. With ``precision >= 1``,
    ``sum w_i(x) patch_centre_i = x``.

    Attributes
    ----------
    overlap
        Ratio of the number of entries of its matrix rows to those of a mesh of finite elements.
    """

    overlap: ClassVar[float] = 1.0

    @classmethod
    def foreseen(cls, bounds: npt.ArrayLike, size: float, **options: Any) -> float:
        """Return the approximate number of cells that ``regular`` makes over a box.

        By default one for each square of ``size``; override it for other cells. Beyond a million
        cells along a side the number is not exact.

        Raises
        ------
        ValueError, TypeError
            As ``regular`` raises them.
        """
        low, high = np.array(bounds, dtype=float).reshape(2, 2)
        return float(np.prod(np.minimum(high - low, MOST_ALONG * size) / size + 1))

    @property
    @abstractmethod
    def precision(self) -> int:
        """Highest degree ``s`` of the polynomials that the weights reproduce exactly."""

    @property
    def weight_degree(self) -> int | None:
        """Total degree of the weights as polynomials on a cell; None for others."""
        return None

    @abstractmethod
    def evaluate(self, cells: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Weights (m, k) and gradients (m, k, 2) of the patches of ``cells`` (m,) at points."""

    def settled(self, cut: CutCells, again: Recut) -> tuple[Cover, CutCells]:
        """Return the cover and cut on which functions are defined, without unusable patches.

        Parameters
        ----------
        cut
            The cut of the cover by the material.
        again
            Cuts another cover by the same material.
        """
        return self, cut

    @property
    def settles(self) -> bool:
        """Whether its patches depend on the cut, so that each cut begins with a cover laid anew."""
        return type(self).settled is not Cover.settled

    @property
    def mended(self) -> dict[str, int]:
        """Changes by `settled`, in words, with the number of patches."""
        return {}

    def weights(self, cells: Ints, points: Floats) -> Floats:
        """Weights (m, k) at ``points`` (m, 2) in ``cells`` (m,)."""
        return self.evaluate(cells, points)[0]

    def weight_tables(self, cells: Ints, origin: Floats, scale: Floats) -> tuple[Floats, int]:
        """Coefficients (m, k, K) of the weights over monomials of (x - origin) / scale, and degree.

        Raises
        ------
        ValueError
            The weights are not polynomials on a cell (`weight_degree` is None).
        """
        raise ValueError(
            f"{type(self).__name__}: weights that are no polynomials: polynomial weights expected: "
            "integrate with point rules and evaluate()"
        )
