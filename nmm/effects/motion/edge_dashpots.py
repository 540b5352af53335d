"""Dashpots along an edge: impedances of the ground beyond, and their matrix."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.assembly.places import Place

if TYPE_CHECKING:
    from nmm.scene.tables.shaking.boundaries import ViscousBoundaryTable


@dataclass(frozen=True)
class EdgeDashpots:
    """Dashpots on points of an edge; they turn with the material.

    Attributes
    ----------
    place
        The points.
    impedance
        (m, 2) density times speed of pressure and of shear waves (Pa s/m).
    area
        (m,) of edge that each point stands for (m2).
    """

    place: Place
    impedance: Floats
    area: Floats

    @classmethod
    def of(cls, model: Model, place: Place, ground: Floats | None = None) -> Self:
        """Return those of the material at the edge, or of a ``ground`` (2,) of other impedance."""
        own = impedances(model, place) if ground is None else np.tile(ground, (len(place), 1))
        return cls(place, own, place.weight * model.thickness)

    def tractions(self, velocity: Floats) -> Floats:
        """Tractions (m, 2) in Pa of velocities (2,) or (m, 2), in the reference place."""
        normal = self.place.normal
        assert normal is not None
        across = np.sum(normal * velocity, axis=1)[:, None] * normal
        along = velocity - across
        return np.asarray(self.impedance[:, :1] * across + self.impedance[:, 1:] * along)

    def matrix(self, n: int) -> csc_array:
        """Matrix (n, n) of the force against the velocity."""
        normal = self.place.normal
        assert normal is not None
        rows = self.place.points.rows.matrix(n)
        shear = diags_array(np.repeat(self.area * self.impedance[:, 1], 2))
        more = diags_array(self.area * (self.impedance[:, 0] - self.impedance[:, 1]))
        m = len(self.area)
        pick = csr_array(
            (normal.ravel(), (np.repeat(np.arange(m), 2), np.arange(2 * m))), shape=(m, 2 * m)
        )
        normals = csr_array(pick @ rows)
        return csc_array(rows.T @ shear @ rows + normals.T @ more @ normals)

    def push(self, state: State, traction: Floats) -> Floats:
        """Force (n,) on the unknowns of tractions (m, 2) in global axes."""
        return self.place.points.push(state, self.area[:, None] * traction)

    def work(self, before: State, after: State, traction: Floats) -> float:
        """Work (J) of tractions (m, 2) in Pa that are the mean of a step."""
        return self.place.points.work(before, after, self.area[:, None] * traction)


def impedances(model: Model, place: Place) -> Floats:
    """Density times the speeds of pressure and shear waves (m, 2) of the material at points."""
    density, elasticity = model.density[place.elements], model.elasticity[place.elements]
    return np.sqrt(density[:, None] * elasticity[:, [0, 2], [0, 2]])


def ground_of(table: "ViscousBoundaryTable") -> Floats | None:
    """Impedances (2,) of the ground beyond that a table gives (Pa s/m); None is the material's."""
    if table.density is None:
        return None
    assert table.p_velocity is not None
    assert table.s_velocity is not None
    return table.density * np.array([table.p_velocity, table.s_velocity])
