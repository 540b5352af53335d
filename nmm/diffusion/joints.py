"""Joints that conduct: edges shared by blocks or sub-blocks, and faces of cracks."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from covers.concatenate import some_of
from covers.cutting.cut_boundary import CutBoundary
from covers.scalar.space import ScalarSpace
from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.places import Place, on_edges
from nmm.constraints.ties.shared_edges import gauss_interface, shared_edges
from nmm.diffusion.edges import Edge
from nmm.diffusion.holding import jump, tied

Conductance = float | Literal["perfect"] | None
"""Flux for each unit of jump; "perfect" where the field is one, None where nothing passes."""


@dataclass(frozen=True)
class JointParts:
    """What joints are made from: functions, model, conductivity (E, 2, 2), degree of rules."""

    space: ScalarSpace
    model: Model
    conductivity: Floats

    @property
    def order(self) -> int:
        """Degree of polynomials to integrate along edges."""
        return 2 * self.model.manifold.degree + 2


def across_blocks(
    joining: JointParts, conductance: Callable[[int, int], Conductance], name: str
) -> Iterator[Edge]:
    """Yield the joints of edges that bodies share in the reference place.

    ``conductance`` says it of two regions; parts of one region are one field.
    """
    model = joining.model
    if model.manifold.n_bodies < 2:
        return
    joints = shared_edges(model)
    joints = joints.take(~crack_faces(model)[joints.edge_a])
    region, element = model.manifold.element_region, model.manifold.boundary.element
    pairs = np.stack([region[element[joints.edge_a]], region[element[joints.edge_b]]], axis=1)
    found: list[Conductance] = [None] * len(pairs)
    distinct, which = np.unique(pairs, axis=0, return_inverse=True)
    for number, (a, b) in enumerate(distinct.tolist()):  # pairs of regions that touch
        value = "perfect" if a == b else conductance(a, b)
        for joint in np.flatnonzero(which.ravel() == number).tolist():  # joints of the pair
            found[joint] = value
    open_to = np.array([value is not None for value in found], dtype=bool)
    if open_to.any():
        interface = gauss_interface(model, joints.take(open_to), joining.order)
        values = [value for value in found if value is not None]
        yield from _joined(joining, interface.sides, interface.first.piece, values, name)


def crack_faces(model: Model) -> Bools:
    """Return which edges (b,) of the boundary are faces of cracks."""
    boundary = model.cut.boundary
    if not isinstance(boundary, CutBoundary):
        return np.zeros(len(boundary), dtype=bool)
    return np.asarray(boundary.crack >= 0)


def across_cracks(
    joining: JointParts, conductance: Sequence[Conductance], name: str
) -> Iterator[Edge]:
    """Yield the joints of cracks that conduct; ``conductance`` of each crack of the cut."""
    boundary = joining.model.cut.boundary
    if all(value is None for value in conductance) or not isinstance(boundary, CutBoundary):
        return
    conducts = np.array([value is not None for value in conductance], dtype=bool)
    of_scene = (boundary.crack >= 0) & (boundary.crack < len(conducts))
    first = of_scene & (boundary.opposite > np.arange(len(boundary.opposite)))
    first[first] = conducts[boundary.crack[first]]
    if first.any():
        sides = _faces(joining, boundary, first)
        values = [conductance[number] for number in boundary.crack[first].tolist()]
        yield from _joined(joining, sides, sides[0].piece, values, name)


def _faces(joining: JointParts, boundary: CutBoundary, first: Bools) -> tuple[Place, Place]:
    """Gauss points of edges and the same points of the edges opposite."""
    manifold = joining.model.manifold
    one = on_edges(manifold, first, joining.order)
    assert one.piece is not None
    assert one.normal is not None
    elements = boundary.element[boundary.opposite[first]][one.piece]
    other = Place(one.points, elements, one.weight, one.position, -one.normal, one.piece)
    return one, other


def _joined(
    joining: JointParts,
    sides: Sequence[Place],
    piece: Ints | None,
    values: Sequence[Conductance],
    name: str,
) -> Iterator[Edge]:
    """Yield the conditions that join two sides: parts of edges with a conductance each."""
    assert piece is not None
    perfect = np.array([value == "perfect" for value in values])
    finite = np.array([0.0 if value in ("perfect", None) else float(value) for value in values])
    one = perfect[piece]
    if one.any():
        both = [some_of(side, one) for side in sides]
        yield tied(joining.space, joining.model, joining.conductivity, both, name)
    if not one.all():
        both = [some_of(side, ~one) for side in sides]
        area = both[0].weight * joining.model.thickness
        yield Edge(name, jump(joining.space, both), area, finite[piece][~one])
