"""From a scene and a formulation to what can be run: geometry, covers, effects, solver."""

from dataclasses import replace
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from covers.approximation.block_manifold import block_manifold
from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.errors import FormulationError
from nmm.formulation import Formulation
from nmm.geometry.checks.amounts import refuse_many_cells
from nmm.geometry.regions import regions as build_regions
from nmm.geometry.tessellation.cover_types import block_cover
from nmm.integrators.base import make_integrator
from nmm.model.build import block_functions, geometry_of, setup_of
from nmm.model.consistency import check_kinematics, check_together
from nmm.model.discretisation import Discretisation
from nmm.model.fault_places import placed
from nmm.model.origin import own_origin, shifted, shifted_regions
from nmm.model.parts import check_parts
from nmm.model.planning.making import compile_plan
from nmm.model.planning.plan import Plan
from nmm.model.solver_settings import solver_for
from nmm.model.stages import Stage, stages_of
from nmm.stepping.drive.changes import refuse_events
from nmm.stepping.drive.stages import Staged
from nmm.stepping.reports.monitors import monitors
from nmm.stepping.simulation import Simulation
from nmm.stepping.step.budget import Budget
from nmm.stepping.step.remap import Lay, check_remap
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene


def prepare(scene: "Scene", formulation: Formulation) -> Simulation:
    """Build geometry, covers, effects and solver of a run.

    Raises
    ------
    NmmError
        When the two cannot be run; with the lines of the files that it is about.
    """
    with placed(scene, formulation):
        return _prepared(scene, formulation)


def _prepared(scene: "Scene", formulation: Formulation) -> Simulation:
    begun = perf_counter()
    regions = build_regions(scene)
    check_together(scene, formulation)
    check_parts(scene, formulation)
    cover = formulation.cover
    refuse_many_cells(regions, cover, formulation.source.place("cover", "size"))
    asked, origin = (scene, formulation), own_origin(regions.polygons.points)
    if origin.any():
        regions = shifted_regions(regions, -origin)
        scene, formulation = shifted(scene, -origin), shifted(formulation, -origin)
    stages = [
        _staged(scene, one, regions, origin)
        for one in stages_of(scene, formulation, regions, origin)
    ]
    whole = geometry_of(scene, regions)
    setup = stages[0].setup if stages else setup_of(scene, formulation, whole, origin)
    model, start, built = setup.model, setup.start, perf_counter()
    check_kinematics(formulation, setup.kinematics)
    discretisation = Discretisation.of(setup)
    for later in stages[1:]:
        compile_plan(later.setup)  # its faults are told before anything is solved
    plan = discretisation.plan
    refuse_events(scene, plan)
    stepper = Stepper(
        discretisation,
        make_integrator(formulation.integrator),
        solver_for(model.manifold, formulation.solver, plan.contact is not None),
        setup.kinematics,
        lay=_lay(formulation, model, plan),
    )
    limits = formulation.loading
    stepper.budget = Budget(limits.budget, limits.max_steps, begun)
    stepper.seconds["covers"] = built - begun
    stepper.seconds["effects"] = perf_counter() - built
    watched = monitors(setup, all_there=not stages)
    ready = Simulation(
        scene=asked[0],
        formulation=asked[1],
        regions=regions,
        stepper=stepper,
        start=plan.begin(start),
        monitors=watched,
        begun=begun,
        origin=origin,
        stages=stages,
    )
    if scene.loading is not None and scene.loading.control is not None:
        from nmm.stepping.control.making import control_of  # no other scene follows a path

        control_of(scene.loading.control, stepper, formulation)
    return ready


def _staged(scene: "Scene", stage: Stage, regions: "Regions", origin: Floats) -> Staged:
    """Return a stage with its own model; blocks keep their numbers and names."""
    check_parts(stage.scene, stage.formulation)
    cover, place = stage.formulation.cover, scene.source.place("stages")
    refuse_many_cells(regions, cover, place)
    geometry = geometry_of(scene, regions.only(stage.present))
    setup = setup_of(stage.scene, stage.formulation, geometry, origin)
    whole = replace(
        setup,
        region_name=tuple(regions.name),
        region_material=np.asarray(regions.material),
        acting=stage.acting,
    )
    return Staged(stage, whole, clock=scene.inertia is not None)


def _lay(formulation: Formulation, model: Model, plan: Plan) -> Lay | None:
    """Return what lays blocks anew each step when the classical update is asked for."""
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
