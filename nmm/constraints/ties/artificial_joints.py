"""Artificial joints (Ke 1996): permanent ties between the sub-blocks of a block.

Springs, or another method that glue may have. They act at points of the material, so that a uniform
traction stays uniform whatever the degree of the functions; there is no state and nothing to
iterate.
"""

from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.constraints.imposition import IMPOSITIONS, Imposition, Method
from nmm.constraints.interface import Interface
from nmm.constraints.laid_springs import laid_under_stress
from nmm.constraints.nitsche.linear_matter import check_linear
from nmm.constraints.springs import Springs
from nmm.constraints.ties.followed_ties import followed
from nmm.constraints.ties.shared_edges import corner_interface, gauss_interface, shared_edges
from nmm.constraints.ties.tied_interfaces import TiedInterfaces
from nmm.constraints.turned_axes import turning
from nmm.contact.detection.joints import Joints
from nmm.effects.acted.acted_faces import ActedFaces, Sides, mean_taken, shared_edge_parts
from nmm.effects.base import Setup
from nmm.errors import FormulationError
from nmm.geometry.tessellation.block_cover import PieceGlue
from nmm.geometry.tessellation.cover_types import piece_glue

if TYPE_CHECKING:
    from nmm.effects.change import Change


class ArtificialJoints(TiedInterfaces):
    """Bonds between all sub-blocks of one block, alike in normal and tangential direction."""

    name = "artificial joints"
    external = False
    loaded_twice = ""
    """Where loads act on both faces that Nitsche's terms glue, in words."""

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the options of the cover."""
        glue = piece_glue(setup.formulation.cover)
        assert glue is not None
        rule = setup.formulation.contact.joint_points
        reads_stress = glue.method is not None and IMPOSITIONS.load(glue.method).reads_stress
        faces = ActedFaces.of(setup) if reads_stress else None
        ties = cls.ties_of(setup.model, glue, rule, setup.start, faces)
        if setup.scene.initial_stresses:
            ties = laid_under_stress(setup, ties)
        made = cls(ties, setup.model.manifold.n_unknowns, turning(setup))
        if faces is not None:
            made.loaded_twice = faces.twice(_sides(setup.model, _within_blocks(setup.model)))
        return made

    @property
    def caution(self) -> str:
        """See `Effect.caution`: loads on both faces."""
        if not self.loaded_twice:
            return ""
        remedy = 'glue = "springs" in [cover.options]'
        return mean_taken(self.loaded_twice, "sub-blocks that Nitsche's terms glue", remedy)

    def follow(self, change: "Change") -> "ArtificialJoints":
        """Return those of the new model; a new block is glued free of stress where it lies.

        Springs that a change of material makes stiffer or softer exert what they did.
        """
        new, parents = type(self).from_setup(change.setup), change.parentage.elements.main
        keys = np.arange(len(change.old.manifold.elements)), parents
        new.jumps.ties = followed(self.ties, new.ties, change, keys)
        return new

    @staticmethod
    def ties_of(
        model: Model,
        glue: PieceGlue,
        joint_rule: str,
        start: State,
        faces: ActedFaces | None = None,
    ) -> list[Imposition]:
        """Find the joints, and return their ties.

        Parameters
        ----------
        glue
            What they are.
        joint_rule
            Where springs between linear fields act: "corners" (also "auto") or "gauss". Between
            fields that bend they act at as many Gauss points as their degree asks for.
        faces
            On which something else acts.
        """
        joints, degree = _within_blocks(model), model.manifold.degree
        if not len(joints):  # blocks that are not divided
            return []
        if glue.method is not None:
            if IMPOSITIONS.load(glue.method).reads_stress:
                check_linear(model, "[cover.options] glue", 'glue = "springs"')
            acted = None if faces is None else faces.beside(_sides(model, joints))
            interface = gauss_interface(model, joints, 2 * degree, acted)
            tie = Method(glue.method, None, degree).impose(model, [interface])[0]
            if tie.free.any():
                raise FormulationError(
                    f'[cover.options] glue: "{glue.method}": with functions without strain: '
                    'expected functions with strain: use glue = "springs"'
                )
            return [tie]
        if degree > 1 or joint_rule == "gauss":
            interface = gauss_interface(model, joints, 2 * max(degree, 1))
        else:
            interface = corner_interface(model, joints, start)
        return [Springs(interface, _spring(model, interface, glue.stiffness))]


def _within_blocks(model: Model) -> Joints:
    """Return the edges that sub-blocks of one block share."""
    region, edges = model.manifold.element_region, model.manifold.boundary
    joints = shared_edges(model)
    own = region[edges.element[joints.edge_a]] == region[edges.element[joints.edge_b]]
    return joints.take(own)


def _sides(model: Model, joints: Joints) -> Sides:
    return shared_edge_parts(model, joints.edge_a, joints.edge_b)


def _spring(model: Model, interface: Interface, stiffness: float) -> Floats:
    """Springs (m,) in N/m."""
    a, b = (side.elements for side in interface.sides)
    middle = model.manifold.elements.centroids
    assert interface.first.normal is not None
    apart = np.abs(np.sum((middle[a] - middle[b]) * interface.first.normal, axis=1))
    modulus = np.sqrt(model.modulus[a] * model.modulus[b])
    return np.asarray(stiffness * modulus / apart * interface.area)
