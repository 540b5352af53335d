"""A scene and a formulation as they are solved."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.formulation import Formulation, formulation_hash
from nmm.model.solver_settings import cures, warnings
from nmm.results.summary import Summary
from nmm.scene import scene_hash
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene


@dataclass(frozen=True, kw_only=True)
class CompiledScene:
    """What a run begins with.

    Attributes
    ----------
    scene, formulation, regions
        What is run.
    stepper
        Model, effects and solver.
    start
        State at the start.
    at_once
        Whether statics of loads in full tries no smaller increments of them.
    """

    scene: "Scene"
    formulation: Formulation
    regions: "Regions"
    stepper: Stepper
    start: State
    at_once: bool = False

    def identity(self) -> Summary:
        """Return what is known of the run before it begins."""
        manifold, solver = self.stepper.model.manifold, self.stepper.solver
        seeds = [item.seed for item in self.scene.tessellations if item.seed is not None]
        return Summary(
            title=self.scene.title,
            blocks=len(self.regions.polygons),
            elements=len(manifold.elements),
            covers=manifold.n_covers,
            unknowns=manifold.n_unknowns,
            linear_solver=solver.describe(manifold.n_unknowns),
            cures=cures(manifold, solver, self.stepper.plan.supports),
            warnings=self._cautions(),
            seed=seeds[0] if seeds else self.scene.seed,
            scene_hash=scene_hash(self.scene),
            formulation_hash=formulation_hash(self.formulation),
        )

    def _cautions(self) -> list[str]:
        """Return what is known to spoil answers: of the model, then of its effects."""
        of_effects = [
            f"{name}: {effect.caution}"
            for name, effect in self.stepper.plan.effects.items()
            if effect.caution
        ]
        return warnings(self.stepper.model) + of_effects
