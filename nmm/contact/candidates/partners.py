"""Which points of the bodies may meet in a step, and which have gone through one another."""

import numpy as np

from integration.arrays import Floats, Ints
from integration.contraction import every, some
from nmm.assembly.kept import forget_kept, kept_of_place
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.contact.candidates.pairs import GLUED, MISSING, Pairs, no_interface
from nmm.contact.detection.contacts import Contacts
from nmm.contact.detection.crossing import Motion, crossings_in, motion_of, over_seams
from nmm.contact.detection.kinks import in_kinks
from nmm.contact.detection.narrow_phase import find_contacts, with_pairs
from nmm.contact.detection.neighbour_list import NeighbourList
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import DEPTH, FLUSH, SKIN
from nmm.contact.mortar.segments import faced
from nmm.contact.points.boundary_points import sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.cracks.welded import WeldedVertices
from nmm.contact.points.joint_book import JointBook
from nmm.errors import SceneError, SolveError


class Partners:
    """The search for contacts over the steps of a run: edges in place, neighbours, pairs that meet.

    Attributes
    ----------
    sides
        The boundary edges as they move with the unknowns.
    welded
        Where both faces of a crack are one; None where faces of one body never meet.

    Parameters
    ----------
    model
        Manifold and materials.
    pairs
        Which regions meet, by which interface.
    within_bodies
        Whether faces of one body may meet, as those of a crack.
    face_points
        Points a segment of faces that lie on each other; 0 where contact is at corners.
    whole_faces
        Whether such faces count beyond the reach of the search
        (`nmm.contact.mortar.segments.faced`).
    together
        (B,) a number that bodies share which cannot move apart; None where each goes alone.
    weight
        (B, 2) the acceleration that weight gives each body, 0 where supports hold it (m/s2).
    origin
        (2,) where the axes lie in those of the scene (m), for messages.
    """

    def __init__(
        self,
        model: Model,
        pairs: Pairs,
        within_bodies: bool,
        face_points: int,
        origin: Floats,
        whole_faces: bool = False,
        together: Ints | None = None,
        weight: Floats | None = None,
    ) -> None:
        self.sides = sides(model.manifold, together, weight)
        self.welded = WeldedVertices.of(model.cut.boundary, self.sides) if within_bodies else None
        self._pairs = pairs
        self._within_bodies, self._face_points = within_bodies, face_points
        self._origin, self._whole_faces = origin, whole_faces
        self._neighbours: NeighbourList | None = None
        boundary = model.manifold.boundary
        self._region = model.manifold.element_region[boundary.element]

    @property
    def at_corners(self) -> bool:
        """Whether bodies meet at corners, not over faces."""
        return not self._face_points

    def forget(self) -> None:
        """Drop the list of neighbours and the surfaces of states: kept for speed alone."""
        self._neighbours = None
        forget_kept(self)

    @kept_of_place
    def surface(self, state: State) -> Surface:
        """Return the edges in a state; those at the start and at the end of a step are kept."""
        return self.sides.moved(state.frames, state.deformation)

    def position(self, contacts: ContactPoints, state: State) -> Floats:
        """Return where contacts are (m, 2)."""
        return self.surface(state).at(contacts.edge_b, contacts.parameter_b)

    def interfaces(self, vertex: Ints, edge: Ints) -> Ints:
        """Index (m,) of the interface of a vertex and an edge; GLUED and MISSING are negative."""
        return self._pairs.interface(self._region[vertex], self._region[edge])

    def search(
        self,
        state: State,
        reach: float,
        step: float | None,
        book: JointBook,
        before: Contacts | None,
        crossed: tuple[Ints, Ints] | None = None,
    ) -> Contacts:
        """Find the contacts of a step, those of joints and of bodies that never meet among them.

        Parameters
        ----------
        reach
            No point moves further in the step (m).
        step
            Its length (s), None in statics: bodies in flight meet where they fly to.
        book, before
            Joints, whose contacts are theirs, and what the last accepted step found.
        crossed
            Vertex and edge (k,) of pairs that an answer to the step has let through each other:
            they are contacts too.
        """
        surface, motion = self.surface(state), self._flight(state, step)
        vertex, edge = self._near(surface, reach)
        found = find_contacts(surface, vertex, edge, reach, before, motion)
        if crossed is not None:
            found = with_pairs(surface, found, *crossed)
        if self._face_points:
            joints = book.carried(surface, self.sides.length)
            found = faced(surface, found, self._face_points, joints, self._whole_faces)
        if self.welded is None:
            return found
        apart = self.welded.apart(found)
        return found if apart.all() else found.take(apart)

    def _near(self, surface: Surface, reach: float) -> tuple[Ints, Ints]:
        """Return vertex and edge (m,) of pairs, all of those that may meet within the reach (m)."""
        if self._neighbours is None or self._neighbours.skin < 2 * reach:
            # Wider where that brings hardly any pairs: they are sought to a depth in any case.
            thinnest = float(surface.thickness.min()) if len(surface) else 0.0
            skin = max(4 * reach, SKIN * thinnest)
            self._neighbours = NeighbourList(skin, within_bodies=self._within_bodies)
        return self._neighbours.update(surface)

    def in_kinks(self, state: State, reach: float, book: JointBook) -> tuple[Ints, Ints]:
        """Return pairs in kinks of two bodies; see `nmm.contact.detection.kinks.in_kinks`."""
        surface = self.surface(state)
        return self._meeting(surface, in_kinks(surface, *self._near(surface, reach), reach), book)

    def _meeting(
        self, surface: Surface, pairs: tuple[Ints, Ints], book: JointBook
    ) -> tuple[Ints, Ints]:
        """Return those pairs that have an interface, and that no joint holds."""
        vertex, edge = pairs
        meet = (self.interfaces(vertex, edge) >= 0) & ~book.holds(surface, vertex, edge)
        return vertex[meet], edge[meet]

    def meeting(
        self, surface: Surface, found: Contacts, book: JointBook, first: bool
    ) -> tuple[Contacts, Ints]:
        """Return found contacts but for those of joints, and their interfaces (m,).

        Raises
        ------
        SceneError, SolveError
            Where bodies touch whose materials have no interface: at the ``first`` search, later.
        """
        interface = self.interfaces(found.vertex, found.edge)
        missing = (interface == MISSING) & (found.gap <= 0)
        if some(missing):
            x, y = surface.start[found.vertex[missing]][0] + self._origin
            raise (SceneError if first else SolveError)(no_interface(x, y))
        meets = (interface >= 0) & ~book.hides(found, len(surface))
        return (found, interface) if every(meets) else (found.take(meets), interface[meets])

    def motion(self, before: State, after: State) -> Motion:
        """Return the step last solved as the edges moved in it."""
        assert self._neighbours is not None
        start = self.surface(before)
        vertex, edge = self._neighbours.update(start)
        if self._pairs.glued:
            meets = self.interfaces(vertex, edge) != GLUED
            vertex, edge = vertex[meets], edge[meets]
        return motion_of(start, self.surface(after), (vertex, edge), FLUSH)

    def passage(self, motion: Motion, contacts: ContactPoints) -> str:
        """Say where a body went through another in a step; empty if none did.

        None did that slid over a seam on floors that are ``contacts`` of the step.
        """
        if motion.harmless or not len(found := crossings_in(motion, DEPTH)):
            return ""
        through = ~over_seams(found, motion, (contacts.edge_a, contacts.edge_b))
        if not some(through):
            return ""
        found, start = found.take(through), motion.before
        first = np.array([int(found.fraction.argmin())])
        x, y = start.start[found.vertex[first]][0] + self._origin
        if self.interfaces(found.vertex[first], found.edge[first])[0] == MISSING:
            return no_interface(x, y)
        return (
            f"the corner at [{x:.6g}, {y:.6g}] goes through an edge of another block after "
            f"{100 * found.free_fraction:.2g} % of the step, deeper than a tenth of the thinner "
            "block: shorten the step, or raise [contact] normal_penalty"
        )

    def _flight(self, state: State, step: float | None) -> Floats | None:
        """Return how far (n, 2) the vertices fly in a step; None where nothing does."""
        if step is None or not some(state.velocity):
            return None
        vertices = self.sides.start
        rate = state.frames.to_global(vertices.body, vertices.rows.apply(state.velocity))
        return np.asarray(step * rate)
