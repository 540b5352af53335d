"""Contact rows at the middle of a step.

The exact rotation of a step moves a point of a body from ``x0`` to ``x1`` with

    x1 - x0 = R0 u + Rm (r (X + T qm)^perp + T dq) + O(r^3),

``u``, ``r`` the body's mean motion, ``dq`` the rest of the increment, ``Rm`` and ``qm`` half way.
Rows of this motion along the normal half way give the gap at the end to that order too, so that the
work of contact forces is what their springs store (Simo and Tarnow 1992; Laursen and Chawla 1997).
Both sides move as if the force acted at one point, that of side a, or in joints half way between
both sides: it makes no couple.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array, diags_array

from covers.approximation.rows import row_matrix
from integration.arrays import Floats, Ints
from integration.contraction import contract
from nmm.assembly.model import Model
from nmm.assembly.motion import MaterialPoints, State
from nmm.contact.points.between_faces import EdgeShares
from nmm.contact.points.boundary_points import Sides, tangents
from nmm.contact.points.contact_points import ContactPoints, rows
from nmm.contact.points.midpoint_kernel import add_turns
from nmm.contact.problem.row_products import pushed
from nmm.frozen import with_parts


@dataclass(frozen=True)
class ContactRows:
    """How gap and slip change with the unknowns.

    Attributes
    ----------
    normal, tangent
        (m, n).
    direction
        (m, 2) unit normals, from b to a.
    """

    normal: csr_array
    tangent: csr_array
    direction: Floats

    def push(self, normal: Floats, shear: Floats) -> Floats:
        """Return what forces (m,) of the contacts are on the unknowns (n,)."""
        return pushed(self.normal, self.tangent, normal, shear)


def body_projection(sides: Sides, model: Model) -> Floats | None:
    """Mean motions (B, 3, L) of bodies from the unknowns that rows of their points name.

    None where one row may name an unknown twice.
    """
    if sides.repeats:
        return None
    bodies, edge = np.unique(sides.start.body, return_index=True)
    unknowns = sides.start.rows.unknowns[edge]
    found = np.zeros((model.manifold.n_bodies, 3, unknowns.shape[1]))
    for kind in range(3):
        rows_of = np.broadcast_to(3 * bodies[:, None] + kind, unknowns.shape)
        found[bodies, kind] = csr_array(model.rigid_projection[rows_of, unknowns]).toarray()
    return found


def midpoint_rows(
    contacts: ContactPoints,
    sides: Sides,
    model: Model,
    start: State,
    half: State,
    projection: Floats | None = None,
) -> ContactRows:
    """Return the rows of contacts with both sides where they are half way.

    Every body must be one element: the rows of its points then hold all of its unknowns. With
    their `body_projection` one compiled pass takes the place of sparse sums and products.
    """
    contacts, points = _half_way(contacts, sides, half)
    parts = rows(contacts, sides, half.frames, model.manifold.n_unknowns)
    if projection is None:
        one, other = _turned_plainly(parts, points, model, start, half)
        return ContactRows(one, other, points.direction)
    normal, tangent = parts
    m, (side_a, side_b) = len(contacts), points.points
    add_turns(
        normal.data.reshape(m, -1),
        tangent.data.reshape(m, -1),
        points.direction,
        points.levers,
        points.factors,
        points.turns,
        (side_a.body, side_b.body),
        (side_a.rows.apply(half.deformation), side_b.rows.apply(half.deformation)),
        (start.frames.rotation, half.frames.rotation),
        projection,
    )
    return ContactRows(normal, tangent, points.direction)


@dataclass(frozen=True)
class _HalfWay:
    """Contact points half way through a step.

    Attributes
    ----------
    direction
        (m, 2) normals.
    factors
        (m,) what edges of sides a and b add to the line between faces, over its length (1/m).
    apart
        (m, 2) from side b to side a (m).
    turns
        (m, 2, L) rows of the ends of the edges of both sides less those of their starts.
    points
        Both sides.
    """

    direction: Floats
    factors: tuple[Floats, Floats]
    apart: Floats
    turns: tuple[Floats, Floats]
    points: tuple[MaterialPoints, MaterialPoints]

    @property
    def levers(self) -> tuple[Floats, Floats]:
        """How far (m,) apart sides are along tangent and normal: what lines that turn move (m)."""
        across = tangents(self.direction)
        one, other = (contract("ij,ij->i", self.apart, way) for way in (across, self.direction))
        return one, other


def _half_way(contacts: ContactPoints, sides: Sides, half: State) -> tuple[ContactPoints, _HalfWay]:
    """Contacts with their normals and feet half way, and where their points are."""
    surface, edge = sides.moved(half.frames, half.deformation), contacts.edge_b
    shares = EdgeShares.of(contacts, sides.length)
    line = shares.along(contacts, surface)
    stretch = np.hypot(*line.T)[:, None]
    along = line / stretch
    direction = tangents(along)
    side_a = sides.at(contacts.edge_a, contacts.parameter_a)
    place_a = side_a.place(half.frames, half.deformation)
    foot = contract("ij,ij->i", place_a - surface.start[edge], along) / surface.length[edge]
    parameter = np.where(contacts.is_joint, contacts.parameter_b, foot)
    side_b = sides.at(edge, parameter)
    apart = place_a - side_b.place(half.frames, half.deformation)
    factors = (shares.a / stretch).ravel(), (shares.b / stretch).ravel()
    turns = sides.turns(contacts.edge_a), sides.turns(edge)
    there = with_parts(contacts, normal=direction, parameter_b=parameter)
    return there, _HalfWay(direction, factors, apart, turns, (side_a, side_b))


def _turned_plainly(
    parts: tuple[csr_array, csr_array], at: _HalfWay, model: Model, start: State, half: State
) -> list[csr_array]:
    """Rows with what turning adds, by sparse matrices."""
    side_a, side_b = at.points
    turning = csr_array((len(at.direction), model.manifold.n_unknowns))
    for side, factor, turn in zip(at.points, at.factors, at.turns, strict=True):
        local = half.frames.to_body(side.body, at.direction)
        along = factor[:, None] * contract("mcl,mc->ml", turn, local)
        turning = turning + row_matrix(side.rows.unknowns, along, model.manifold.n_unknowns)
    across, found = tangents(at.direction), []
    one, other = at.levers
    for part, axis, lever in zip(parts, (at.direction, across), (one, -other), strict=True):
        rigid = _rigid_shift(side_a.body, axis, side_a.rows.apply(half.deformation), start, half)
        rigid = rigid - _rigid_shift(
            side_b.body, axis, side_b.rows.apply(half.deformation), start, half
        )
        whole = part + diags_array(lever) @ turning + rigid @ model.rigid_projection
        found.append(csr_array(whole))
    return found


def _rigid_shift(body: Ints, axis: Floats, bent: Floats, start: State, half: State) -> csr_array:
    """Rows (m, 3 B): what mean motions do beyond the rows in the axes half way."""
    back = start.frames.to_body(body, axis)
    now = half.frames.to_body(body, axis)
    turned = now[:, 1] * bent[:, 0] - now[:, 0] * bent[:, 1]
    values = np.column_stack([back - now, turned])
    return row_matrix(3 * body[:, None] + np.arange(3), values, 3 * len(half.frames.angle))
