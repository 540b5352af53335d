"""How many functions depend on the others: counted by the singular values of their values."""

from collections.abc import Sequence

import numpy as np
import pytest
import skfem

from covers.approximation.dependence import _counted
from covers.approximation.manifold import Manifold
from covers.approximation.mesh_manifold import mesh_manifold
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Kinds, Monomials, Rigid, RigidStrain
from covers.mathematical.base import Cover
from covers.mathematical.bspline import BSplines
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons
from integration.rules import polygon_rule

BOUNDS = [[0.0, 0.0], [1.0, 1.0]]
SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
THROUGH = [[[0.5, -0.5], [0.45, 1.5]]]
ENDING = [[[0.5, -0.5], [0.52, 0.5]]]


def nullity(manifold: Manifold) -> int:
    """Singular values below 1e-9 of the largest, of normed functions at Gauss points."""
    rule = polygon_rule(manifold.elements, 14)
    rows = manifold.rows(rule.owner, rule.points).matrix(manifold.n_unknowns).toarray()
    rows *= np.repeat(np.sqrt(rule.weights), 2)[:, None]
    norm = np.linalg.norm(rows, axis=0)
    # Discs that no Gauss point lies in have functions of zeros.
    values = np.linalg.svd(rows / np.where(norm > 0, norm, 1.0), compute_uv=False)
    return int((values < 1e-9 * values[0]).sum()) + max(manifold.n_unknowns - len(values), 0)


def manifold_of(cover: Cover, degree: int, cracks: Sequence[list[list[float]]] = ()) -> Manifold:
    return mesh_manifold(cover, cut(cover, SQUARE, cracks), Monomials(degree))


@pytest.mark.parametrize("degree", [1, 2, 3])
@pytest.mark.parametrize(("cracks", "pieces"), [([], 1), (THROUGH, 2), (ENDING, 1)])
def test_triangles_have_p_p_plus_two_in_each_component_and_piece(
    degree: int, cracks: list[list[list[float]]], pieces: int
) -> None:
    cover = Triangles.regular(BOUNDS, 0.3, angle=0.4, shift=(0.21, 0.37))
    manifold = manifold_of(cover, degree, cracks)
    # 3, 8, 15 of each component: 6, 16, 30 of displacements in a piece.
    assert manifold.dependent == 2 * pieces * degree * (degree + 2) == nullity(manifold)


@pytest.mark.parametrize(("n", "linear", "quadratic"), [(2, 6, 17), (4, 10, 29), (6, 14, 41)])
def test_grids_have_more_the_finer_they_are(n: int, linear: int, quadratic: int) -> None:
    cover = Quads.regular(BOUNDS, 1 / n)
    # 2n + 2 and 6n + 5 of each component, found by singular values of n by n bilinear cells.
    assert manifold_of(cover, 1).dependent == 2 * linear
    assert manifold_of(cover, 2).dependent == 2 * quadratic


@pytest.mark.parametrize("degree", [1, 2, 3])
@pytest.mark.parametrize("cracks", [[], THROUGH, ENDING])
@pytest.mark.parametrize("angle", [0.0, 0.4])
def test_cut_grids_are_counted_by_lines_of_covers(
    degree: int, cracks: list[list[list[float]]], angle: float
) -> None:
    cover = Quads.regular(BOUNDS, 0.3, angle=angle, shift=(0.21, 0.37))
    manifold = manifold_of(cover, degree, cracks)
    assert manifold.dependent == nullity(manifold)


def distorted() -> Cover:
    mesh = skfem.MeshQuad.init_tensor(np.linspace(-0.1, 1.1, 5), np.linspace(-0.1, 1.1, 5))
    points = mesh.p.copy()
    points += 0.03 * np.random.default_rng(0).normal(size=points.shape)
    points[:, [0, 4, 20, 24]] = mesh.p[:, [0, 4, 20, 24]] * 1.3 - 0.15
    return Quads.from_mesh(skfem.MeshQuad(points, mesh.t))


@pytest.mark.parametrize(
    ("cover", "degree"),
    [
        (BSplines.regular(BOUNDS, 0.34, angle=0.3), 1),
        (BSplines.regular(BOUNDS, 0.34, angle=0.3), 2),
        (MovingLeastSquares.regular(BOUNDS, 0.34, angle=0.3), 1),
        (
            Quads.from_mesh(skfem.MeshQuad.init_tensor(np.linspace(0, 1, 4), np.linspace(0, 1, 4))),
            1,
        ),
        (distorted(), 1),
    ],
    ids=["splines1", "splines2", "mls", "parallelograms", "distorted"],
)
def test_other_covers_are_counted_by_their_gram_matrix(cover: Cover, degree: int) -> None:
    manifold = manifold_of(cover, degree)
    assert manifold.dependent == nullity(manifold)


@pytest.mark.parametrize("degrees", [(0, 1), (1, 2), (1, 3)])
@pytest.mark.parametrize("few", [1, 2, 5, 20])
def test_covers_of_lower_degree_hold_some_of_the_dependent_fields(
    degrees: tuple[int, int], few: int
) -> None:
    cover = Triangles.regular(BOUNDS, 0.3, angle=0.4, shift=(0.21, 0.37))
    pieces = cut(cover, SQUARE)
    away = np.hypot(*(cover.patch_centre[pieces.cover_patch] - 0.45).T)
    which = np.argsort(np.argsort(away)) >= few
    kinds = Kinds((Monomials(degrees[0]), Monomials(degrees[1])), which.astype(np.int64))
    manifold = mesh_manifold(cover, pieces, kinds)
    assert manifold.dependent == nullity(manifold)
    assert manifold.dependent == _counted(manifold.groups, manifold.n_unknowns)


def test_the_basis_of_blocks_depends_as_linear_monomials_do_and_rigid_motions_less() -> None:
    cover = Triangles.regular(BOUNDS, 0.3, angle=0.4)
    pieces = cut(cover, SQUARE)
    assert mesh_manifold(cover, pieces, RigidStrain()).dependent == 6
    rigid = mesh_manifold(cover, pieces, Rigid())
    assert rigid.dependent == nullity(rigid)


def test_finite_elements_are_independent() -> None:
    for kind in (Triangles, Quads, BSplines):
        assert manifold_of(kind.regular(BOUNDS, 0.3), 0).dependent == 0
