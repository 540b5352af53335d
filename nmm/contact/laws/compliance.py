"""How soft the bodies of a contact are beside the stiffest of the scene."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from nmm.assembly.model import Model
from nmm.contact.points.contact_points import ContactPoints


@dataclass(frozen=True)
class Softness:
    """Young's moduli of the edges over the largest (-).

    Exact enforcements take the stiffness of a contact for a measure of the bodies there; that of
    the stiffest body of a scene says nothing of two that are 1e9 times softer.
    """

    share: Floats

    @classmethod
    def of(cls, model: Model) -> "Softness":
        """Measure the edges of a model."""
        modulus = model.modulus[model.manifold.boundary.element]
        return cls(modulus / model.modulus.max())

    def of_contacts(self, contacts: ContactPoints, own: Bools) -> Floats:
        """Return the share (m,) of the softer side; 1 where the stiffness is a law of its own."""
        softer = np.minimum(self.share[contacts.edge_a], self.share[contacts.edge_b])
        return np.where(own, 1.0, softer)
