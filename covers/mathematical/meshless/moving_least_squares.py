"""Meshless covers: discs about nodes, with weights by moving least squares or Shepard's formula."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np
import numpy.typing as npt

from covers.mathematical.meshless.disc_cover import DiscCover
from covers.mathematical.meshless.disc_supports import fitted_discs, undetermined_discs
from covers.mathematical.meshless.discs import discs_of_cells, with_discs_alike
from covers.mathematical.meshless.kernels import kernel
from covers.mathematical.meshless.weighted_fits import fit
from covers.mathematical.regular_grids import grid_cells, grid_vertices, regular_net
from integration.arrays import Floats, Ints
from integration.monomials import count, differentiate, evaluate

if TYPE_CHECKING:
    from covers.cutting.cut_cells import CutCells
    from covers.mathematical.base import Recut

# Default radius of the discs in spacings of a regular grid of nodes, by degree of the basis.
RADII = {0: 1.5, 1: 2.0, 2: 3.0, 3: 4.0}
# Factor by which discs are enlarged, and the largest number of times.
GROWTH, ROUNDS = 1.25, 8


@dataclass(frozen=True, eq=False)
class MovingLeastSquares(DiscCover):
    """Shape functions of a weighted least-squares fit by polynomials at every point.

    With the basis p, kernels phi_i and A = sum phi_i p(x_i) p(x_i)^T the weights are
    w_i(x) = phi_i(x) p(x)^T A(x)^-1 p(x_i) (Nayroles, Touzot and Villon 1992; Belytschko, Lu and
    Gu 1994). Degree 0 is Shepard's formula phi_i / sum phi_j (1968). Rows of inactive patches hold
    -1 in `cell_patches` and zero weights. Cells are the grid on which integrals are taken.
    """

    overlap: ClassVar[float] = 10.0

    @property
    def precision(self) -> int:
        """All polynomials of the basis, by their values at the nodes."""
        return self.degree

    @classmethod
    def regular(
        cls,
        bounds: npt.ArrayLike,
        size: float,
        *,
        degree: int = 1,
        kernel: str = "cubic_spline",
        radius: float | None = None,
        angle: float = 0.0,
        shift: tuple[float, float] = (0.0, 0.0),
    ) -> Self:
        """Return discs about the nodes of a square net over a box and as far beyond as they reach.

        Parameters
        ----------
        bounds : (2, 2)
            lower and upper corner of the box, m.
        size : float
            spacing of the nodes and edge of a background cell, m.
        degree, kernel
            basis, 0 (Shepard) to 3, and kernel.
        radius : float, optional
            radius of the discs in spacings; `RADII` of the degree when omitted.
        angle, shift
            turn of the net, rad, and its displacement in fractions of a spacing.
        """
        reach = RADII.get(degree, degree + 1.0) if radius is None else radius
        net = regular_net(bounds, (size, size), angle, shift)
        beyond = int(np.ceil(reach))
        i, j = np.meshgrid(
            np.arange(-beyond, net.columns + beyond + 1), np.arange(-beyond, net.rows + beyond + 1)
        )
        nodes = net.points(i.ravel(), j.ravel())
        vertices, cells = grid_vertices(net), grid_cells(net.columns, net.rows)
        return cls.on_cells(
            nodes,
            np.full(len(nodes), reach * size),
            vertices,
            cells,
            degree=degree,
            kernel=kernel,
            cell_shape=np.zeros(len(cells), dtype=np.int64),
        )

    @classmethod
    def on_cells(
        cls,
        nodes: Floats,
        radius: Floats,
        vertices: Floats,
        cell_vertices: Ints,
        *,
        degree: int = 1,
        kernel: str = "cubic_spline",
        cell_shape: Ints | None = None,
    ) -> Self:
        """Return discs of given nodes (N, 2) and radii (N,) over any mesh of convex cells.

        Raises
        ------
        ValueError
            A degree out of 0 to 3, an unknown kernel, a cell whose centre lies in fewer discs than
            the basis has functions.
        """
        _check_options(degree, kernel)
        patches = discs_of_cells(nodes, radius, vertices[cell_vertices])
        middle = vertices[cell_vertices].mean(axis=1)
        away = np.linalg.norm(nodes[patches] - middle[:, None], axis=2)
        active = ((away < radius[patches]) & (patches >= 0)).sum(axis=1)
        if (active < count(degree)).any():
            cell = int(np.argmin(active))
            raise ValueError(
                f"cell {cell} at {middle[cell].tolist()}: {active[cell]} discs: at least "
                f"{count(degree)} expected for a basis of degree {degree}: enlarge the radius"
            )
        used = patches[patches >= 0]
        kept = np.unique(used)
        patches = np.where(patches >= 0, np.searchsorted(kept, patches), -1)
        shape = np.full(len(cell_vertices), -1)
        if cell_shape is not None:
            shape = with_discs_alike(
                cell_shape, patches, nodes[kept], vertices[cell_vertices[:, 0]]
            )
        return cls(
            vertices=vertices,
            cell_vertices=cell_vertices,
            cell_patches=patches,
            patch_centre=nodes[kept],
            patch_size=radius[kept],
            cell_shape=shape,
            radius=radius[kept],
            degree=degree,
            kernel=kernel,
        )

    def evaluate(self, cells: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Weights (m, k) and gradients (m, k, 2), 1/m.

        Raises
        ------
        ValueError
            A point where the discs do not determine the fit.
        """
        away, radius, value, slope = self.about(cells, points)
        length = radius.max(axis=1, initial=0.0)
        basis, steps = self._basis(-away / length[:, None, None], length)
        return fit(basis, steps, value, slope, points)

    def settled(self, cut: CutCells, again: Recut) -> tuple[MovingLeastSquares, CutCells]:
        """See `Cover.settled`: leave out discs that reach too little, enlarge their neighbours.

        Raises
        ------
        ValueError
            Points whose fit no enlarged disc determines.
        """
        cover, radius = self, self.radius
        for _ in range(ROUNDS):  # each enlarges the discs of points whose fit is undetermined
            kept, pieces = fitted_discs(cover, cut)
            undetermined = undetermined_discs(kept, pieces)
            if not undetermined.any():
                return replace(kept, enlarged=int((radius > self.radius).sum())), pieces
            radius = np.where(undetermined, GROWTH * radius, radius)
            cover = self.wider(radius)
            cut = again(cover)
        at = self.patch_centre[np.flatnonzero(undetermined)[0]]
        raise ValueError(
            f"moving least squares: {int(undetermined.sum())} discs, the first about "
            f"{at.tolist()}: do not determine a fit of degree {self.degree} though enlarged "
            f"{GROWTH**ROUNDS:.3g} "
            "times: use a smaller size, a lower degree of the basis or a cover of triangles"
        )

    def _basis(self, xi: Floats, length: Floats) -> tuple[Floats, Floats]:
        """Basis (m, k, K) about the point and its derivative (m, k, K, 2) when the point moves."""
        basis = evaluate(xi, self.degree)
        lower = evaluate(xi, max(self.degree - 1, 0))
        unit = np.eye(basis.shape[-1])
        steps = [lower @ differentiate(unit, self.degree, axis).T for axis in (0, 1)]
        return basis, -np.stack(steps, axis=-1) / length[:, None, None, None]


def _check_options(degree: int, name: str) -> None:
    if degree not in range(4):
        raise ValueError(
            f"moving least squares: degree = {degree}: expected 0 (Shepard) to 3: choose one"
        )
    kernel(name)
