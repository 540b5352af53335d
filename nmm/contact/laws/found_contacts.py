"""Stiffness of the contacts that search finds, where their law prescribes one."""

from dataclasses import replace

import numpy as np

from integration.arrays import Floats, Ints
from nmm.contact.detection.surface import Surface
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.contact_points import ContactPoints


def sized(laws: ContactLaws, contacts: ContactPoints, surface: Surface) -> ContactPoints:
    """Return found contacts with the stiffness that their laws prescribe.

    A segment of a face counts with its length; a vertex counts with half the edge that faces the
    other body, or half of the other's edge if that is shorter, so that the two corners of a face
    that lies on a longer one carry all of it.
    """
    spring_factor = contacts.spring_factor.copy()
    for law, index in laws.stiff_laws(contacts):
        assert law.normal_stiffness is not None
        some = contacts.take(index)
        mere = _half_edge(surface, some.edge_a, some.edge_b)
        length = np.where(some.length > 0, some.length, mere)
        spring = law.normal_stiffness * length * laws.thickness
        spring_factor[index] = spring / laws.normal_penalty
    return replace(contacts, spring_factor=spring_factor)


def _half_edge(surface: Surface, vertex: Ints, edge: Ints) -> Floats:
    """Half the length (m,) of the edge at a vertex that faces ``edge``, or of that if shorter."""
    before, along = surface.previous[vertex], surface.direction[edge]
    faces = [np.einsum("ij,ij->i", surface.direction[own], along) for own in (vertex, before)]
    facing = np.where(faces[0] <= faces[1], vertex, before)
    return np.asarray(np.minimum(surface.length[facing], surface.length[edge]) / 2)
