"""Quantities of contact points."""

from collections.abc import Mapping

import numpy as np

from nmm.contact.problem.contact_state import ContactState
from nmm.outputs.base import Output, View
from nmm.quantity import Quantity


class CrackOpening(Output):
    """Gap of broken bonds at contact points (m); zero where they hold or are closed."""

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
        widest = self.fields(view)["crack_opening"].values.max(initial=0.0)
        return {"crack_opening": float(widest)}
