"""Rows half way: one compiled pass is what sparse sums and products say."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import csr_array, diags_array

import nmm
from covers.approximation.rows import row_matrix
from integration.plane_vectors import clockwise
from nmm.assembly.moving.motion import middle
from nmm.contact.points.contact_rows import contact_rows
from nmm.contact.points.half_way.midpoint import body_projection, midpoint_rows
from nmm.frozen import with_parts

TEXT = """
plane = "strain"
duration = "0.02 s"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = "2600 kg/m^3"
[interfaces.joint]
friction_angle = "20 deg"
[[blocks]]
name = "slope"
material = "rock"
vertices = [[0, 0], [5.196, 0], [5.196, 3]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[3.031, 1.75], [3.897, 2.25], [3.397, 3.116], [2.531, 2.616]]
[[supports]]
name = "ground"
block = "slope"
fix = ["x", "y"]
[gravity]
[inertia]
[contact]
[formulation]
integrator = { step = "5 ms" }
"""


def by_sparse_matrices(points, sides, model, start, half):
    """Normal and tangent rows, and what turning adds, by sparse sums and products."""
    body, edges = sides.start.body, (points.edge_a, points.edge_b)
    surface, n = sides.moved(half.frames, half.deformation), model.manifold.n_unknowns
    normal, along = surface.normal[edges[1]], surface.direction[edges[1]]
    side_a = sides.at(edges[0], points.parameter_a)
    place = side_a.place(half.frames, half.deformation)
    apart = place - surface.start[edges[1]]
    foot = np.einsum("ij,ij->i", apart, along) / surface.length[edges[1]]
    there = with_parts(points, normal=normal, parameter_b=foot)
    side_b = sides.at(edges[1], foot)
    apart = place - side_b.place(half.frames, half.deformation)
    local = half.frames.to_body(body[edges[1]], normal)
    turn = np.einsum("mcl,mc->ml", sides.turns(edges[1]), local)
    stretch = np.hypot(*(surface.end - surface.start).T)[edges[1]]
    turning = row_matrix(side_b.rows.unknowns, turn / stretch[:, None], n)
    rows, across = contact_rows(there, sides, half.frames), clockwise(normal)
    for part, axis, way in ((rows.normal, normal, across), (rows.tangent, across, -normal)):
        lever = np.einsum("ij,ij->i", apart, way)
        rigid = csr_array((len(points), 3 * model.manifold.n_bodies))
        for sign, side in ((1.0, side_a), (-1.0, side_b)):
            back, now = (at.frames.to_body(side.body, axis) for at in (start, half))
            bent = side.rows.apply(half.deformation)
            turned = now[:, 1] * bent[:, 0] - now[:, 0] * bent[:, 1]
            columns = 3 * side.body[:, None] + np.arange(3)
            values = sign * np.column_stack([back - now, turned])
            rigid = rigid + row_matrix(columns, values, rigid.shape[1])
        yield part + diags_array(lever) @ turning + rigid @ model.rigid_projection


@pytest.mark.parametrize("seed", [1, 2])
def test_one_pass_is_what_sparse_sums_and_products_say(seed):
    run = nmm.run(nmm.parse_scene(TEXT))
    contact, model, state = run.stepper.plan.contact, run.stepper.model, run.state
    sides, points = contact.partners.sides, contact.record.known
    draws = np.random.default_rng(seed)
    frames = replace(state.frames, angle=state.frames.angle + 0.1 * draws.normal(size=2))
    bent = state.deformation + 1e-3 * draws.normal(size=len(state.deformation))
    half = middle(state, with_parts(state, frames=frames, deformation=bent))
    plain = by_sparse_matrices(points, sides, model, state, half)
    quick = midpoint_rows(points, sides, state, half, body_projection(sides, model))
    assert len(points) > 1
    for one, other in zip(plain, (quick.normal, quick.tangent), strict=True):
        # both add the same dozen numbers of about one, in another order
        allowed = 1e-13 * np.abs(one.toarray()).max()
        np.testing.assert_allclose(other.toarray(), one.toarray(), rtol=0, atol=allowed)
