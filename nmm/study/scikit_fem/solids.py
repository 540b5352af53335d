"""Scenes that finite elements solve: one elastic body, and its mesh."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.errors import NmmError
from nmm.formulation import Formulation

if TYPE_CHECKING:
    from nmm.scene import Scene

DEGREES = (1, 2, 3, 4)
NEAR = 1e-9  # of the body's extent: what lies on a segment


@dataclass(frozen=True)
class MeshedBody:
    """Elements of a scene's body.

    Attributes
    ----------
    scene
        What is solved.
    basis
        Vector elements of scikit-fem.
    unit
        Distance within which a point lies on a line (m).
    """

    scene: "Scene"
    basis: Any
    unit: float

    def facets(self, segment: Sequence[Sequence[float]], what: str) -> Ints:
        """Return the facets of the boundary on a segment."""
        mesh = self.basis.mesh
        edge = mesh.boundary_facets()
        start, end = np.asarray(segment, dtype=float)
        on = np.ones(len(edge), dtype=bool)
        for node in mesh.facets[:, edge]:
            on &= self._on(mesh.p[:, node].T, start, end)
        if not on.any():
            raise NmmError(f"scikit-fem: {what}: no edge of the body lies on its segment")
        return np.asarray(edge[on])

    def node(self, point: Sequence[float]) -> int | None:
        """Return the node at a point, None when there is none."""
        off = np.hypot(*(self.basis.mesh.p.T - np.asarray(point)).T)
        return int(off.argmin()) if off.min() < self.unit else None

    def _on(self, points: Floats, start: Floats, end: Floats) -> Bools:
        way = end - start
        along = np.clip((points - start) @ way / (way @ way), 0, 1)
        return np.asarray(np.hypot(*(points - start - along[:, None] * way).T) < self.unit)


def refuse(scene: "Scene", formulation: Formulation) -> None:
    """Refuse in one sentence what these elements do not carry."""
    material = next(iter(scene.materials.values()))
    timed = any(one.history is not None for one in (*scene.loads, *scene.supports))
    beyond = {
        "[contact]": scene.contact is not None,
        "[inertia]": scene.inertia is not None,
        "[loading]": scene.loading is not None,
        "[[tessellations]]": bool(scene.tessellations),
        "[[joint_sets]]": bool(scene.joint_sets),
        f"{len(scene.blocks)} [[blocks]]": len(scene.blocks) != 1,
        "[[initial_stresses]]": bool(scene.initial_stresses),
        f'the law "{material.law}"': material.law != "elastic",
        "a history": timed,
        "a load with a field": any(one.field is not None for one in scene.loads),
        "a support with a field": any(one.field is not None for one in scene.supports),
        "a pressure": any(one.kind == "pressure" for one in scene.loads),
        "a support of a block": any(not (s.point or s.segment) for s in scene.supports),
    }
    found = next((name for name, there in beyond.items() if there), None)
    if found is not None:
        raise NmmError(
            f"scikit-fem: the scene has {found}: expected linear statics of one elastic block: "
            "leave the yardstick out"
        )
    if formulation.cover.degree not in DEGREES or formulation.cover.size is None:
        raise NmmError(
            f"[cover] degree {formulation.cover.degree}, size {formulation.cover.size}: expected "
            'a degree of 1 to 4 and a size with type = "skfem": give both'
        )


def meshed_body(scene: "Scene", formulation: Formulation) -> MeshedBody:
    """Return the body of a scene with its mesh."""
    import skfem

    from nmm.geometry.regions import regions
    from nmm.study.scikit_fem.meshes import fitted_mesh

    (body,) = regions(scene).polygons.to_shapely()
    points = [one.point for one in (*scene.supports, *scene.loads) if one.point]
    ends = [end for one in (*scene.supports, *scene.loads) for end in one.segment or ()]
    marks = np.array([*points, *ends], dtype=float).reshape(-1, 2)
    cracks = [np.array(one.points) for one in scene.cracks]
    degree, size = formulation.cover.degree, formulation.cover.size
    assert degree is not None
    assert size is not None
    mesh = fitted_mesh(body, cracks, marks, size)
    element = skfem.ElementVector(getattr(skfem, f"ElementTriP{degree}")())
    basis = skfem.Basis(mesh, element, intorder=max(2 * (degree - 1), 1))
    return MeshedBody(scene, basis, NEAR * float(np.ptp(mesh.p, axis=1).max()))
