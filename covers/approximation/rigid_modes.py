"""The unknowns of rigid motions and of the uniform stretch of each body."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from covers.approximation.groups.physical_covers import PhysicalCovers
from covers.local_functions.polynomials import Kinds
from integration.arrays import Floats
from integration.plane_vectors import QUARTER_TURN
from integration.sparse import csc_array

STILL = np.zeros((2, 2))


@dataclass(frozen=True)
class LinearMotions:
    """Linear fields of whole bodies in the unknowns, found when they are first asked for.

    They are exact if all local functions contain linear fields, or if the weights reproduce linear
    fields from values at nodes.

    Attributes
    ----------
    kinds
        Local functions of each cover.
    covers, n_unknowns
        Physical covers and the number of their unknowns.
    body_centroid
        (B, 2) centroids of the bodies.
    nodes
        (C, 2) nodes of weights of linear precision, at which covers of any degree take the values
        of the field; None to represent the field in every cover.
    """

    kinds: Kinds
    covers: PhysicalCovers
    n_unknowns: int
    body_centroid: Floats
    nodes: Floats | None = None

    @cached_property
    def rigid(self) -> csc_array:
        """(n_unknowns, 3 B) translations and the linearised rotation about each centroid."""
        fields = [
            (np.array([1.0, 0.0]), STILL),
            (np.array([0.0, 1.0]), STILL),
            (np.zeros(2), QUARTER_TURN),
        ]
        return self._modes(fields)

    @cached_property
    def stretch(self) -> csc_array:
        """(n_unknowns, B) the field ``X - Xc`` of each body."""
        return self._modes([(np.zeros(2), np.eye(2))])

    def _modes(self, fields: list[tuple[Floats, Floats]]) -> csc_array:
        """Unknowns of linear fields ``value + gradient (X - Xc)`` of each body, a column each."""
        kinds, covers, nodes, each = self.kinds, self.covers, self.nodes, len(fields)
        total = csc_array((self.n_unknowns, each * len(self.body_centroid)))
        for number, item in enumerate(kinds.functions):  # a handful of kinds of covers
            index = np.flatnonzero(kinds.which == number)
            arm = (covers.centre if nodes is None else nodes)[index]
            arm = arm - self.body_centroid[covers.body[index]]
            constant = 1.0 if nodes is None else 0.0
            still = (len(index), 2, 2)
            unknowns = [
                item.linear_field(
                    value + arm @ gradient.T,
                    np.broadcast_to(constant * gradient, still),
                    covers.matrix[index],
                )
                for value, gradient in fields
            ]
            values = np.stack(unknowns, axis=2)
            rows = (covers.first_unknown[index, None] + np.arange(item.n_unknowns))[:, :, None]
            columns = each * covers.body[index, None, None] + np.arange(each)
            rows, columns = np.broadcast_arrays(rows, columns)
            part = (values.ravel(), (rows.ravel(), columns.ravel()))
            total = total + csc_array(part, shape=total.shape)
        return total
