"""Contacts that stand for a stretch of a face."""

from dataclasses import dataclass

from integration.arrays import Floats
from nmm.contact.detection.narrow_phase import Contacts


@dataclass(frozen=True, eq=False)
class FaceContacts(Contacts):
    """Contacts of which some stand for a stretch of a face.

    A point inside an overlap has the kind `FACE`, and ``vertex`` is the edge it lies on.

    Attributes
    ----------
    parameter_a
        (m,) place on the edge ``vertex``; 0 for a vertex.
    length
        (m,) of the stretch (m); 0 of a mere vertex.
    """

    parameter_a: Floats
    length: Floats
