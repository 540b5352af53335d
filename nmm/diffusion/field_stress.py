"""The stress of a field: in every element a constant stress times the field.

Its force on the unknowns is integrated exactly; of a field richer than the strains of the elements
this is the force of its projection on them.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats, Ints
from nmm.assembly.kept import forget_kept, kept_of_object
from nmm.assembly.model import Model
from nmm.diffusion.matrices import element_means, stress_coupling


@dataclass(frozen=True)
class FieldStress:
    """What a field does to a model.

    Attributes
    ----------
    space, model
        Functions of the field, and what it acts on.
    stress
        (E, 3) stress that a unit of the field takes from the material (Pa).
    across
        (E,) of it across the plane; None where it is none (Pa).
    """

    space: ScalarSpace
    model: Model
    stress: Floats
    across: Floats | None = None
    _kept: dict[int, tuple[Floats, Ints, csr_array]] = field(default_factory=dict, repr=False)

    @cached_property
    def coupling(self) -> csr_array:
        """(n_unknowns, n) force (N) of the field's unknowns, in body axes."""
        return stress_coupling(self.space, self.model.thickness * self.stress)

    @cached_property
    def room(self) -> csr_array:
        """(n, n_unknowns) storage by the motion of the blocks: ``coupling`` transposed."""
        return csr_array(self.coupling.T)

    @kept_of_object
    def force(self, unknowns: Floats) -> Floats:
        """Force (n_unknowns,) of a field (n,), in body axes (N)."""
        return np.asarray(self.coupling @ unknowns)

    @kept_of_object
    def mean(self, unknowns: Floats) -> Floats:
        """Stress (E, 3) in body axes that it adds, mean of the elements (Pa)."""
        return np.asarray(-(self._means @ unknowns)[:, None] * self.stress)

    def mean_across(self, unknowns: Floats) -> Floats:
        """Stress across the plane (E,) that it adds, mean of the elements (Pa)."""
        across = np.zeros(len(self.stress)) if self.across is None else self.across
        return np.asarray(-(self._means @ unknowns) * across)

    def across_at(self, unknowns: Floats, elements: Ints, points: Floats) -> Floats:
        """Stress across the plane (m,) that it adds at reference points (Pa)."""
        across = np.zeros(len(self.stress)) if self.across is None else self.across
        return np.asarray(-(self._rows(elements, points) @ unknowns) * across[elements])

    def at(self, unknowns: Floats, elements: Ints, points: Floats) -> Floats:
        """Stress (m, 3) in body axes that it adds at reference points (Pa)."""
        rise = self._rows(elements, points) @ unknowns
        return np.asarray(-rise[:, None] * self.stress[elements])

    def units(self, elements: Ints, points: Floats) -> tuple[Floats, csr_array]:
        """Return the stress (m, 3) in body axes that a unit of the field adds at points (Pa).

        With the rows (m, n) of the field there.
        """
        return -self.stress[elements], self._rows(elements, points)

    def forget(self) -> None:
        """Drop what is kept for speed."""
        self._kept.clear()
        forget_kept(self)

    @cached_property
    def _means(self) -> csr_array:
        return element_means(self.space)

    def _rows(self, elements: Ints, points: Floats) -> csr_array:
        """Rows (m, n) at points; those of edges, which are asked for step by step, are kept."""
        kept = self._kept.get(id(points))
        if kept is None or kept[0] is not points or kept[1] is not elements:
            kept = self._kept[id(points)] = points, elements, self.space.values(elements, points)
        return kept[2]
