"""Loads and supports of a scene on a mesh of finite elements."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats, Ints
from nmm.errors import NmmError
from nmm.study.scikit_fem.solids import MeshedBody

if TYPE_CHECKING:
    from nmm.scene import Scene
    from nmm.scene.tables.loading.loads import LoadTable


def force_of(solid: MeshedBody) -> Floats:
    """Return the forces (n,) of all loads at full load (N)."""
    total = np.zeros(solid.basis.N)
    for one in _forces(solid):
        total += one
    return total


def _forces(solid: MeshedBody) -> Iterator[Floats]:
    """Yield the forces of each load and of the weight."""
    import skfem

    scene, basis = solid.scene, solid.basis
    degree = basis.elem.maxdeg
    inside = skfem.Basis(basis.mesh, basis.elem, intorder=degree) if _volume(scene) else None
    for density in _volume(scene):
        yield _constant(density, scene.thickness).assemble(inside)
    for load in scene.loads:
        if load.kind == "edge":
            assert load.segment is not None
            assert load.traction is not None
            facets = solid.facets(load.segment, load.name)
            edge = skfem.FacetBasis(basis.mesh, basis.elem, facets=facets, intorder=degree)
            yield _constant(load.traction, scene.thickness).assemble(edge)
        elif load.kind == "point":
            yield _at_node(solid, load)


def _volume(scene: "Scene") -> list[Sequence[float]]:
    """Forces on the volume (N/m3): body loads and weight."""
    found: list[Sequence[float]] = [one.density for one in scene.loads if one.density is not None]
    if scene.gravity is not None:
        density = scene.materials[scene.blocks[0].material].density or 0.0
        found.append([density * part for part in scene.gravity.acceleration])
    return found


def _constant(field: Sequence[float], thickness: float) -> Any:
    import skfem

    x, y = (thickness * part for part in field)
    return skfem.LinearForm(lambda v, w: x * v[0] + y * v[1])


def _at_node(solid: MeshedBody, load: "LoadTable") -> Floats:
    assert load.point is not None
    assert load.force is not None
    node = solid.node(load.point)
    if node is None:
        raise NmmError(
            f"scikit-fem: {load.name}: its point is no node: expected one on the outline"
        )
    force = np.zeros(solid.basis.N)
    force[solid.basis.nodal_dofs[:2, node]] = load.force
    return force


def fixed_unknowns(solid: MeshedBody) -> tuple[Ints, Floats]:
    """Return the unknowns that supports fix, and their values."""
    values: dict[int, float] = {}
    basis = solid.basis
    for support in solid.scene.supports:
        for axis in support.fix:
            number = "xy".index(axis)
            if support.segment is not None:
                dofs = basis.get_dofs(solid.facets(support.segment, support.name))
                found = dofs.all([name for name in basis.elem.dofnames if name[-1] == "12"[number]])
            else:
                assert support.point is not None
                if (node := solid.node(support.point)) is None:
                    raise NmmError(f"scikit-fem: {support.name}: its point is no node")
                found = basis.nodal_dofs[number : number + 1, node]
            values |= dict.fromkeys(found.tolist(), support.displacement[number])
    return np.array(list(values), dtype=np.int64), np.array(list(values.values()))
