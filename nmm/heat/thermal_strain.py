"""The strain that a temperature makes, as a stress that the blocks would have if they were held.

A rise ``t`` strains free material by ``alpha t`` in all directions, in plane strain by
``(1 + nu) alpha t`` in the plane, for the third direction is held (Timoshenko and Goodier 1951).
Held, it has the stress ``- D strain``.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import numpy as np
from scipy.sparse import csc_array

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.stress_points import ISOTROPIC
from nmm.diffusion.field_stress import FieldStress
from nmm.diffusion.matrices import products


@dataclass(frozen=True)
class ThermalStrain(FieldStress):
    """What a temperature does to a model.

    Attributes
    ----------
    expansion
        (E,) strain in the plane for each kelvin (1/K).
    """

    expansion: Floats = field(kw_only=True)

    @classmethod
    def of(cls, space: ScalarSpace, model: Model, expansion: Floats) -> Self:
        """Make the stress of a strain (E,) for each kelvin."""
        stress = np.einsum("eij,ej->ei", model.elasticity, expansion[:, None] * ISOTROPIC)
        return cls(space, model, stress, expansion=expansion)

    @cached_property
    def held(self) -> csc_array:
        """(n, n) energy of material that is held: half the square of it in the temperature."""
        density = self.expansion * (self.stress @ ISOTROPIC)
        return products(self.space, self.model.thickness * density)
