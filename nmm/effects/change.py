"""A change of the model: from the old model to the new one, with the state carried over."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from covers.change.parentage import Parentage
from covers.change.transfer import Transfer
from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.given.setup import Setup

if TYPE_CHECKING:
    from nmm.effects.initial.kept_stress import KeptStress


@dataclass(frozen=True)
class Change:
    """A change of the model.

    Attributes
    ----------
    before
        Setup of the old model.
    setup
        Setup of the new model.
    parentage
        Parents of new elements, bodies, edges and covers.
    state
        The last state, transferred to the new model.
    former
        The last state on the old model.
    kept
        Stress kept by blocks whose material changes; None where none does.
    """

    before: Setup
    setup: Setup
    parentage: Parentage
    state: State
    former: State
    kept: "KeptStress | None" = None

    def field(self, displacement: Floats) -> Floats:
        """Transfer a displacement field (n,) of the old model to the unknowns of the new one."""
        transfer = Transfer.of(self.parentage, np.ones_like(self.old.density))
        return transfer.deformation(displacement, self.old.drained)

    @property
    def old(self) -> Model:
        """The old model."""
        return self.before.model

    @property
    def new(self) -> Model:
        """The new model."""
        return self.setup.model
