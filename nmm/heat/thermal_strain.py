"""The strain that a temperature makes, as a stress that the blocks would have if they were held.

A rise ``t`` strains free material by ``alpha t`` in all directions, and in plane strain by more in
the plane, ``(1 + nu) alpha t`` where it is alike in all (`nmm.materials.base.Law.free_strain`).
Held, it has the stress ``- D strain``.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats
from nmm.assembly.matter import Matter
from nmm.assembly.model import Model
from nmm.diffusion.field_stress import FieldStress
from nmm.diffusion.matrices import products


@dataclass(frozen=True)
class ThermalStrain(FieldStress):
    """What a temperature does to a model.

    Attributes
    ----------
    expansion
        (E, 3) strain in the plane for each kelvin (1/K); 0 where laws are not linear.
    points
        (Q, n) strain in all three directions, of a unit of the temperature's unknowns, at material
        points of laws that are not linear: they answer for what is left of the strain. None where
        there are none.
    """

    expansion: Floats = field(kw_only=True)
    points: csr_array | None = field(default=None, kw_only=True)

    @classmethod
    def of(cls, space: ScalarSpace, model: Model, expansion: Floats) -> Self:
        """Make it of a strain (E,) for each kelvin."""
        free = np.array([law.free_strain(model.plane) for law in model.laws])[model.law]
        points, plane, matter = None, expansion[:, None] * free, model.matter
        if isinstance(matter, Matter):
            rule = matter.points.rule
            rows = diags_array(expansion[rule.owner]) @ space.values(rule.owner, rule.points)
            points, plane = csr_array(rows), plane.copy()
            plane[rule.owner] = 0.0
        stress = np.einsum("eij,ej->ei", model.elasticity, plane)
        return cls(space, model, stress, expansion=plane, points=points)

    def swelling(self, unknowns: Floats) -> Floats | None:
        """Strain (Q,) of material points; see `Effect.swelling`."""
        return None if self.points is None else np.asarray(self.points @ unknowns)

    def energy(self, unknowns: Floats) -> float:
        """Energy (J) of a temperature (n,) in material that is held."""
        return float(unknowns @ (self.held @ unknowns)) / 2

    @cached_property
    def held(self) -> csc_array:
        """(n, n) of material that is held: half its square in the temperature is the energy."""
        density = (self.expansion * self.stress).sum(axis=1)
        return products(self.space, self.model.thickness * density)
