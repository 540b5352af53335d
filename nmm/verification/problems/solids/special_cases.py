"""What manifolds are the same as: finite elements, blocks of DDA; polynomials they hold."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from covers.approximation.block_manifold import block_manifold
from covers.approximation.manifold import Manifold
from covers.approximation.mesh_manifold import mesh_manifold
from covers.approximation.uncut import uncut
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Monomials, RigidStrain
from covers.mathematical.base import Cover
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats
from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.assembly.model import Model
from nmm.assembly.places import on_edges
from nmm.materials.elastic import Elastic
from nmm.verification.base import Case, Check, Checks, limit

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
LAW = Elastic(1.0, 0.3)
ROUNDING = "rounding; the matrices are the same"


def model(manifold: Manifold) -> Model:
    """Return a manifold of unit density and thickness in plane stress."""
    n = len(manifold.elements)
    elasticity = np.broadcast_to(LAW.stiffness("stress"), (n, 3, 3)).copy()
    return Model(
        manifold,
        elasticity,
        np.ones(n),
        np.ones(n),
        1.0,
        uncut(manifold),
    )


def apart(ours: Any, theirs: Any) -> float:
    """Largest difference of two arrays over the largest entry."""
    return float(abs(ours - theirs).max() / abs(theirs).max())


class FiniteElements(Case):
    """Constant covers on a mesh that follows the body are finite elements, entry by entry."""

    name = "A0a"
    title = "Constant covers are finite elements"
    source = "Matrices of scikit-fem: linear triangles, bilinear rectangles"
    formulations = ("finite elements", "bilinear quads")

    def checks(self, formulation: str) -> Checks:
        import skfem
        from skfem.models.elasticity import linear_elasticity

        triangles = formulation == "finite elements"
        kind = skfem.MeshTri if triangles else skfem.MeshQuad
        mesh = kind.init_tensor(np.linspace(0, 1, 5), np.linspace(0, 1, 4))
        cover: Cover = Triangles.from_mesh(mesh) if triangles else Quads.from_mesh(mesh)
        ours = model(mesh_manifold(cover, cut(cover, SQUARE), Monomials(0)))
        element = skfem.ElementTriP1() if triangles else skfem.ElementQuad1()
        basis = skfem.Basis(mesh, skfem.ElementVector(element), intorder=6)
        d = LAW.stiffness("stress")
        stiffness = skfem.asm(linear_elasticity(d[0, 1], d[2, 2]), basis)
        mass = skfem.BilinearForm(lambda u, v, w: u[0] * v[0] + u[1] * v[1]).assemble(basis)
        load = skfem.LinearForm(lambda v, w: 2.0 * v[0] - 3.0 * v[1]).assemble(basis)
        force = ours.body_load(np.tile([2.0, -3.0], (len(ours.manifold.elements), 1)))
        return {
            "difference of stiffness": limit(apart(ours.stiffness, stiffness), 1e-12, ROUNDING),
            "difference of mass": limit(apart(ours.mass, mass), 1e-12, ROUNDING),
            "difference of load": limit(apart(force, load), 1e-12, ROUNDING),
        }


@dataclass(frozen=True)
class BlockBasis(Case):
    """One cover a block in the basis (u0, v0, r0, ex, ey, gxy) is DDA: Shi's own matrices."""

    name = "A0b"
    title = "One cover a block is DDA"
    source = "Shi (1988): stiffness A D, mass of S, Sxx, Syy, Sxy in closed form"
    shape: str = "rectangle"
    parameters: ClassVar = {"shape": ("rectangle", "triangle")}
    label = "{0.shape}"

    def checks(self, formulation: str) -> Checks:
        corners, moments = {
            "rectangle": ([[3, 1], [5, 1], [5, 2], [3, 2]], (2.0, 8 / 12, 2 / 12, 0.0)),
            # a^3 b / 36, a b^3 / 36, -a^2 b^2 / 72.
            "triangle": ([[0, 0], [3, 0], [0, 2]], (3.0, 54 / 36, 24 / 36, -36 / 72)),
        }[self.shape]
        polygons = Polygons.from_vertices([np.array(corners, dtype=float)])
        manifold = block_manifold(polygons, np.zeros(1, dtype=np.int64), RigidStrain())
        d = Elastic(10.0, 0.25).stiffness("stress")
        ours = Model(
            manifold,
            d[None],
            np.array([2.0]),
            np.array([10.0]),
            0.5,
            uncut(manifold),
        )
        stiffness = np.zeros((6, 6))
        stiffness[3:, 3:] = 0.5 * moments[0] * d
        found = ours.stiffness.toarray(), ours.mass.toarray()
        return {
            "difference of stiffness": limit(apart(found[0], stiffness), 1e-12, ROUNDING),
            "difference of mass": limit(apart(found[1], shi_mass(*moments)), 1e-12, ROUNDING),
        }


def shi_mass(s: float, sxx: float, syy: float, sxy: float) -> Floats:
    """Mass matrix of a block about its centroid, density times thickness 1 (Shi 1988)."""
    half = np.zeros((6, 6))
    half[0, 0] = half[1, 1] = s
    half[2, 2], half[2, 3], half[2, 4], half[2, 5] = sxx + syy, -sxy, sxy, (sxx - syy) / 2
    half[3, 3], half[3, 5], half[4, 4], half[4, 5] = sxx, sxy / 2, syy, sxy / 2
    half[5, 5] = (sxx + syy) / 4
    return half + np.triu(half, 1).T


