"""Contact rows at the middle of a step.

The exact rotation of a step moves a point of a body from ``x0`` to ``x1`` with

    x1 - x0 = R0 u + Rm (r (X + T qm)^perp + T dq) + O(r^3),

``u``, ``r`` the body's mean motion, ``dq`` the rest of the increment, ``Rm`` and ``qm`` half way.
Rows of this motion along the normal half way give the gap at the end to that order too, so that the
work of contact forces is what their springs store (Simo and Tarnow 1992; Laursen and Chawla 1997).
Both sides move as if the force acted at one point, that of side a, or in joints half way between
both sides: it makes no couple.
"""

import numpy as np

from integration.arrays import Floats
from integration.contraction import contract
from integration.plane_vectors import clockwise
from integration.sparse import csr_array
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.contact.points.between_faces import EdgeShares
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows, contact_rows
from nmm.contact.points.half_way.midpoint_kernel import add_turns
from nmm.frozen import with_parts


def body_projection(sides: Sides, model: Model) -> Floats:
    """Mean motions (B, 3, L) of bodies from the unknowns that rows of their points name.

    Rows that are filled up name an unknown twice: it counts once.
    """
    bodies, edge = np.unique(sides.start.body, return_index=True)
    unknowns = sides.start.rows.unknowns[edge]
    alike = unknowns[:, :, None] == unknowns[:, None, :]
    first = ~np.tril(alike, -1).any(axis=2)
    found = np.zeros((model.manifold.n_bodies, 3, unknowns.shape[1]))
    for kind in range(3):
        rows_of = np.broadcast_to(3 * bodies[:, None] + kind, unknowns.shape)
        found[bodies, kind] = first * csr_array(model.rigid_projection[rows_of, unknowns]).toarray()
    return found


def midpoint_rows(
    contacts: ContactPoints, sides: Sides, start: State, half: State, projection: Floats
) -> ContactRows:
    """Return the rows of contacts with both sides where they are half way.

    Every body must be one element: the rows of its points then hold all of its unknowns, and with
    their `body_projection` one compiled pass says what turning adds.
    """
    surface, edge = sides.moved(half.frames, half.deformation), contacts.edge_b
    shares = EdgeShares.of(contacts, sides.length)
    line = shares.along(contacts, surface)
    stretch = np.hypot(*line.T)[:, None]
    along = line / stretch
    direction = clockwise(along)
    side_a = sides.at(contacts.edge_a, contacts.parameter_a)
    place_a = side_a.place(half.frames, half.deformation)
    foot = contract("ij,ij->i", place_a - surface.start[edge], along) / surface.length[edge]
    parameter = np.where(contacts.is_joint, contacts.parameter_b, foot)
    side_b = sides.at(edge, parameter)
    apart = place_a - side_b.place(half.frames, half.deformation)

    def turn(normal: Floats, tangent: Floats) -> None:
        # How far apart sides are along tangent and normal: what lines that turn move.
        along = contract("ij,ij->i", apart, direction)
        levers = contract("ij,ij->i", apart, clockwise(direction)), along
        factors = (shares.a / stretch).ravel(), (shares.b / stretch).ravel()
        turns = sides.turns(contacts.edge_a), sides.turns(edge)
        bent = side_a.rows.apply(half.deformation), side_b.rows.apply(half.deformation)
        rotations = start.frames.rotation, half.frames.rotation
        given = direction, levers, factors, turns, (side_a.body, side_b.body), bent, rotations
        add_turns(normal, tangent, *given, projection)

    there = with_parts(contacts, normal=direction, parameter_b=parameter)
    return contact_rows(there, sides, half.frames, turn=turn)
