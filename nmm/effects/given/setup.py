"""What effects are built from."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.kinematics import COROTATIONAL, Kinematics
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.geometry.geometry import Geometry

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene.model import Scene


@dataclass(frozen=True)
class StageLoads:
    """How loads act in a stage: by name, those that ``grows`` in it and those that ``leaves``.

    ``released`` is the share of what removed blocks exerted that is gone at its end; None leaves
    as it is what earlier stages hold back.
    """

    grows: frozenset[str] = frozenset()
    leaves: frozenset[str] = frozenset()
    released: float | None = None

    def share(self, name: str, load_factor: float) -> float:
        """Return the share of a load at a load factor that grows from 0 to 1 in the stage."""
        if name in self.grows:
            return load_factor
        return 1.0 - load_factor if name in self.leaves else 1.0


@dataclass(frozen=True)
class Setup:
    """What effects are built from.

    Attributes
    ----------
    scene, formulation
        As read.
    model
        Manifold and materials.
    geometry
        Blocks and cracks that the manifold covers.
    region_name, region_material
        Name and material (index in the scene's order) of each input region.
    start
        State at the start of the run.
    origin
        (2,) where the axes of model and states lie in those of the scene (m).
    acting
        How loads act in a stage; None in scenes without stages.
    kinematics
        How bodies move and strain.
    table
        What an effect's own ``[effects.NAME]`` says, an `Effect.Table` in the axes of the model;
        None for effects that have keys of the scene.
    """

    scene: "Scene"
    formulation: "Formulation"
    model: Model
    geometry: Geometry
    region_name: tuple[str, ...]
    region_material: Ints
    start: State
    origin: Floats = field(default_factory=lambda: np.zeros(2))
    table: Any = None
    acting: StageLoads | None = None
    kinematics: Kinematics = COROTATIONAL

    @property
    def small(self) -> bool:
        """Whether displacements are small: bodies' axes stay as they are."""
        return self.kinematics.small

    def regions(self, name: str | None) -> Bools | None:
        """Return which regions a name means: a block, all blocks of a tessellation, or "all"."""
        if name is None or name == "all":
            return None
        return np.array([one == name or one.startswith(f"{name}.") for one in self.region_name])
