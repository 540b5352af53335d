"""Pressures on edges that Nitsche's method holds: a gap counts as volume of the patches beside it.

With the volumes ``B u`` of the pressures' functions (`nmm.assembly.projected_volumes`) and ``G g``
their integrals with the gap ``g`` along the outward normal, the terms

    -(G g)^T D B u + s (G g)^T D (G g) / 2,     D = lambda M^-1,

are the pressure's traction, consistent and symmetric, with a penalty on what the pressures see of
the gap. Nothing of the size of ``lambda`` is asked point by point: along a line through elements
that alone would lock (the lifting of Bassi and Rebay 1997; Brezzi and others 2000). With the
stiffness ``(B u)^T D B u / 2`` the terms are not negative, whatever the cut, if ``1 / s`` summed
over all edges that share a patch is at most 1. Four times as much costs a cavity 0.1 % more.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Floats, Ints
from integration.sparse import csc_array, csr_array, diags_array
from nmm.assembly.model import Model

# Of interfaces: both sides of glue and of sub-blocks may share a patch, and supports take a half.
SHARE = 8.0


@dataclass(frozen=True)
class PressureLift:
    """The pressures beside an edge.

    Attributes
    ----------
    wanted
        (j,) which pressures of the model.
    volume
        (j, n) rows of the volumes ``B`` (m).
    root
        (i, j) with ``root.T @ root`` the stiffness ``D`` times the thickness (Pa/m).
    weights
        (j, m) the pressures' functions at the points times the length of edge of each (m).
    share
        (j,) the factor ``s`` on the penalty.
    """

    wanted: Ints
    volume: csr_array
    root: csr_array
    weights: csr_array
    share: Floats

    def matrix(self, rows: csr_array) -> csc_array:
        """Matrix (n, n) from rows (m, n) of the gap."""
        gap = csr_array(self.root @ (self.weights @ rows))
        more = csr_array(self.root @ (diags_array(np.sqrt(self.share)) @ (self.weights @ rows)))
        cross = gap.T @ csr_array(self.root @ self.volume)
        return csc_array(more.T @ more - cross - cross.T)

    def pressure(self, deformation: Floats, gap: Floats) -> Floats:
        """Pressures at the points times their area (m,), of gaps (m,)."""
        volume = self.volume @ deformation - self.share * (self.weights @ gap)
        return np.asarray(self.weights.T @ self._stiff(volume))

    def force(self, rows: csr_array, deformation: Floats, gap: Floats) -> Floats:
        """Force (n,) on the unknowns: minus the slope of the terms' energy."""
        pull = rows.T @ self.pressure(deformation, gap)
        return np.asarray(pull + self.volume.T @ self._stiff(self.weights @ gap))

    def energy(self, deformation: Floats, gap: Floats) -> float:
        """Energy (J) of the terms."""
        open_volume = self.weights @ gap
        half = self.share * open_volume / 2 - self.volume @ deformation
        return float((self.root @ open_volume) @ (self.root @ half))

    def gap_volume(self, gap: Floats, k: int) -> Floats:
        """Volumes (k,) of a gap (m,) for all pressures of the model (m2)."""
        found = np.zeros(k)
        found[self.wanted] = self.weights @ gap
        return found

    def _stiff(self, volume: Floats) -> Floats:
        return np.asarray(self.root.T @ (self.root @ volume))


def lift(model: Model, sides: Sequence[tuple[Ints, Floats, Floats]]) -> PressureLift | None:
    """Return the pressures at points of edges; None where the material has none.

    Both sides are one: a patch may have edges of which it is the first side, and others of which
    it is the second, and which is which depends on the order of bodies.

    Parameters
    ----------
    sides
        For one side or both: elements (m,), points (m, 2) and the length (m,) of edge that each
        point stands for (m), times the share of the side in the traction.
    """
    known = model.pressures
    if known is None:
        return None
    rows = csr_array(
        sum(
            diags_array(length) @ known.rows(model.manifold, elements, points)
            for elements, points, length in sides
        )
    )
    wanted = _of_patches(csr_array(known.root), np.unique(rows.indices))
    if not len(wanted):
        return None
    weights = csr_array(csr_array(rows[:, wanted]).T)
    root = csr_array(np.sqrt(model.thickness) * known.root[:, wanted])
    root = csr_array(root[np.diff(root.indptr) > 0])
    share = np.full(len(wanted), SHARE)
    return PressureLift(wanted, csr_array(known.divergence[wanted]), root, weights, share)


def _of_patches(root: csr_array, seen: Ints) -> Ints:
    """Return all pressures of the patches that have those that are ``seen``.

    The stiffness couples all of a patch: one that no gap moves, or by rounding alone, as it is odd
    along the edge, has a volume that does.
    """
    from scipy.sparse.csgraph import connected_components

    _, patch = connected_components(csr_array(root.T @ root), directed=False)
    return np.flatnonzero(np.isin(patch, patch[seen]))


def sharing(lifts: Sequence[PressureLift | None]) -> list[PressureLift | None]:
    """Return lifts of edges that leave half of every patch they share to other edges."""
    found = [item for item in lifts if item is not None]
    count = np.zeros(1 + max((int(item.wanted.max()) for item in found), default=0))
    for item in found:  # supports
        count[item.wanted] += 1
    return [None if one is None else replace(one, share=2 * count[one.wanted]) for one in lifts]
