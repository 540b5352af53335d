"""What slides in a step of statics that is corrected in the moved place: it slides on.

A correction hardly moves anything. Contacts that it finds anew, or that were open before, have slid
as far as their sides have moved along each other since the step began: friction is that of the way.
"""

import numpy as np

from integration.contraction import contract
from integration.plane_vectors import clockwise
from nmm.contact.detection.surface import Surface
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.continued.tracking import apart_on
from nmm.frozen import with_parts


def slid_since(points: ContactPoints, began: Surface, now: Surface) -> ContactPoints:
    """Return the found points of a correction with what those without force have slid.

    ``began`` and ``now`` are the edges where the step began and where they are.
    """
    free = (points.normal_force == 0) & (points.shear_force == 0)
    way = apart_on(now, points) - apart_on(began, points)
    along = contract("mi,mi->m", way, clockwise(points.normal))
    return with_parts(points, slid=np.where(free, along, points.slid))
