"""Viscous dashpots along an edge, with the impedances of the ground beyond it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import bsr_array, csc_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.state import State

if TYPE_CHECKING:
    from nmm.scene.tables.shaking.boundaries import ViscousBoundaryTable


@dataclass(frozen=True)
class EdgeDashpots:
    """Dashpots at quadrature points of an edge; they turn with the material.

    Attributes
    ----------
    place
        The points.
    impedance
        (m, 2, 2) symmetric impedances: traction against a velocity (Pa s/m).
    area
        (m,) area of edge of each point (m2).
    """

    place: Place
    impedance: Floats
    area: Floats

    @classmethod
    def of(cls, model: Model, place: Place, ground: Floats | None = None) -> Self:
        """Return the dashpots of the material at the edge, or of impedances ``ground`` (2,)."""
        own = impedances(model, place) if ground is None else _of_ground(place, ground)
        return cls(place, own, place.weight * model.thickness)

    def tractions(self, velocity: Floats) -> Floats:
        """Tractions (m, 2) (Pa) of velocities (2,) or (m, 2) (m/s), in reference axes."""
        known = np.broadcast_to(velocity, (len(self.area), 2))
        return np.asarray(np.einsum("mij,mj->mi", self.impedance, known))

    def matrix(self, n: int) -> csc_array:
        """Damping matrix (n, n) (N s/m)."""
        rows = self.place.points.rows.matrix(n)
        blocks = self.area[:, None, None] * self.impedance
        m = len(self.area)
        each = bsr_array((blocks, np.arange(m), np.arange(m + 1)), shape=(2 * m, 2 * m))
        return csc_array(rows.T @ each @ rows)

    def push(self, state: State, traction: Floats) -> Floats:
        """Force (n,) on the unknowns of tractions (m, 2) in global axes (Pa)."""
        return self.place.points.push(state, self.area[:, None] * traction)

    def work(self, before: State, after: State, traction: Floats) -> float:
        """Work (J) of the mean tractions (m, 2) of a step (Pa)."""
        return self.place.points.work(before, after, self.area[:, None] * traction)


def impedances(model: Model, place: Place) -> Floats:
    """Impedances (m, 2, 2) of the material at points for plane waves along the normal (Pa s/m).

    The square root of density times Christoffel's matrix ``n C n``: density times P- and S-wave
    speed in isotropic material.
    """
    assert place.normal is not None
    x, y = place.normal.T
    zero = np.zeros_like(x)
    across = np.stack([np.stack([x, zero, y], axis=1), np.stack([zero, y, x], axis=1)], axis=1)
    density, elasticity = model.density[place.elements], model.elasticity[place.elements]
    square = density[:, None, None] * (across @ elasticity @ np.swapaxes(across, 1, 2))
    # The square root of a 2 x 2 matrix by the Cayley-Hamilton theorem.
    product = np.sqrt(np.linalg.det(square))
    trace = np.sqrt(np.trace(square, axis1=1, axis2=2) + 2 * product)
    weighs = np.where(trace > 0, trace, 1.0)[:, None, None]  # without density there is no wave
    return np.asarray((square + product[:, None, None] * np.eye(2)) / weighs)


def _of_ground(place: Place, ground: Floats) -> Floats:
    """Impedances (m, 2, 2) of isotropic ground of P- and S-wave impedances ``ground`` (2,)."""
    assert place.normal is not None
    normal = place.normal[:, :, None] * place.normal[:, None, :]
    return np.asarray(ground[1] * np.eye(2) + (ground[0] - ground[1]) * normal)


def ground_of(table: "ViscousBoundaryTable") -> Floats | None:
    """Impedances (2,) that a table gives (Pa s/m); None for those of the material."""
    if table.density is None:
        return None
    assert table.p_velocity is not None
    assert table.s_velocity is not None
    return table.density * np.array([table.p_velocity, table.s_velocity])
