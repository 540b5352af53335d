"""Finite elements of scikit-fem as a yardstick: one elastic body on triangles that fit it.

A formulation asks for them by ``[cover] type = "skfem"`` with ``degree`` 1 to 4 and ``size``; they
stand beside manifolds in `nmm cost` alone. Stiffness is integrated to its exact degree, supports
are strong, and the solver orders for symmetric matrices: elements at their best.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.errors import NmmError
from nmm.formulation import Formulation, formulation_hash
from nmm.results.summary import Summary
from nmm.scene import scene_hash

if TYPE_CHECKING:
    from nmm.scene import Scene
    from nmm.scene.tables.loading.loads import LoadTable

DEGREES = (1, 2, 3, 4)
NEAR = 1e-9  # of the body's extent: what lies on a segment


@dataclass(frozen=True)
class ElementRun:
    """A solved body: what quantities are read off, as off a run of nmm."""

    summary: Summary
    history: dict[str, Floats]


@dataclass(frozen=True)
class _Solid:
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


@dataclass
class _Clock:
    """Wall-clock seconds by phase and by effect."""

    phases: dict[str, float] = field(default_factory=dict)
    effects: dict[str, float] = field(default_factory=dict)

    def timed(self, into: dict[str, float], name: str, work: Callable[[], Any]) -> Any:
        """Do the work and add its seconds."""
        began = perf_counter()
        done = work()
        into[name] = into.get(name, 0.0) + perf_counter() - began
        return done


def run_elements(scene: "Scene", formulation: Formulation) -> ElementRun:
    """Solve a scene of one elastic body by finite elements.

    Raises
    ------
    NmmError
        When the scene is not linear statics of one body.
    """
    begun, clock = perf_counter(), _Clock()
    _refuse(scene, formulation)
    solid = clock.timed(clock.phases, "covers", lambda: _solid(scene, formulation))
    matrix = clock.timed(clock.phases, "assembly", lambda: _stiffness(solid))
    force = clock.timed(clock.effects, "loads", lambda: _force(solid))
    held, values = clock.timed(clock.effects, "supports", lambda: _held(solid))
    moved = clock.timed(clock.phases, "solve", lambda: _solved(matrix, force, held, values))
    clock.phases["assembly"] += sum(clock.effects.values())
    history = _history(solid, matrix, moved)
    total = perf_counter() - begun
    clock.phases["rest"] = max(total - sum(clock.phases.values()), 0.0)
    summary = Summary(
        status="converged",
        sentence=f"solved by scikit-fem P{formulation.cover.degree}",
        title=scene.title,
        blocks=1,
        elements=solid.basis.mesh.nelements,
        unknowns=solid.basis.N,
        steps=1,
        passes=1,
        seconds=clock.phases,
        effect_seconds=clock.effects,
        scene_hash=scene_hash(scene),
        formulation_hash=formulation_hash(formulation),
    )
    return ElementRun(summary, history)


def _refuse(scene: "Scene", formulation: Formulation) -> None:
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


def _solid(scene: "Scene", formulation: Formulation) -> _Solid:
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
    return _Solid(scene, basis, NEAR * float(np.ptp(mesh.p, axis=1).max()))


def _stiffness(solid: _Solid) -> Any:
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    material = solid.scene.materials[solid.scene.blocks[0].material]
    first, second = lame_parameters(material.young_modulus, material.poisson_ratio)
    if solid.scene.plane == "stress":
        first = 2 * first * second / (first + 2 * second)
    return (linear_elasticity(first, second).assemble(solid.basis) * solid.scene.thickness).tocsc()


def _force(solid: _Solid) -> Floats:
    total = np.zeros(solid.basis.N)
    for one in _forces(solid):
        total += one
    return total


def _forces(solid: _Solid) -> Iterator[Floats]:
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


def _at_node(solid: _Solid, load: "LoadTable") -> Floats:
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


def _held(solid: _Solid) -> tuple[Ints, Floats]:
    """Return the held unknowns and their values."""
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


def _solved(matrix: Any, force: Floats, held: Ints, values: Floats) -> Floats:
    from scipy.sparse.linalg import splu

    moved = np.zeros(len(force))
    moved[held] = values
    free = np.setdiff1d(np.arange(len(force)), held)
    right = (force - matrix @ moved)[free]
    try:
        factors = splu(
            matrix[free][:, free],
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError as fault:
        raise NmmError("scikit-fem: the supports do not hold the body: add one") from fault
    moved[free] = factors.solve(right)
    return moved


def _history(solid: _Solid, matrix: Any, moved: Floats) -> dict[str, Floats]:
    """Return the columns that a run of nmm would have for the same scene."""
    energy = float(moved @ (matrix @ moved)) / 2
    columns = {"load_factor": 1.0, "strain_energy": energy, "external_work": energy}
    for one in solid.scene.monitors:
        place = _displacement(solid, moved, one.point)
        columns |= {f"monitor:{one.name}:u{axis}": u for axis, u in zip("xy", place, strict=True)}
    return {name: np.array([value]) for name, value in columns.items()}


def _displacement(solid: _Solid, moved: Floats, point: Sequence[float]) -> Floats:
    node = solid.node(point)
    if node is not None:
        return np.asarray(moved[solid.basis.nodal_dofs[:2, node]])
    mesh = solid.basis.mesh
    middle = mesh.p[:, mesh.t].mean(axis=1).T
    toward = middle[np.hypot(*(middle - point).T).argmin()] - point
    # A point on the outline is moved inward by a rounding, so that it is found in a triangle.
    inner = np.asarray(point) + solid.unit * toward / np.hypot(*toward)
    return np.asarray(solid.basis.probes(inner[:, None]) @ moved)
