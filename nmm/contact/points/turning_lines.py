"""What gaps and slips of joints gain as the lines between their faces turn.

With the unit normal ``n`` and tangent ``t`` of such a line and ``r`` from side b to side a, the
gap ``r . n`` changes by ``n . dr + (r . t) w`` and the slip ``r . t`` by
``t . dr - (r . n) w`` where the line turns by ``w``, from ``n`` to ``t``. Forces along these rows
act at one point half way between the sides: they make no couple, and their work is what springs
store.
"""

import numpy as np

from integration.arrays import Floats
from integration.plane_vectors import clockwise
from nmm.assembly.state import State
from nmm.contact.points.between_faces import EdgeShares, across
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import Turn
from nmm.contact.points.joint_points import JointSites


def line_turns(
    contacts: ContactPoints, sides: Sides, state: State, sites: JointSites | None
) -> Turn | None:
    """Return what adds it to normal and tangent rows (m, 2 L) of contacts; None without joints."""
    (at,) = contacts.is_joint.nonzero()
    if not len(at):
        return None
    joints, place = contacts.take(at), (state.frames, state.deformation)
    edges, width = (joints.edge_a, joints.edge_b), (sites or sides).table.unknowns.shape[1]
    shares, ends = EdgeShares.of(joints, sides.length), (sides.start, sides.end)
    starts, stops = ([end.take(edge).place(*place) for edge in edges] for end in ends)
    line = shares.a * (stops[0] - starts[0]) + shares.b * (stops[1] - starts[1])
    normal, stretch = across(line), np.hypot(*line.T)[:, None]
    turn = np.zeros((len(at), 2, width))
    for k, (edge, share) in enumerate(zip(edges, (shares.a, shares.b), strict=True)):
        # Rows of all edges may be wider than those of the joints' elements; the rest is empty.
        rows = sides.turns(edge)[:, :, :width]
        local = state.frames.to_body(sides.start.body[edge], normal)
        turn[:, k, : rows.shape[2]] = share / stretch * np.einsum("mcl,mc->ml", rows, local)
    if sites is None:
        one, other = (sides.at(*side).place(*place) for side in joints.sides)
        apart = np.asarray(one - other)
    else:
        apart = sites.apart(contacts, *place)[at] if sites.whole else sites.apart(joints, *place)
    levers = (np.einsum("ij,ij->i", apart, axis)[:, None] for axis in (clockwise(normal), -normal))
    gained = [lever * turn.reshape(len(at), -1) for lever in levers]

    def add(normal_rows: Floats, tangent_rows: Floats) -> None:
        normal_rows[at] += gained[0]
        tangent_rows[at] += gained[1]

    return add
