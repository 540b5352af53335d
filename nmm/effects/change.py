"""From one model to the next: what a change hands to all that hold numbers of the old one."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from covers.change.parentage import Parentage
from covers.change.transfer import Transfer
from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.base import Setup

if TYPE_CHECKING:
    from nmm.effects.initial.changed_materials import KeptStress


@dataclass(frozen=True)
class Change:
    """What became of a model.

    Attributes
    ----------
    before
        What effects were built from, with the old model.
    setup
        What they are built from now, with the new one.
    parentage
        Which elements, bodies, edges and covers come from which.
    state
        The last state, carried over to the new model; its effects are built for it.
    former
        The same on the old model.
    kept
        The stress of blocks whose material is another; None where none is.
    """

    before: Setup
    setup: Setup
    parentage: Parentage
    state: State
    former: State
    kept: "KeptStress | None" = None

    def field(self, displacement: Floats) -> Floats:
        """Return a displacement field (n,) of the old model on the unknowns of the new one."""
        transfer = Transfer.of(self.parentage, np.ones_like(self.old.density))
        return transfer.deformation(displacement, self.old.drained)

    @property
    def old(self) -> Model:
        """The model so far."""
        return self.before.model

    @property
    def new(self) -> Model:
        """The model from now on."""
        return self.setup.model
