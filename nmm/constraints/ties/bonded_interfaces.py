"""Bonded interfaces in scenes without contact, tied for good.

Where the interface names its stiffness these are Goodman's joint elements (Goodman, Taylor and
Brekke 1968) along the edges that two blocks share. Where it names none they are glue, and the
formulation's ``[glue]`` says how it holds: by springs, by Nitsche's method or by multipliers. All
act at Gauss points of the shared edges, whatever the covers on either side.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Bools
from nmm.assembly.model import Model
from nmm.constraints.chosen_method import chosen
from nmm.constraints.imposition import Imposition, Method
from nmm.constraints.laid_springs import laid_under_stress
from nmm.constraints.springs import Springs, glue_stiffness, joint_springs
from nmm.constraints.ties.followed_ties import followed
from nmm.constraints.ties.shared_edges import (
    EDGE_ORDER,
    bonded_stiffness,
    gauss_interface,
    shared_edges,
)
from nmm.constraints.ties.tied_interfaces import TiedInterfaces
from nmm.constraints.turned_axes import turning
from nmm.contact.detection.joints import Joints
from nmm.effects.acted.acted_faces import (
    ActedFaces,
    mean_taken,
    shared_edge_parts,
    wet_faces,
)
from nmm.effects.base import Setup
from nmm.errors import FormulationError

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.formulation import Glue


# Cuts below which the terms of glue with weights that are no polynomials err: stress on slivers by
# 0.5 % at 1e-9 of a cell, 2 % at 1e-10, 12 % and more at 1e-12.
SLIVER = 1e-9


class BondedInterfaces(TiedInterfaces):
    """All bonded interfaces of a scene under a formulation."""

    name = "bonded interfaces"
    external = False
    least_cut = 1.0
    """Smallest element of those that Nitsche's terms glue with no polynomials, in largest ones."""
    loaded_twice = ""
    """Where loads act on both faces that Nitsche's terms glue, in words."""

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Find the edges that blocks with a bonded interface share."""
        model, part = setup.model, setup.formulation.glue
        joints, twice = shared_edges(model), ""
        spring, sprung, glued = bonded_stiffness(setup, joints)
        ties: list[Imposition] = []
        if sprung.any():
            interface = gauss_interface(model, joints.take(sprung))
            stiffness = spring[sprung][interface.first.piece]
            firm = glue_stiffness(model, interface, part.stiffness)[:, None]
            ties.append(joint_springs(interface, np.where(np.isnan(stiffness), firm, stiffness)))
        cover = setup.formulation.cover
        if glued.any():
            size = cover.finest if model.manifold.shared_covers else None
            glue, faces = joints.take(glued), ActedFaces.of(setup)
            sides = shared_edge_parts(model, glue.edge_a, glue.edge_b)
            ties += glue_edges(model, glue, part, size, faces.beside(sides))
            if any(tie.reads_stress for tie in ties):
                twice = faces.twice(sides) or wet_faces(setup)
        if setup.scene.initial_stresses:
            ties = laid_under_stress(setup, ties)
        made = cls(ties, model.manifold.n_unknowns, turning(setup))
        made.least_cut, made.loaded_twice = _least_cut(model, ties), twice
        return made

    def follow(self, change: "Change") -> "BondedInterfaces":
        """Return those of the new model; a new block is tied free of stress where it lies.

        Springs of glue that a change of material makes stiffer or softer exert what they did.
        """
        new = type(self).from_setup(change.setup)
        regions = change.old.manifold.element_region, change.new.manifold.element_region
        new.jumps.ties = followed(self.ties, new.ties, change, regions)
        return new

    @property
    def about(self) -> str:
        return super().about or "no shared edges"

    @property
    def caution(self) -> str:
        """See `Effect.caution`: loads on both faces, weights that are no polynomials on slivers."""
        told = []
        if self.loaded_twice:
            remedy = '[glue] method = "lagrange" or "spring"'
            told.append(mean_taken(self.loaded_twice, "glue by Nitsche's terms", remedy))
        if self.least_cut < SLIVER:
            told.append(
                f"Nitsche's glue on slivers of {self.least_cut:.1g} of the largest element, with "
                "weights that are no polynomials: stress there is off by 12 % and more; shift the "
                "net, or take another cover"
            )
        return "; ".join(told)


def _least_cut(model: Model, ties: Sequence[Imposition]) -> float:
    """Return `BondedInterfaces.least_cut`; 1 where traces are polynomials."""
    glued = [tie.interface.sides for tie in ties if tie.reads_stress]
    if model.manifold.trace_degree is not None or not glued:
        return 1.0
    area = model.element_area
    smallest = min(area[side.elements].min() for sides in glued for side in sides)
    return float(smallest / area.max())


def glue_edges(
    model: Model,
    joints: Joints,
    part: "Glue",
    size: float | None,
    acted: tuple[Bools, Bools] | None = None,
) -> list[Imposition]:
    """Return the ties of edges; ``size`` is that of a mesh's cells, None for blocks (m).

    Something else acts on faces that are ``acted`` (j,) on, for each side; None where nothing does.
    """
    degree, kind = model.manifold.degree, chosen(model, part.method, "spring")
    method = Method(kind, size, degree, part.stiffness, part.gamma)
    interface = gauss_interface(model, joints, max(EDGE_ORDER, 2 * degree + 2), acted)
    tie = method.impose(model, [interface])[0]
    free = tie.free
    if not free.any():
        return [tie]
    if part.method != "auto":
        x, y = interface.first.position[free][0]
        raise FormulationError(
            f'[glue] method: "{kind}": at [{x:.6g}, {y:.6g}] neither side has functions with '
            'strain: expected one: use method = "spring"'
        )
    stiffness = glue_stiffness(model, interface, part.stiffness) * interface.area
    return [tie, Springs(interface, np.where(free, stiffness, 0.0))]
