"""A scene under a formulation as one problem, before anything is there that solves it.

All that a run would refuse is refused here, so that `nmm check` needs neither the step loop nor the
solution of contact.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import TYPE_CHECKING

from covers.approximation.block_manifold import block_manifold
from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.effects.base import defines
from nmm.errors import Fault, FormulationError, SceneError
from nmm.formulation import Formulation
from nmm.geometry.checks.amounts import refuse_many_cells
from nmm.geometry.regions import regions as build_regions
from nmm.geometry.tessellation.cover_types import block_cover
from nmm.integrators.base import Integrator, make_integrator
from nmm.model.build import block_functions, geometry_of, named, setup_of
from nmm.model.consistency import check_kinematics, check_together
from nmm.model.discretisation import Discretisation
from nmm.model.fault_places import of_stage, placed
from nmm.model.origin import own_origin, shifted, shifted_regions
from nmm.model.parts import check_parts
from nmm.model.planning.making import compile_plan
from nmm.model.planning.plan import Plan
from nmm.model.solver_settings import solver_of_run
from nmm.model.staging.stages import Stage, Staged, stages_of
from nmm.solvers.linear import LinearSolver
from nmm.stepping.reports.monitors import Monitor, monitors
from nmm.stepping.step.remap import Lay, check_remap

if TYPE_CHECKING:
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene


@dataclass(frozen=True)
class PosedScene:
    """What is to be solved, and by which parts.

    Attributes
    ----------
    scene, formulation, regions
        With coordinates from an origin of their own.
    origin
        Where that lies in the scene (m).
    discretisation, stages, monitors
        Model and effects at the start; stages of the scene; points whose displacement it asks for.
    integrator, solver, lay
        Parts that the formulation names; `lay` lays blocks anew each step, where that is requested.
    covers, effects
        Wall-clock seconds that model and effects took.
    """

    scene: "Scene"
    formulation: Formulation
    regions: "Regions"
    origin: Floats
    discretisation: Discretisation
    stages: Sequence[Staged]
    monitors: list[Monitor]
    integrator: Integrator
    solver: LinearSolver
    lay: Lay | None
    covers: float
    effects: float


def pose(scene: "Scene", formulation: Formulation) -> PosedScene:
    """Build geometry, covers and effects, and make the parts that are named.

    Raises
    ------
    NmmError
        When the two cannot be run; with the lines of the files that it is about.
    """
    with placed(scene, formulation):
        return _posed(scene, formulation)


def _posed(scene: "Scene", formulation: Formulation) -> PosedScene:
    begun = perf_counter()
    regions = _regions(scene, formulation)
    origin = own_origin(regions.polygons.points)
    if origin.any():
        regions = shifted_regions(regions, -origin)
        scene, formulation = shifted(scene, -origin), shifted(formulation, -origin)
    stages = [
        _staged(scene, one, regions, origin)
        for one in stages_of(scene, formulation, regions, origin)
    ]
    whole = geometry_of(scene, regions)
    setup = stages[0].setup if stages else setup_of(scene, formulation, whole, origin)
    model, built = setup.model, perf_counter()
    check_kinematics(formulation, setup.kinematics)
    discretisation = Discretisation.of(setup)
    plan = discretisation.plan
    rule = make_integrator(formulation.integrator)
    _refuse_ends(rule, formulation, plan)
    for later in stages[1:]:
        with of_stage(later.stage.name):  # its faults are reported before anything is solved
            _refuse_ends(rule, formulation, compile_plan(later.setup))
    _refuse_events(scene, plan)
    return PosedScene(
        scene=scene,
        formulation=formulation,
        regions=regions,
        origin=origin,
        discretisation=discretisation,
        stages=stages,
        monitors=monitors(setup, all_there=not stages),
        integrator=rule,
        solver=solver_of_run(setup, model.manifold, plan.contact is not None),
        lay=_lay(formulation, model, plan),
        covers=built - begun,
        effects=perf_counter() - built,
    )


def _regions(scene: "Scene", formulation: Formulation) -> "Regions":
    """Return the blocks of a scene that fits its formulation."""
    regions = build_regions(scene)
    check_together(scene, formulation)
    check_parts(scene, formulation)
    place = formulation.source.place("cover", "size")
    refuse_many_cells(regions, formulation.cover, place)
    return regions


def _staged(scene: "Scene", stage: Stage, regions: "Regions", origin: Floats) -> Staged:
    """Return a stage with its own model; blocks keep their numbers and names."""
    check_parts(stage.scene, stage.formulation)
    cover, place = stage.formulation.cover, scene.source.place("stages")
    refuse_many_cells(regions, cover, place)
    regions = replace(regions, material=stage.material)
    geometry = geometry_of(scene, regions.only(stage.present))
    setup = setup_of(stage.scene, stage.formulation, geometry, origin, blocks=named(regions))
    return Staged(stage, replace(setup, acting=stage.acting), clock=scene.in_time)


def _lay(formulation: Formulation, model: Model, plan: Plan) -> Lay | None:
    """Return what lays blocks anew each step when the classical update is requested."""
    if formulation.rotation.update != "linear":
        return None
    check_remap(plan)
    if model.matter is not None:
        raise FormulationError(
            '[rotation] update: "linear": with a material that is not linear: expected elastic '
            'materials: blocks laid anew forget their strain: use update = "exact"'
        )
    functions = block_functions(formulation.cover)
    kind = block_cover(formulation.cover)
    if kind is None or kind.divides or functions.degree > 1:
        raise FormulationError(
            '[rotation] update: "linear": it lays blocks of linear functions anew: expected '
            'cover type "block" of degree 1: use update = "exact"'
        )
    return lambda polygons: block_manifold(polygons, model.manifold.element_region, functions)


def _refuse_ends(rule: Integrator, formulation: Formulation, plan: Plan) -> None:
    """Refuse forces that only a whole step has, of rates, under a rule that knows its start alone.

    Raises
    ------
    FormulationError
        Naming the effects.
    """
    lost = [name for name, effect in plan.bent.items() if not defines(effect, "force")]
    if lost and plan.inertia is not None and not rule.end_weight:
        raise FormulationError(
            f'[integrator] type: "{formulation.integrator.type}" with {", ".join(lost)}: expected '
            "forces that are known where a step starts, not those of its rates: use "
            'type = "newmark"'
        )


def _refuse_events(scene: "Scene", plan: "Plan") -> None:
    """Refuse effects that may change a geometry which a control is of.

    Raises
    ------
    SceneError
        Naming the effects.
    """
    off_path = [name for name in plan.askers if not plan.effects[name].on_paths]
    if off_path and scene.loading is not None and scene.loading.control is not None:
        place, names = scene.source.place("loading", "control"), ", ".join(off_path)
        expected = "blocks and cracks that no event changes"
        raise SceneError(Fault(place, names, expected, "remove it, or loading.control"))
