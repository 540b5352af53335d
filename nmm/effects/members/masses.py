"""The effect: point masses on blocks."""

from dataclasses import replace
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array, diags_array

from integration.arrays import Floats
from nmm.assembly.applied_forces import AppliedForces
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.members.ends import MemberEnds, elements_at, nowhere
from nmm.errors import FormulationError, SceneError

if TYPE_CHECKING:
    from nmm.assembly.model import Model


class PointMasses(Effect):
    """Weight of all ``[[masses]]`` of a scene; their inertia is part of the model's mass."""

    name = "masses"
    external = False

    def __init__(self, ends: MemberEnds, weight: Floats) -> None:
        self._ends, self._weight = ends, weight

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[masses]]``."""
        gravity, ends = setup.scene.gravity, mass_ends(setup)
        down = np.zeros(2) if gravity is None else np.array(gravity.acceleration)
        return cls(ends, _masses(setup)[:, None] * down)

    @property
    def dead(self) -> bool:
        return True

    def force(self, state: State, end: Instant) -> Floats:
        """Return the load vector (n,) of the weights in the axes of the bodies."""
        rows = self._ends.points.rows
        local = self._ends.along(state.frames, self._weight)
        total = np.zeros(len(state.deformation))
        np.add.at(total, rows.unknowns.ravel(), local.ravel())
        return total

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: the weights."""
        return self._ends.pushed(self._weight)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the weights."""
        return float(np.sum(self._weight * (self._ends.way(after) - self._ends.way(before))))


def mass_ends(setup: Setup) -> MemberEnds:
    """Return the places of the ``[[masses]]`` of a scene.

    Raises
    ------
    SceneError
        A mass lies on no block.
    """
    masses = setup.scene.masses
    position = np.array([one.point for one in masses])
    elements = [
        elements_at(setup, position[at : at + 1], setup.regions(one.block))[0]
        for at, one in enumerate(masses)  # a handful of masses
    ]
    lost = [
        nowhere(setup, "masses", one.name, one.point, one.block)
        for one, element in zip(masses, elements, strict=True)
        if element < 0
    ]
    if lost:
        raise SceneError(*lost)
    return MemberEnds.at(setup, position, np.array(elements))


def _masses(setup: Setup) -> Floats:
    return np.array([one.mass for one in setup.scene.masses])


def loaded(setup: Setup) -> "Model":
    """Return the model of a setup with the ``[[masses]]`` of its scene in its mass matrix.

    Raises
    ------
    SceneError
        A mass lies on no block.
    FormulationError
        The mass is lumped and covers overlap.
    """
    model, manifold = setup.model, setup.model.manifold
    rows = mass_ends(setup).points.rows.matrix(manifold.n_unknowns)
    found = csc_array(rows.T @ diags_array(np.repeat(_masses(setup), 2)) @ rows)
    cover = manifold.unknown_cover
    row, column = found.nonzero()
    if model.lumped and (cover[row] != cover[column]).any():
        raise FormulationError(
            '[integrator] mass: "lumped" with [[masses]]: expected "consistent" where covers '
            "overlap: a mass at a point belongs to several of them"
        )
    return replace(model, point_mass=found)
