"""References of the study: energies by graded finite elements of degree 4, without nmm.

``python examples/studies/references.py`` prints each energy for degrees 3 and 4 and its change;
meshes are refined 30 times towards singular points (6 times towards the corners of the polygon
that stands for a circle), then once everywhere. The scenes carry the
values as ``[[reference]]``.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from skfem import (
    Basis,
    ElementTriP3,
    ElementTriP4,
    ElementVector,
    FacetBasis,
    LinearForm,
    MeshTri,
    condense,
    solve,
)
from skfem.models.elasticity import lame_parameters, linear_elasticity

Where = Callable[[Any], Any]
TIMES = 30


def energy(
    mesh: MeshTri,
    degree: int,
    *,
    modulus: float,
    ratio: float,
    plane: str,
    held: Sequence[tuple[Where, str]],
    loaded: Where,
    traction: tuple[float, float],
    pinned: tuple[float, float] | None = None,
) -> float:
    """Elastic energy of a body of thickness 1.

    ``held`` gives places and their fixed axes; a node at ``pinned`` is held in x.
    """
    element = ElementVector({3: ElementTriP3, 4: ElementTriP4}[degree]())
    basis = Basis(mesh, element)
    first, second = lame_parameters(modulus, ratio)
    if plane == "stress":
        first = 2 * first * second / (first + 2 * second)
    stiffness = linear_elasticity(first, second).assemble(basis)
    edge = FacetBasis(mesh, element, facets=mesh.facets_satisfying(loaded, boundaries_only=True))
    pull = LinearForm(lambda v, w: traction[0] * v[0] + traction[1] * v[1])
    force = pull.assemble(edge)
    fixed = [
        basis.get_dofs(mesh.facets_satisfying(where, boundaries_only=True)).all(
            [name for name in element.dofnames if name[-1] == "12"["xy".index(axis)]]
        )
        for where, axes in held
        for axis in axes
    ]
    if pinned is not None:
        node = np.hypot(*(mesh.p - np.array(pinned)[:, None])).argmin()
        fixed.append(basis.nodal_dofs[:1, node])
    moved = solve(*condense(stiffness, force, D=np.unique(np.concatenate(fixed))))
    return float(moved @ force) / 2


def graded(mesh: MeshTri, points: Sequence[tuple[float, float]], times: int = TIMES) -> MeshTri:
    """Refine what touches the points, again and again, then everything once."""
    for _ in range(times):
        near = [np.hypot(*(mesh.p - np.array(at)[:, None])).argmin() for at in points]
        mesh = mesh.refined(np.flatnonzero(np.isin(mesh.t, near).any(axis=0)))
    return mesh.refined(1)


def cantilever(degree: int) -> float:
    """Beam of 48 x 12, clamped, shear of 1000 in all at its end."""
    mesh = MeshTri.init_tensor(np.linspace(0, 48, 17), np.linspace(-6, 6, 5))
    return energy(
        graded(mesh, [(0, -6), (0, 6)]),
        degree,
        modulus=3e7,
        ratio=0.3,
        plane="stress",
        held=[(lambda x: x[0] < 1e-9, "xy")],
        loaded=lambda x: x[0] > 48 - 1e-9,
        traction=(0, 1000 / 12),
    )


def lshape(degree: int) -> float:
    """Quarter of a cross that is pulled along x."""
    mesh = MeshTri.init_tensor(np.linspace(0, 2, 9), np.linspace(0, 2, 9))
    outside = np.flatnonzero((mesh.p[:, mesh.t].mean(axis=1) > 1).all(axis=0))
    return energy(
        graded(mesh.remove_elements(outside), [(1, 1)]),
        degree,
        modulus=1.0,
        ratio=0.3,
        plane="strain",
        held=[(lambda x: x[0] < 1e-9, "x"), (lambda x: x[1] < 1e-9, "y")],
        loaded=lambda x: x[0] > 2 - 1e-9,
        traction=(1, 0),
    )


def plate_with_hole(degree: int) -> float:
    """Quarter of a plate of 8 x 8 with a hole of radius 1, a polygon of 96 sides."""
    angle = np.linspace(0, np.pi / 2, 25)
    inner = np.stack([np.cos(angle), np.sin(angle)])
    outer = 4 * inner / np.abs(inner).max(axis=0)
    unit = MeshTri.init_tensor(np.arange(25.0), np.linspace(0, 1, 9) ** 1.6)
    at, far = np.round(unit.p[0]).astype(int), unit.p[1]
    mesh = MeshTri(inner[:, at] * (1 - far) + outer[:, at] * far, unit.t)
    return energy(
        # The corners of the polygon are almost straight: few refinements hold them.
        graded(mesh, list(zip(*inner[:, 1:-1], strict=True)), times=6),
        degree,
        modulus=1000.0,
        ratio=0.3,
        plane="stress",
        held=[(lambda x: x[0] < 1e-9, "x"), (lambda x: x[1] < 1e-9, "y")],
        loaded=lambda x: x[0] > 4 - 1e-9,
        traction=(1, 0),
    )


def edge_crack(degree: int) -> float:
    """Plate of 1 x 2 with a crack to its middle: the upper half, held on the ligament."""
    mesh = graded(MeshTri.init_tensor(np.linspace(0, 1, 9), np.linspace(0, 1, 9)), [(0.5, 0)])
    side = energy(
        mesh,
        degree,
        modulus=1.0,
        ratio=0.3,
        plane="strain",
        held=[(lambda x: (x[1] < 1e-12) & (x[0] > 0.5 - 1e-12), "y")],
        loaded=lambda x: x[1] > 1 - 1e-9,
        traction=(0, 1),
        pinned=(1, 0),
    )
    return 2 * side


CASES = (cantilever, lshape, plate_with_hole, edge_crack)


def main() -> dict[str, tuple[float, float]]:
    """Return each energy and its relative change from degree 3 to 4."""
    found = {}
    for case in CASES:
        third, fourth = case(3), case(4)
        found[case.__name__] = fourth, abs(third / fourth - 1)
    return found


if __name__ == "__main__":
    for name, (value, change) in main().items():
        print(f"{name}: {value:.9g}, degree 3 differs by {change:.1e}")
