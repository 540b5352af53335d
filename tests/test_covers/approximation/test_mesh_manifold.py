"""Manifolds on cut meshes against finite elements, exact polynomials and closed-form nullities."""

from collections.abc import Callable

import numpy as np
import pytest

from covers.approximation.manifold import Manifold
from covers.approximation.mesh_manifold import mesh_manifold
from covers.approximation.uncut import uncut
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Kinds, Monomials, RigidStrain
from covers.mathematical.base import Cover
from covers.mathematical.bspline import BSplines
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats
from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.assembly.model import Model
from nmm.materials.elastic import Elastic
from nmm.verification.problems.solids.special_cases import net, residue

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
HOLED = Polygons.from_rings(
    [
        [
            [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.6], [0.0, 1.0]],
            [[0.9, 0.2], [1.2, 0.2], [1.2, 0.4], [0.9, 0.4]],
        ]
    ]
)
LAW = Elastic(1.0, 0.3)


def model(manifold: Manifold, plane: str = "stress") -> Model:
    n = len(manifold.elements)
    elasticity = np.broadcast_to(LAW.stiffness(plane), (n, 3, 3)).copy()
    return Model(
        manifold,
        elasticity,
        np.ones(n),
        np.ones(n),
        1.0,
        uncut(manifold),
    )


def triangles(degree: int, size: float = 0.3, regions: Polygons = SQUARE) -> Manifold:
    cover = Triangles.regular(_bounds(regions), size, angle=0.4, shift=(0.21, 0.37))
    return mesh_manifold(cover, cut(cover, regions), Monomials(degree))


def _bounds(regions: Polygons) -> Floats:
    return np.stack([regions.points.min(axis=0), regions.points.max(axis=0)])


def distorted() -> Manifold:
    cover = net("distorted quads")
    return mesh_manifold(cover, cut(cover, SQUARE), Monomials(1))


def test_splines_reproduce_their_own_degree_more() -> None:
    cover = BSplines.regular(_bounds(SQUARE), 0.4, angle=0.3)
    manifold = mesh_manifold(cover, cut(cover, SQUARE), Monomials(1))
    assert residue(manifold, 3) < 1e-9


def test_meshless_covers_reproduce_the_degree_of_basis_and_covers() -> None:
    cover = MovingLeastSquares.regular(_bounds(SQUARE), 0.4, degree=1)
    manifold = mesh_manifold(cover, cut(cover, SQUARE), Monomials(1))
    assert residue(manifold, 2) < 1e-9


def far(regions: Polygons, away: float) -> Polygons:
    return Polygons.from_vertices([regions.points + away])


@pytest.mark.parametrize(
    ("lay", "away", "within"),
    [
        (lambda box: Triangles.regular(box, 0.1, angle=0.4), 0.0, 1e-13),
        (lambda box: MovingLeastSquares.regular(box, 0.1, degree=0), 0.0, 1e-13),
        # Discs of two spacings just touch cells two away, or just do not: rounding says, and places
        # that are rounded to 1e-11 of 0.1 move no entry by more than some 1e-9.
        (lambda box: MovingLeastSquares.regular(box, 0.1, degree=1), 1e5, 1e-9),
    ],
)
def test_congruent_cells_share_their_integrals_and_give_the_same_matrices(
    lay: Callable[[Floats], Cover], away: float, within: float
) -> None:
    square = far(SQUARE, away)
    cover = lay(_bounds(square))
    pieces = cut(cover, square)
    manifold = mesh_manifold(cover, pieces, Monomials(1))
    group = manifold.groups[0]
    assert group.n_shapes < 0.6 * len(group.elements)
    object.__setattr__(cover, "cell_shape", np.full(len(cover.cell_shape), -1))
    alone = mesh_manifold(cover, pieces, Monomials(1))
    assert alone.groups[0].n_shapes == len(group.elements)
    for name in ("stiffness", "mass"):
        one, other = (getattr(model(item), name) for item in (manifold, alone))
        assert abs(one - other).max() < within * abs(other).max(), name


@pytest.mark.parametrize(
    "make",
    [
        lambda: triangles(0, 0.3, HOLED),
        lambda: triangles(2, 0.3, HOLED),
        distorted,
        lambda: mesh_manifold(
            c := MovingLeastSquares.regular(_bounds(HOLED), 0.4, degree=1),
            cut(c, HOLED),
            Monomials(0),
        ),
        lambda: mesh_manifold(
            c := Triangles.regular(_bounds(HOLED), 0.4), cut(c, HOLED), RigidStrain()
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


def test_gradients_are_differences_of_values_in_polynomial_and_quadrature_groups() -> None:
    for manifold in (triangles(2), distorted()):
        unknowns = np.random.default_rng(3).normal(size=manifold.n_unknowns)
        element = np.arange(0, len(manifold.elements), 5)
        point, step = manifold.elements.centroids[element], 1e-6
        index, rows = manifold.gradient_rows(element, point)
        gradient = np.einsum("mcjl,ml->mcj", rows, unknowns[index])
        for axis in range(2):
            way = step * np.eye(2)[axis]
            ahead = manifold.rows(element, point + way).apply(unknowns)
            behind = manifold.rows(element, point - way).apply(unknowns)
            difference = (ahead - behind) / (2 * step)
            # Truncation step^2 times third derivatives (about 1e2 / size^2) and rounding / step.
            np.testing.assert_allclose(gradient[:, :, axis], difference, rtol=1e-5, atol=1e-5)


def test_degree_may_vary_from_cover_to_cover() -> None:
    cover = Triangles.regular(_bounds(SQUARE), 0.25, angle=0.2)
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
    cover = Triangles.regular(_bounds(SQUARE), 0.12, angle=0.3, shift=(0.2, 0.4))
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
