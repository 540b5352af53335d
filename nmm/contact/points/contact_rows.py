"""How gap and slip of contact points change with the unknowns: a normal and a tangent row each."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from integration.sparse import csr_array
from nmm.assembly.state import Frames
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.half_way.mean_motion import MeanMotion
from nmm.contact.points.joint_points import JointSites
from nmm.contact.points.side_kernels import side_rows
from nmm.contact.problem.row_products import pushed
from nmm.solvers.unchecked import made_of

# Changes normal and tangent rows (m, 2 L), unknowns of side a before those of side b, in place.
Turn = Callable[[Floats, Floats], None]


@dataclass(frozen=True)
class ContactRows:
    """Rows of contacts: ``gap += N d``, ``slip += T d``.

    Attributes
    ----------
    normal, tangent
        (m, n), of the same sorted pattern.
    direction
        (m, 2) unit normals, from b to a.
    whole
        What rows have beside these, of bodies of many elements that turn; None elsewhere.
    """

    normal: csr_array
    tangent: csr_array
    direction: Floats
    whole: MeanMotion | None = None

    def push(self, normal: Floats, shear: Floats) -> Floats:
        """Return what forces (m,) of the contacts are on the unknowns (n,)."""
        near = pushed(self.normal, self.tangent, normal, shear)
        return near if self.whole is None else near + self.whole.push(normal, shear)


def contact_rows(
    contacts: ContactPoints,
    sides: Sides,
    frames: Frames,
    sites: JointSites | None = None,
    turn: Turn | None = None,
) -> ContactRows:
    """Return the rows of contacts along their normals; joints act at their ``sites``, or on chords.

    ``turn`` adds what comes of lines and bodies that turn.
    """
    table = sides.table if sites is None else sites.table
    columns, along_normal, along_tangent = side_rows(
        table,
        frames.rotation,
        (contacts.edge_a, contacts.edge_b) if sites is None else sites.rows_of(contacts),
        (contacts.parameter_a, contacts.parameter_b),
        contacts.normal,
    )
    if turn is not None:
        turn(along_normal, along_tangent)
    m, width = columns.shape
    offsets = np.arange(m + 1, dtype=np.int32) * np.int32(width)
    shape = (m, sides.manifold.n_unknowns)
    # Columns of their own: sorting changes them in place; offsets too where entries are summed.
    others = columns.flatten(), offsets.copy() if sides.repeats else offsets
    normal = made_of(csr_array, along_normal.ravel(), columns.ravel(), offsets, shape)
    tangent = made_of(csr_array, along_tangent.ravel(), *others, shape)
    if sides.repeats:
        for part in (normal, tangent):
            part.sum_duplicates()
    return ContactRows(normal, tangent, contacts.normal)
