"""The strain that a temperature makes, as a stress that the blocks would have if they were held.

A rise ``t`` strains free material by ``alpha t`` in all directions, in plane strain by
``(1 + nu) alpha t`` in the plane, for the third direction is held (Timoshenko and Goodier 1951).
Held, it has the stress ``- D strain``, whose force on the unknowns is integrated exactly; of a
temperature richer than the strains of the elements this is the force of its projection on them.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.sparse import csc_array, csr_array

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.diffusion.matrices import element_means, products, stress_coupling

EVEN = np.array([1.0, 1.0, 0.0])


@dataclass(frozen=True)
class ThermalStrain:
    """What a temperature does to a model.

    Attributes
    ----------
    space, model
        Functions of the temperature, and what it strains.
    expansion
        (E,) strain in the plane for each kelvin (1/K).
    """

    space: ScalarSpace
    model: Model
    expansion: Floats
    _kept: dict[int, tuple[Floats, Ints, csr_array]] = field(default_factory=dict, repr=False)

    @cached_property
    def stress(self) -> Floats:
        """(E, 3) stress that a rise of one kelvin takes from the material (Pa/K)."""
        strain = self.expansion[:, None] * EVEN
        return np.asarray(np.einsum("eij,ej->ei", self.model.elasticity, strain))

    @cached_property
    def coupling(self) -> csr_array:
        """(n_unknowns, n) force of the temperature's unknowns (N/K), in body axes."""
        return stress_coupling(self.space, self.model.thickness * self.stress)

    @cached_property
    def held(self) -> csc_array:
        """(n, n) energy of material that is held: half the square of it in the temperature."""
        density = self.expansion * (self.stress @ EVEN)
        return products(self.space, self.model.thickness * density)

    @cached_property
    def means(self) -> csr_array:
        """(E, n) mean rise of the elements."""
        return element_means(self.space)

    def at(self, unknowns: Floats, elements: Ints, points: Floats) -> Floats:
        """Stress (m, 3) in body axes that it adds at reference points (Pa)."""
        rise = self._rows(elements, points) @ unknowns
        return np.asarray(-rise[:, None] * self.stress[elements])

    def _rows(self, elements: Ints, points: Floats) -> csr_array:
        """Rows (m, n) at points; those of edges, which are asked for step by step, are kept."""
        kept = self._kept.get(id(points))
        if kept is None or kept[0] is not points or kept[1] is not elements:
            kept = self._kept[id(points)] = points, elements, self.space.values(elements, points)
        return kept[2]

    def forget(self) -> None:
        """Drop what is kept for speed."""
        self._kept.clear()
