"""Finite elements of scikit-fem as a yardstick: one elastic body on triangles that fit it.

A formulation asks for them by ``[cover] type = "skfem"`` with ``degree`` 1 to 4 and ``size``; they
stand beside manifolds in `nmm cost` alone. Stiffness is integrated to its exact degree, supports
are strong, and the solver orders for symmetric matrices: elements at their best.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats, Ints
from nmm.errors import NmmError
from nmm.formulation import Formulation, formulation_hash
from nmm.results.summary import Summary
from nmm.scene import scene_hash
from nmm.study.scikit_fem.conditions import fixed_unknowns, force_of
from nmm.study.scikit_fem.solids import MeshedBody, meshed_body, refuse

if TYPE_CHECKING:
    from nmm.scene import Scene


@dataclass(frozen=True)
class ElementRun:
    """A solved body: what quantities are read off, as off a run of nmm."""

    summary: Summary
    history: dict[str, Floats]


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
    refuse(scene, formulation)
    solid = clock.timed(clock.phases, "covers", lambda: meshed_body(scene, formulation))
    matrix = clock.timed(clock.phases, "assembly", lambda: _stiffness(solid))
    force = clock.timed(clock.effects, "loads", lambda: force_of(solid))
    fixed, values = clock.timed(clock.effects, "supports", lambda: fixed_unknowns(solid))
    moved = clock.timed(clock.phases, "solve", lambda: _solved(matrix, force, fixed, values))
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


def _stiffness(solid: MeshedBody) -> Any:
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    material = solid.scene.materials[solid.scene.blocks[0].material]
    first, second = lame_parameters(material.young_modulus, material.poisson_ratio)
    if solid.scene.plane == "stress":
        first = 2 * first * second / (first + 2 * second)
    return (linear_elasticity(first, second).assemble(solid.basis) * solid.scene.thickness).tocsc()


def _solved(matrix: Any, force: Floats, fixed: Ints, values: Floats) -> Floats:
    from scipy.sparse.linalg import splu

    moved = np.zeros(len(force))
    moved[fixed] = values
    free = np.setdiff1d(np.arange(len(force)), fixed)
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


def _history(solid: MeshedBody, matrix: Any, moved: Floats) -> dict[str, Floats]:
    """Return the columns that a run of nmm would have for the same scene."""
    energy = float(moved @ (matrix @ moved)) / 2
    columns = {"load_factor": 1.0, "strain_energy": energy, "external_work": energy}
    for one in solid.scene.monitors:
        place = _displacement(solid, moved, one.point)
        columns |= {f"monitor:{one.name}:u{axis}": u for axis, u in zip("xy", place, strict=True)}
    return {name: np.array([value]) for name, value in columns.items()}


def _displacement(solid: MeshedBody, moved: Floats, point: Sequence[float]) -> Floats:
    node = solid.node(point)
    if node is not None:
        return np.asarray(moved[solid.basis.nodal_dofs[:2, node]])
    mesh = solid.basis.mesh
    middle = mesh.p[:, mesh.t].mean(axis=1).T
    toward = middle[np.hypot(*(middle - point).T).argmin()] - point
    # A point on the outline is moved inward by a rounding, so that it is found in a triangle.
    inner = np.asarray(point) + solid.unit * toward / np.hypot(*toward)
    return np.asarray(solid.basis.probes(inner[:, None]) @ moved)
