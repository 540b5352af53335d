"""How contact points move with the unknowns: rows, distances, and means over faces."""

from functools import cached_property, partial

import numpy as np

from integration.arrays import Floats
from integration.contraction import contract
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.contact.detection.surface import Surface
from nmm.contact.mortar.trace_space import TraceSpace
from nmm.contact.points.bent_faces import bent_normals
from nmm.contact.points.between_faces import JointFaces
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows, contact_rows
from nmm.contact.points.continued.tracking import apart_on
from nmm.contact.points.half_way.mean_motion import Forces
from nmm.contact.points.half_way.midpoint import body_projection, midpoint_rows
from nmm.contact.points.joint_points import JointSites
from nmm.contact.points.turning_lines import line_turns
from nmm.frozen import with_parts


class ContactGeometry:
    """Boundary points of a model as contact needs them.

    Attributes
    ----------
    joined
        Whether there are joints.

    Parameters
    ----------
    model, sides
        The manifold and its boundary edges.
    joints
        Contact points of joints at the start.
    bends
        Whether faces bend between their ends: contacts then act at points of the material.
    trace_space
        Multiplier space of exact constraints on faces; None where contact is at points.
    """

    def __init__(
        self,
        model: Model,
        sides: Sides,
        joints: ContactPoints,
        bends: bool,
        trace_space: TraceSpace | None,
    ) -> None:
        self.model, self.sides, self.bends = model, sides, bends
        self.trace_space = trace_space
        self.joined, self._sites = len(joints) > 0, JointSites.of(sides, joints)

    @property
    def curved(self) -> bool:
        """Whether any contact acts at a point of the material instead of on a chord."""
        return self.bends or self._sites is not None

    @property
    def conserves(self) -> bool:
        """Whether all contacts act on chords, or none: see `conserving`."""
        return self.bends or self._sites is None

    def rows(
        self,
        contacts: ContactPoints,
        state: State,
        midpoint: State | None = None,
        forces: Forces | None = None,
    ) -> ContactRows:
        """Return the rows of contacts in a state, or at the middle of a step.

        ``forces`` are what is known of them there; None: those that the contacts begin with.
        """
        if midpoint is not None and not self.model.of_blocks:
            from nmm.contact.points.half_way.turning_rows import turning_rows

            known = forces or (contacts.normal_force, contacts.shear_force)
            given = contacts, self.sides, self.model.rigid_projection, (state, midpoint), known
            return turning_rows(*given, self.bends)
        if midpoint is not None:
            return midpoint_rows(contacts, self.sides, state, midpoint, self._projection)
        sites = JointSites.at(self.sides, contacts) if self.bends else self._sites
        turn = line_turns(contacts, self.sides, state, sites)
        return contact_rows(contacts, self.sides, state.frames, sites, turn)

    @cached_property
    def _projection(self) -> Floats:
        return body_projection(self.sides, self.model)

    def conserving(self, contacts: ContactPoints, before: State, after: State) -> ContactRows:
        """Return the rows of contacts between two states of bodies whose axes do not turn."""
        from nmm.contact.points.conserving_rows import conserving_rows

        sites = JointSites.at(self.sides, contacts) if self.bends else None
        return conserving_rows(contacts, self.sides, (before, after), sites)

    def faces(self, state: State, surface: Surface) -> JointFaces:
        """Return the faces of joints in a state, and how far apart they are."""
        if self._sites is None:
            return JointFaces(surface, self.sides.length, partial(apart_on, surface))
        frames, bent = state.frames, state.deformation
        apart = partial(self._sites.apart, frames=frames, deformation=bent)
        return JointFaces(surface, self.sides.length, apart)

    def measured(self, points: ContactPoints, state: State) -> ContactPoints:
        """Return the found points with gaps and normals measured on the bent faces."""
        if not self.bends or not len(points):
            return points
        normal = bent_normals(self.sides, points, state)
        apart = JointSites.at(self.sides, points).apart(points, state.frames, state.deformation)
        return with_parts(points, normal=normal, gap=np.einsum("ij,ij->i", apart, normal))

    def gaps(self, points: ContactPoints, before: State, after: State, surface: Surface) -> Floats:
        """Return the gaps (m,) after a step, with the edges of ``surface``; normals turn along."""
        body = surface.body[points.edge_b]
        back = contract("mji,mj->mi", before.frames.rotation[body], points.normal)
        normal = contract("mij,mj->mi", after.frames.rotation[body], back)
        if self.bends:
            return self.measured(with_parts(points, normal=normal), after).gap
        return contract("mi,mi->m", apart_on(surface, points), normal)
