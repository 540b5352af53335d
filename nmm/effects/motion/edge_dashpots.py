"""Dashpots along an edge: impedances of the ground beyond, and their matrix."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import bsr_array, csc_array

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
        (m, 2, 2) traction against a velocity, symmetric (Pa s/m).
    area
        (m,) of edge that each point stands for (m2).
    """

    place: Place
    impedance: Floats
    area: Floats

    @classmethod
    def of(cls, model: Model, place: Place, ground: Floats | None = None) -> Self:
        """Return those of the material at the edge, or of a ``ground`` (2,) of other impedance."""
        own = impedances(model, place) if ground is None else _of_ground(place, ground)
        return cls(place, own, place.weight * model.thickness)

    def tractions(self, velocity: Floats) -> Floats:
        """Tractions (m, 2) in Pa of velocities (2,) or (m, 2), in the reference place."""
        known = np.broadcast_to(velocity, (len(self.area), 2))
        return np.asarray(np.einsum("mij,mj->mi", self.impedance, known))

    def matrix(self, n: int) -> csc_array:
        """Matrix (n, n) of the force against the velocity."""
        rows = self.place.points.rows.matrix(n)
        blocks = self.area[:, None, None] * self.impedance
        m = len(self.area)
        each = bsr_array((blocks, np.arange(m), np.arange(m + 1)), shape=(2 * m, 2 * m))
        return csc_array(rows.T @ each @ rows)

    def push(self, state: State, traction: Floats) -> Floats:
        """Force (n,) on the unknowns of tractions (m, 2) in global axes."""
        return self.place.points.push(state, self.area[:, None] * traction)

    def work(self, before: State, after: State, traction: Floats) -> float:
        """Work (J) of tractions (m, 2) in Pa that are the mean of a step."""
        return self.place.points.work(before, after, self.area[:, None] * traction)


def impedances(model: Model, place: Place) -> Floats:
    """Impedances (m, 2, 2) of the material at points against plane waves along the normal.

    The root of density times ``n C n``, Christoffel's matrix: density times the speeds of pressure
    and shear waves in matter alike in all directions, in other matter those of its own waves.
    """
    assert place.normal is not None
    x, y = place.normal.T
    zero = np.zeros_like(x)
    across = np.stack([np.stack([x, zero, y], axis=1), np.stack([zero, y, x], axis=1)], axis=1)
    density, elasticity = model.density[place.elements], model.elasticity[place.elements]
    square = density[:, None, None] * (across @ elasticity @ np.swapaxes(across, 1, 2))
    # The root of a matrix of two rows, by Cayley and Hamilton.
    product = np.sqrt(np.linalg.det(square))
    trace = np.sqrt(np.trace(square, axis1=1, axis2=2) + 2 * product)
    weighs = np.where(trace > 0, trace, 1.0)[:, None, None]  # without density there is no wave
    return np.asarray((square + product[:, None, None] * np.eye(2)) / weighs)


def _of_ground(place: Place, ground: Floats) -> Floats:
    """Impedances (m, 2, 2) of ground whose pressure and shear waves have those of ``ground``."""
    assert place.normal is not None
    normal = place.normal[:, :, None] * place.normal[:, None, :]
    return np.asarray(ground[1] * np.eye(2) + (ground[0] - ground[1]) * normal)


def ground_of(table: "ViscousBoundaryTable") -> Floats | None:
    """Impedances (2,) of the ground beyond that a table gives (Pa s/m); None is the material's."""
    if table.density is None:
        return None
    assert table.p_velocity is not None
    assert table.s_velocity is not None
    return table.density * np.array([table.p_velocity, table.s_velocity])
