"""Glue: the edges that bodies share, and what a formulation holds them together by."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Floats, Ints
from integration.segments import segment_rule
from nmm.assembly.model import Model
from nmm.assembly.motion import initial_state, material_points
from nmm.constraints.linear_matter import check_linear, method_for
from nmm.constraints.multiplier_space import FacePieces, multipliers, traction_degree
from nmm.constraints.multiplier_ties import MultiplierGlue, independent
from nmm.constraints.nitsche_interface import averages
from nmm.constraints.ties import Tie, TiedPairs, TieSprings
from nmm.contact.detection.joints import Joints, find_joints
from nmm.contact.points.boundary_points import sides
from nmm.errors import FormulationError

if TYPE_CHECKING:
    from nmm.formulation import Glue

# Springs of glue in E / length of the longest edge that elements share: it opens by 1e-4 of that
# length under a strain of one. At 1e6 the traction along a cut interface oscillates by 10 %, at
# 1e4 by 1 %.
GLUE = 1e4
# Least degree of the work along a seam that is integrated exactly.
ORDER = 8


def shared_edges(model: Model) -> Joints:
    """Return the edges that bodies share in the reference place."""
    start = initial_state(model.manifold)
    return find_joints(sides(model.manifold).surface(start.frames, start.deformation))


def glue(
    model: Model, joints: Joints, method: "Glue", size: float | None
) -> tuple[list[Tie], MultiplierGlue | None]:
    """Return what holds edges together; ``size`` is that of a mesh's cells, None for blocks (m)."""
    kind = method_for(model, method.method, "spring")
    if kind == "spring":
        return [springs(model, joints, glue_stiffness(model, joints, method))], None
    if kind == "lagrange":
        return [], _multipliers(model, joints, size)
    return _averages(model, joints, method), None


def pairs_of(
    model: Model, joints: Joints, order: int = ORDER
) -> tuple[TiedPairs, Ints, Ints, Ints]:
    """Gauss points of joints, the elements on both sides and the joint of each point."""
    edges = model.manifold.boundary
    points, weight = segment_rule(joints.start, joints.end, order)
    q = weight.shape[1]
    flat = points.reshape(-1, 2)
    one = np.repeat(edges.element[joints.edge_a], q)
    two = np.repeat(edges.element[joints.edge_b], q)
    first = material_points(model.manifold, one, flat)
    second = material_points(model.manifold, two, flat)
    pairs = TiedPairs(
        first,
        second,
        np.repeat(joints.normal, q, axis=0),
        weight.ravel() * model.thickness,
    )
    return pairs, one, two, np.repeat(np.arange(len(joints)), q)


def springs(model: Model, joints: Joints, spring: Floats) -> TieSprings:
    """Springs of ``spring`` (j, 2), normal and shear, in Pa/m along edges."""
    pairs, _, _, joint = pairs_of(model, joints)
    return TieSprings(pairs, spring[joint])


def _averages(model: Model, joints: Joints, method: "Glue") -> list[Tie]:
    """Nitsche's terms, and springs where neither side has stress."""
    check_linear(model, "[glue] method", 'method = "spring"')
    order = max(ORDER, 2 * model.manifold.degree + 2)
    pairs, one, two, joint = pairs_of(model, joints, order)
    found, free = averages(model, pairs, (one, two), method.gamma)
    if not free.any():
        return [found]
    if method.method == "nitsche":
        x, y = joints.start[joint[free][0]]
        raise FormulationError(
            f'[glue] method: "nitsche": at [{x:.6g}, {y:.6g}] neither side has functions with '
            'strain: expected one: use method = "spring"'
        )
    spring = np.where(free[:, None], glue_stiffness(model, joints, method)[joint], 0.0)
    return [found, TieSprings(pairs, spring)]


def _multipliers(model: Model, joints: Joints, size: float | None) -> MultiplierGlue:
    pairs, _, _, joint = pairs_of(model, joints, max(ORDER, 2 * model.manifold.degree + 2))
    body = model.manifold.boundary.body
    a, b = body[joints.edge_a], body[joints.edge_b]
    turned = (a > b)[:, None]
    pieces = FacePieces(
        np.where(turned, joints.end, joints.start),
        np.where(turned, joints.start, joints.end),
        np.minimum(a, b) * model.manifold.n_bodies + np.maximum(a, b),
        joint,
        model.manifold.body_centroid[pairs.first.body] + pairs.first.arm,
        pairs.normal,
        pairs.weight,
    )
    # A block is one cell: each of its joints has multipliers of its own.
    cell = float(joints.length.sum()) if size is None else size
    basis = multipliers(pieces, cell, traction_degree(model), np.ones(2, dtype=bool))
    found = MultiplierGlue(pairs, basis)
    rows, _ = found.border(initial_state(model.manifold), model.manifold.n_unknowns)
    return replace(found, basis=csr_array(basis[:, independent(rows, _resistance(model))]))


def _resistance(model: Model) -> Floats:
    """Stiffness (n,) of each unknown, motions of whole bodies held by springs of their modulus."""
    area = model.manifold.body_area[model.manifold.element_body]
    held = replace(model, density=model.modulus / area).consistent_mass
    return np.asarray(model.stiffness.diagonal() + held.diagonal())


def glue_stiffness(model: Model, joints: Joints, method: "Glue") -> Floats:
    """Springs (j, 2) of glue in Pa/m."""
    element = model.manifold.boundary.element
    one, two = (model.modulus[element[edge]] for edge in (joints.edge_a, joints.edge_b))
    factor = GLUE if method.stiffness is None else method.stiffness
    found = factor * np.minimum(one, two) / joints.length.max(initial=0.0)
    return np.repeat(found[:, None], 2, axis=1)
