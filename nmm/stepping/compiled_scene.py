"""A scene and a formulation as they are solved."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.formulation import Formulation
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
