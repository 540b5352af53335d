"""Pressures on covers: the part of a stiffness that resists changes of volume, patch by patch.

Displacements that keep the volume of every element point by point hardly exist near a Poisson
ratio of 1/2. So the change of volume is held by pressures on the same physical covers, of functions
``f`` one degree below those of the displacements,

    M_k r_k = int w_k f div u dA,     p = sum_k w_k lambda_k r_k . f,     M_k = int w_k f f^T dA,

which couples no pressure with another: a least-squares fit of the divergence on every patch. With
weights of linear precision a local field ``-r_k (x - x_k)`` on every cover answers the pressure
``sum_k w_k r_k``: so Verfuerth (1984) shows that pairs of Taylor and Hood are stable. For covers
of degree 0 it is the averaged nodal pressure of Bonet and Burton (1998), which oscillates.
"""

from dataclasses import dataclass

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints
from integration.sparse import coo_array, csr_array


@dataclass(frozen=True)
class Pressures:
    """Pressures on the patches of covers, of elements of one bulk stiffness each.

    Attributes
    ----------
    divergence
        (k, n) integrals of the pressures' functions times the divergence (m).
    root
        (k, k) with ``root.T @ root`` the stiffness ``lambda M^-1`` (Pa/m2).
    functions
        For each element group the functions (T,) that pressures have and the pressure (n, T) of
        each element's, -1 for none.
    """

    divergence: csr_array
    root: csr_array
    functions: tuple[tuple[Ints, Ints], ...]

    def __len__(self) -> int:
        return int(self.divergence.shape[0])

    def of(self, volume: Floats) -> Floats:
        """Return the pressures (k,) in Pa of changes of volume (k,) of their functions."""
        return np.asarray(self.root.T @ (self.root @ volume))

    def rows(self, manifold: Manifold, elements: Ints, points: Floats) -> csr_array:
        """Rows (m, k) of the pressure at points (m, 2) in elements (m,)."""
        place = np.full((2, len(manifold.elements)), -1)
        parts = []
        for number, group in enumerate(manifold.groups):  # a handful of groups
            place[0, group.elements], place[1, group.elements] = (
                number,
                np.arange(len(group.elements)),
            )
        for number, group in enumerate(manifold.groups):
            chosen, pressure = self.functions[number]
            at = np.flatnonzero(place[0, elements] == number)
            inside = place[1, elements[at]]
            if len(at) and len(chosen):
                parts.append((at, pressure[inside], group.values(inside, points[at])[:, chosen]))
        return self._rows(parts, len(elements))

    def integrals(self, manifold: Manifold) -> csr_array:
        """Rows (E, k) of the integral of the pressure over each element (m2)."""
        parts = []
        for group, (chosen, pressure) in zip(manifold.groups, self.functions, strict=True):
            if len(chosen):
                values = group.integrals()[group.shape][:, chosen]
                parts.append((group.elements, pressure, values))
        return self._rows(parts, len(manifold.elements))

    def _rows(self, parts: list[tuple[Ints, Ints, Floats]], m: int) -> csr_array:
        rows, columns, values = [np.zeros(0, int)], [np.zeros(0, int)], [np.zeros(0)]
        for at, pressure, value in parts:
            row = np.repeat(at[:, None], pressure.shape[1], axis=1)
            there = pressure >= 0
            rows.append(row[there])
            columns.append(pressure[there])
            values.append(value[there])
        places = np.concatenate(rows), np.concatenate(columns)
        return csr_array(coo_array((np.concatenate(values), places), shape=(m, len(self))))
