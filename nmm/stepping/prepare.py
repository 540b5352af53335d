"""From a scene and a formulation to what can be run."""

from time import perf_counter
from typing import TYPE_CHECKING

from nmm.formulation import Formulation
from nmm.model.discretisation import Discretisation
from nmm.model.fault_places import placed
from nmm.stepping.posed import pose
from nmm.stepping.simulation import Simulation
from nmm.stepping.step.budget import Budget
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.scene.model import Scene


def prepare(scene: "Scene", formulation: Formulation) -> Simulation:
    """Build geometry, covers, effects and solver of a run.

    Raises
    ------
    NmmError
        When the two cannot be run; with the lines of the files that it is about.
    """
    begun, posed = perf_counter(), pose(scene, formulation)
    setup = posed.discretisation.setup
    stepper = Stepper(
        posed.discretisation, posed.integrator, posed.solver, setup.kinematics, lay=posed.lay
    )
    _make_what_steps_ask_for(posed.discretisation)
    limits = formulation.loading
    stepper.budget = Budget(limits.budget, limits.max_steps, begun)
    stepper.seconds["covers"], stepper.seconds["effects"] = posed.covers, posed.effects
    ready = Simulation(
        scene=scene,
        formulation=formulation,
        regions=posed.regions,
        stepper=stepper,
        start=posed.discretisation.plan.begin(setup.start),
        monitors=posed.monitors,
        begun=begun,
        origin=posed.origin,
        stages=posed.stages,
    )
    loading = posed.scene.loading
    if loading is not None and loading.control is not None:
        from nmm.stepping.control.making import check_path  # no other scene follows a path

        with placed(scene, formulation):
            check_path(loading.control, stepper, posed.formulation)
    return ready


def _make_what_steps_ask_for(discretisation: Discretisation) -> None:
    """Make the matrices that each step asks for and no check does, before the first step."""
    manifold, inertia = discretisation.model.manifold, discretisation.plan.inertia
    mass = None if inertia is None else inertia.mass
    _ = manifold.rigid_modes, manifold.stretch_modes, mass
