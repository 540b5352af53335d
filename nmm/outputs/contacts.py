"""Quantities of contact points and of the faces of cracks."""

from collections.abc import Mapping

import numpy as np

from nmm.assembly.kept import kept_of_object
from nmm.assembly.model import Model
from nmm.contact.problem.contact_state import ContactState
from nmm.fracture.growth.faces import CrackFaces
from nmm.outputs.base import Output, View
from nmm.quantity import Quantity


class CrackOpening(Output):
    """Gap of broken bonds at contact points (m), zero where they hold or are closed.

    The widest of a step is that of these and of the faces of cracks, with contact or without.
    """

    def fields(self, view: View) -> Mapping[str, Quantity]:
        contacts = view.contacts
        if contacts is None:
            return {"crack_opening": Quantity("contacts", np.zeros(0), "m")}
        open_by = np.where(
            contacts.state == ContactState.BROKEN, np.maximum(contacts.gap, 0.0), 0.0
        )
        return {"crack_opening": Quantity("contacts", open_by, "m")}

    def history(self, view: View) -> Mapping[str, float]:
        """Return the widest opening (m)."""
        broken = self.fields(view)["crack_opening"].values.max(initial=0.0)
        faces = self._faces(view.model).widest(view.state).max(initial=0.0)
        return {"crack_opening": float(max(broken, faces))}

    @kept_of_object
    def _faces(self, model: Model) -> CrackFaces:
        return CrackFaces.of(model)