@dataclass(frozen=True)
class Reproduction(Case):
    """Covers of degree p times hats hold all polynomials of degree p + 1, and not p + 2.

    They are fitted at points of a cut mesh; what is left over is the error.
    """

    name = "A0c"
    title = "Polynomials that covers hold"
    source = "Hats hold x times what the covers hold; counted by degree"
    formulations = ("triangles", "quads", "distorted quads")
    degree: int = 1
    parameters: ClassVar = {"degree": range(4)}
    label = "degree {0.degree}"

    @property
    def slow(self) -> bool:
        """Dense least squares of a thousand unknowns."""
        return self.degree > 2

    def checks(self, formulation: str) -> Checks:
        """Fit monomials of the next two degrees."""
        cover = net(formulation)
        manifold = mesh_manifold(cover, cut(cover, SQUARE), Monomials(self.degree))
        held, beyond = self.degree + 1, self.degree + 2
        reason = "a cubic residue of cells of 0.4 is above 1e-5, rounding below 1e-10"
        return {
            f"error of degree {held}": limit(residue(manifold, held), 1e-10, reason),
            f"error of degree {beyond}": Check(
                residue(manifold, beyond), 1e-5, 0.0, reason, bound="at_least"
            ),
        }


def net(kind: str) -> Cover:
    """Return a mesh over the unit square that follows none of its edges."""
    if kind == "triangles":
        return Triangles.regular([[0, 0], [1, 1]], 0.45, angle=0.4, shift=(0.21, 0.37))
    if kind == "quads":
        return Quads.regular([[0, 0], [1, 1]], 0.4, angle=0.3, shift=(0.2, 0.1))
    import skfem

    mesh = skfem.MeshQuad.init_tensor(np.linspace(-0.1, 1.1, 5), np.linspace(-0.1, 1.1, 5))
    points = mesh.p.copy()
    inner = (np.abs(points - 0.5) < 0.59).all(axis=0)
    points[:, inner] += 0.05 * np.random.default_rng(0).uniform(-1, 1, (2, inner.sum()))
    return Quads.from_mesh(skfem.MeshQuad(points, mesh.t))


def residue(manifold: Manifold, degree: int) -> float:
    """Largest error at points when all monomials of a degree are fitted by the unknowns."""
    rule = polygon_rule(manifold.elements, 6)
    matrix = manifold.rows(rule.owner, rule.points).matrix(manifold.n_unknowns).toarray()[0::2]
    powers = [(a, degree - a) for a in range(degree + 1)]
    targets = np.stack([rule.points[:, 0] ** a * rule.points[:, 1] ** b for a, b in powers], 1)
    scale = 1 / np.maximum(np.abs(matrix).max(axis=0), 1e-300)
    fit = np.linalg.lstsq(matrix * scale, targets, rcond=1e-13)[0]
    return float(np.abs(matrix * scale @ fit - targets).max())


class Bound(Case):
    """Linear covers on triangles are a part of quadratic finite elements on the same mesh.

    So a body held without give may never yield more to its load.
    """

    name = "A0d"
    title = "Compliance below that of quadratic finite elements"
    source = "Quadratic triangles of scikit-fem on the same mesh"
    formulations = ("manifold",)

    def checks(self, formulation: str) -> Checks:
        import skfem

        mesh = skfem.MeshTri.init_tensor(np.linspace(0, 1, 5), np.linspace(0, 1, 5))
        theirs = quadratic_compliance(mesh)
        cover = Triangles.from_mesh(mesh)
        ours = held_compliance(model(mesh_manifold(cover, cut(cover, SQUARE), Monomials(1))))
        reason = "the bound, with rounding; and that it is not void"
        return {
            "compliance over theirs": limit(ours / theirs, 1 + 1e-10, reason),
            "compliance over theirs, from below": Check(
                ours / theirs, 0.9, 0.0, reason, bound="at_least"
            ),
        }


def quadratic_compliance(mesh: Any) -> float:
    """Work of a unit body force along y on quadratic finite elements held at x = 0."""
    import skfem
    from skfem.models.elasticity import linear_elasticity

    d = LAW.stiffness("stress")
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTriP2()), intorder=4)
    stiffness = skfem.asm(linear_elasticity(d[0, 1], d[2, 2]), basis)
    load = skfem.LinearForm(lambda v, w: v[1]).assemble(basis)
    fixed = basis.get_dofs(lambda x: x[0] < 1e-9)
    return float(load @ skfem.solve(*skfem.condense(stiffness, load, D=fixed)))


def held_compliance(held: Model) -> float:
    """Work of the same force on a manifold whose displacements are zero at x = 0.

    They are so at as many points of an edge as a quadratic needs: the null space of their rows.
    """
    manifold = held.manifold
    edges = manifold.boundary
    place = on_edges(manifold, (edges.start + edges.end)[:, 0] < 1e-9, 4)
    rows = place.points.rows.matrix(manifold.n_unknowns).toarray()
    _, size, right = np.linalg.svd(rows)
    null = right[int((size > 1e-10 * size[0]).sum()) :].T
    force = null.T @ held.body_load(np.tile([0.0, 1.0], (len(manifold.elements), 1)))
    reduced = null.T @ (held.stiffness @ null)
    return float(force @ np.linalg.lstsq(reduced, force, rcond=1e-12)[0])
