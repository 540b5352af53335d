"""Thermal strain, as the stress of the fully constrained material.

A temperature rise ``t`` gives free material the strain ``alpha t`` in all directions; in plane
strain more in the plane, ``(1 + nu) alpha t`` if isotropic (`nmm.materials.base.Law.free_strain`).
Constrained, it has the stress ``- D strain``.
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
    """The thermal strain of a model.

    Attributes
    ----------
    expansion
        (E, 3) strain in the plane over temperature (1/K); 0 where laws are nonlinear.
    points
        (Q, n) isotropic strain at the material points of nonlinear laws for unit unknowns of the
        temperature, to be subtracted from the total strain; None without such laws.
    """

    expansion: Floats = field(kw_only=True)
    points: csr_array | None = field(default=None, kw_only=True)

    @classmethod
    def of(cls, space: ScalarSpace, model: Model, expansion: Floats) -> Self:
        """Return it for thermal expansions (E,) (1/K)."""
        free = np.array([law.free_strain(model.plane) for law in model.laws])[model.law]
        points, plane, matter = None, expansion[:, None] * free, model.matter
        if isinstance(matter, Matter):
            rule = matter.points.rule
            rows = diags_array(expansion[rule.owner]) @ space.values(rule.owner, rule.points)
            points, plane = csr_array(rows), plane.copy()
            plane[rule.owner] = 0.0
        stress = np.einsum("eij,ej->ei", model.elasticity, plane)
        across = np.einsum("ei,ei->e", model.across_share, stress)
        if model.plane == "strain":  # what is held across, too
            stiff = np.array([law.modulus_across for law in model.laws])[model.law]
            across += np.where(model.remembers, 0.0, stiff * expansion)
        return cls(space, model, stress, across, expansion=plane, points=points)

    def swelling(self, unknowns: Floats) -> Floats | None:
        """Isotropic strain (Q,) of material points; see `Effect.swelling`."""
        return None if self.points is None else np.asarray(self.points @ unknowns)

    def energy(self, unknowns: Floats) -> float:
        """Elastic energy (J) of a temperature (n,) in constrained material."""
        return float(unknowns @ (self._constrained @ unknowns)) / 2

    @cached_property
    def _constrained(self) -> csc_array:
        """(n, n) matrix of the energy of constrained material: half its quadratic form."""
        density = (self.expansion * self.stress).sum(axis=1)
        return products(self.space, self.model.thickness * density)
