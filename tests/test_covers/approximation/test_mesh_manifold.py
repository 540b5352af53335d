"""Manifolds on cut meshes against finite elements, exact polynomials and closed-form nullities."""

import numpy as np
import pytest

from covers.approximation.mesh_manifold import mesh_manifold
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Kinds, Monomials, RigidStrain
from covers.mathematical.bspline import BSplines
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats
from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.verification.problems.solids.special_cases import residue

from .manifolds import HOLED, SQUARE, bounds, distorted, model, triangles


def test_splines_reproduce_their_own_degree_more() -> None:
    cover = BSplines.regular(bounds(SQUARE), 0.4, angle=0.3)
    manifold = mesh_manifold(cover, cut(cover, SQUARE), Monomials(1))
    assert residue(manifold, 3) < 1e-9


def test_meshless_covers_reproduce_the_degree_of_basis_and_covers() -> None:
    cover = MovingLeastSquares.regular(bounds(SQUARE), 0.4, degree=1)
    manifold = mesh_manifold(cover, cut(cover, SQUARE), Monomials(1))
    assert residue(manifold, 2) < 1e-9


@pytest.mark.parametrize(
    "make",
    [
        lambda: triangles(0, 0.3, HOLED),
        lambda: triangles(2, 0.3, HOLED),
        distorted,
        lambda: mesh_manifold(
            c := MovingLeastSquares.regular(bounds(HOLED), 0.4, degree=1),
            cut(c, HOLED),
            Monomials(0),
        ),
        lambda: mesh_manifold(
            c := Triangles.regular(bounds(HOLED), 0.4), cut(c, HOLED), RigidStrain()
        ),
    ],
)
def test_rigid_modes_strain_nothing_and_move_points_rigidly(make) -> None:  # type: ignore[no-untyped-def]
    manifold = make()
    modes = manifold.rigid_modes
    stiffness = model(manifold).stiffness
    assert abs(stiffness @ modes).max() < 1e-12 * abs(stiffness).max()
    arm = manifold.elements.points - manifold.body_centroid[0]
    turned = np.stack([-arm[:, 1], arm[:, 0]], axis=1)
    found = manifold.vertex_rows.apply(modes[:, [2]].toarray().ravel())
    np.testing.assert_allclose(found, turned, atol=1e-12)


def test_degree_may_vary_from_cover_to_cover() -> None:
    cover = Triangles.regular(bounds(SQUARE), 0.25, angle=0.2)
    pieces = cut(cover, SQUARE)
    right = cover.patch_centre[pieces.cover_patch][:, 0] > 0.5
    kinds = Kinds((Monomials(0), Monomials(2)), right.astype(np.int64))
    manifold = mesh_manifold(cover, pieces, kinds)
    assert manifold.n_unknowns == 2 * (~right).sum() + 12 * right.sum()
    # Linear fields everywhere: what the lower degree reproduces.
    assert residue(manifold, 1) < 1e-11
    stiffness = model(manifold).stiffness
    assert abs(stiffness @ manifold.rigid_modes).max() < 1e-12 * abs(stiffness).max()


def test_degrees_may_vary_in_any_pattern_over_congruent_cells() -> None:
    cover = Triangles.regular(bounds(SQUARE), 0.12, angle=0.3, shift=(0.2, 0.4))
    pieces = cut(cover, SQUARE)
    away = np.hypot(*(cover.patch_centre[pieces.cover_patch] - 0.5).T)
    kinds = Kinds((Monomials(1), Monomials(2)), (away < 0.3).astype(np.int64))
    manifold = mesh_manifold(cover, pieces, kinds)
    assert sum(group.n_shapes for group in manifold.groups) < len(pieces.elements)
    # Covers of degree 1 and 2 stand at different corners of congruent cells.
    assert residue(manifold, 2) < 1e-10
    unknowns = np.random.default_rng(5).normal(size=manifold.n_unknowns)
    rule = polygon_rule(manifold.elements, 6)
    index, rows = manifold.gradient_rows(rule.owner, rule.points)
    g = np.einsum("mcjl,ml->mcj", rows, unknowns[index])
    strain = np.stack([g[:, 0, 0], g[:, 1, 1], g[:, 0, 1] + g[:, 1, 0]], axis=1)
    whole = model(manifold)
    density = np.einsum("mi,mij,mj->m", strain, whole.elasticity[rule.owner], strain)
    energy = unknowns @ (whole.stiffness @ unknowns)
    assert energy == pytest.approx(rule.weights @ density, rel=1e-10)


def effective_condition(matrix: Floats, null: int) -> float:
    scale = 1 / np.sqrt(matrix.diagonal())
    values = np.sort(np.abs(np.linalg.eigvalsh(matrix * scale * scale[:, None])))
    return float(values[-1] / values[null])


@pytest.mark.parametrize("degree", [0, 1, 2])
def test_conditioning_does_not_depend_on_the_cut_down_to_a_part_of_1e_12(degree: int) -> None:
    found = []
    for depth in (0.5, 1e-2, 1e-4, 1e-6, 1e-9, 1e-12):
        cover = Quads.regular([[0, 0], [2, 1]], 0.25)
        triangle = Triangles.from_mesh(_halved(cover))
        side = 1.0 + 0.25 * depth
        region = Polygons.from_vertices(
            [np.array([[0.0, 0.0], [side, 0.0], [side, 1.0], [0.0, 1.0]])]
        )
        manifold = mesh_manifold(triangle, cut(triangle, region), Monomials(degree))
        whole = model(manifold)
        matrix = (whole.stiffness + whole.mass).toarray()
        found.append(effective_condition(matrix, manifold.dependent))
    # Measured 159 (p = 0), 252 (p = 1), 2477 to 3106 (p = 2).
    assert max(found) < 4e3
    assert max(found) < 1.5 * min(found)


def _halved(cover: Quads):  # type: ignore[no-untyped-def]
    import skfem

    return skfem.MeshQuad(cover.vertices.T.copy(), cover.cell_vertices.T.copy()).to_meshtri()
