"""Artificial joints (Ke 1996): what holds the sub-blocks of a block together for good.

Springs, or Nitsche's terms. They act at points of the material, so that a uniform traction stays
uniform whatever the degree of the functions, and the forces are read from the whole opening and
sliding of each joint as it stands, so that nothing drifts over steps; there is no state and nothing
to iterate.
"""

from typing import Self

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats, Ints
from integration.polygons import centroids
from nmm.assembly.model import Model
from nmm.assembly.motion import State, material_points
from nmm.constraints.linear_matter import check_linear
from nmm.constraints.nitsche_interface import averages
from nmm.constraints.tied_interfaces import pairs_of, shared_edges
from nmm.constraints.ties import Tie, TiedPairs, TieSprings
from nmm.contact.detection.joints import Joints, joint_points
from nmm.contact.points.boundary_points import sides
from nmm.effects.base import Effect, Instant, Setup
from nmm.errors import FormulationError
from nmm.geometry.tessellation.sub_blocks import SubBlocks


class ArtificialJoints(Effect):
    """Bonds between all sub-blocks of one block, alike in normal and tangential direction."""

    name = "artificial joints"
    external = False

    def __init__(self, tie: Tie, n_unknowns: int) -> None:
        self.tie = tie
        self._n = n_unknowns
        self._stood: tuple[Floats, csc_array] | None = None  # at angles

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the options of the cover."""
        options = SubBlocks.of(setup.formulation.cover)
        stations = setup.formulation.contact.joint_points
        return cls.of(setup.model, options.glue, options.stiffness, stations, setup.start)

    @classmethod
    def of(cls, model: Model, glue: str, stiffness: float, stations: str, start: State) -> Self:
        """Find the joints.

        Parameters
        ----------
        glue
            "springs" or "nitsche".
        stiffness
            Of springs, in Young's moduli over the distance of the middles.
        stations
            Where springs between linear fields act: "corners" or "gauss". Between fields that bend
            they act at as many Gauss points as their degree asks for.
        """
        region, edges = model.manifold.element_region, model.manifold.boundary
        joints = shared_edges(model)
        own = region[edges.element[joints.edge_a]] == region[edges.element[joints.edge_b]]
        joints = joints.take(own)
        degree, n = model.manifold.degree, model.manifold.n_unknowns
        if glue == "nitsche" and len(joints.edge_a):  # blocks that are not divided have none
            check_linear(model, "[cover.options] glue", 'glue = "springs"')
            pairs, one, two, _ = pairs_of(model, joints, 2 * degree)
            tie, free = averages(model, pairs, (one, two))
            if free.any():
                raise FormulationError(
                    '[cover.options] glue: "nitsche": with functions without strain: expected '
                    'functions with strain: use glue = "springs"'
                )
            return cls(tie, n)
        spring = _spring(model, joints, stiffness)
        if degree > 1 or stations == "gauss":
            pairs, _, _, joint = pairs_of(model, joints, 2 * max(degree, 1))
        else:
            pairs, joint = _at_stations(model, joints, stations, start)
        return cls(TieSprings(pairs, np.repeat(spring[joint, None], 2, axis=1)), n)

    @property
    def about(self) -> str:
        """See `Effect.about`."""
        return self.tie.about

    def matrix(self, state: State) -> csc_array:
        """Stiffness of the joints, the same object as long as nothing turns."""
        if self._stood is None or not np.array_equal(self._stood[0], state.frames.angle):
            self._stood = state.frames.angle.copy(), self.tie.matrix(state, self._n)
        return self._stood[1]

    def forget(self) -> None:
        """See `Effect.forget`."""
        self._stood = None

    def force(self, state: State, end: Instant) -> Floats:
        """Forces of the joints as they stand."""
        return self.tie.force(state, self._n)

    def energy(self, state: State) -> float:
        """Energy stored in the joints (J)."""
        return self.tie.energy(state)

    def gap_volume(self, state: State, k: int) -> Floats:
        """See `Effect.gap_volume`."""
        return self.tie.gap_volume(state, k)


def _spring(model: Model, joints: Joints, stiffness: float) -> Floats:
    """Stiffness (j,) of joints in Pa/m."""
    element = model.manifold.boundary.element
    a, b = element[joints.edge_a], element[joints.edge_b]
    middle = centroids(model.manifold.elements)
    apart = np.abs(np.einsum("ij,ij->i", middle[a] - middle[b], joints.normal))
    return np.asarray(stiffness * np.sqrt(model.modulus[a] * model.modulus[b]) / apart)


def _at_stations(
    model: Model, joints: Joints, stations: str, start: State
) -> tuple[TiedPairs, Ints]:
    """Two points for each joint, at its corners or its Gauss points."""
    surface = sides(model.manifold).surface(start.frames, start.deformation)
    found = joint_points(surface, joints, stations)
    element = model.manifold.boundary.element
    first, second = (
        material_points(model.manifold, element[edge], found.position)
        for edge in (found.edge_a, found.edge_b)
    )
    weight = found.length * model.thickness
    return TiedPairs(first, second, found.normal, weight), found.joint
