"""The setup from which effects are built."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.moving.kinematics import COROTATIONAL, Kinematics
from nmm.assembly.state import State
from nmm.geometry.geometry import Geometry

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene.model import Scene


@dataclass(frozen=True)
class StageLoads:
    """How loads act in a stage.

    Attributes
    ----------
    grows, leaves
        Names of loads that grow from zero in the stage, and of those that fade out.
    driven
        Names of supports that are new in the stage, which are driven from where they stand.
    released
        Share of the forces of excavated blocks that is released at its end; None leaves the shares
        of earlier stages as they are.
    clock
        Whether the scene has a clock, which stands while the load factor grows; else time grows
        with it.
    """

    grows: frozenset[str] = frozenset()
    leaves: frozenset[str] = frozenset()
    released: float | None = None
    driven: frozenset[str] = frozenset()
    clock: bool = False

    def share(self, name: str, load_factor: float) -> float:
        """Return the share of a load at a load factor, which grows from 0 to 1 in the stage."""
        if name in self.grows:
            return load_factor
        return 1.0 - load_factor if name in self.leaves else 1.0

    def left_behind(self, name: str, time: float, load_factor: float) -> tuple[float, float]:
        """Return the share of a support's displacement at the stage's start that it still lacks.

        And that instant (s).
        """
        begin = time if self.clock else time - load_factor
        return (1.0 - load_factor if name in self.driven else 0.0), begin


@dataclass(frozen=True)
class Setup:
    """A scene, its formulation and the model, from which effects are built.

    Attributes
    ----------
    scene, formulation
        As read.
    model
        Manifold and materials.
    geometry
        Blocks and cracks of the model.
    region_name, region_material
        Name of each input region, and number of its material in the order of the scene (N,).
    start
        State at the start of the run.
    origin
        (2,) origin of the axes of model and states in those of the scene (m).
    acting
        How loads act in a stage; None in scenes without stages.
    kinematics
        Kinematics of bodies: small, corotational or finite.
    only_strained
        Whether tractions at held edges are those of the strain alone, in statics, for certain: no
        effect of the scene changes them (`Effect.beyond_strain`).
    table
        The table ``[effects.NAME]`` of an effect of one's own, an `Effect.Table` in the axes of the
        model; None for built-in effects.
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
    only_strained: bool = False

    @property
    def small(self) -> bool:
        """Whether displacements are small, so that the axes of bodies are fixed."""
        return self.kinematics.small

    def regions(self, name: str | None) -> Bools | None:
        """Return the regions (N,) of a name: of a block or a tessellation; None for all."""
        if name is None or name == "all":
            return None
        return np.array([one == name or one.startswith(f"{name}.") for one in self.region_name])
