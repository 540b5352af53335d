"""What a stepper carries from accepted step to accepted step besides the state of the bodies."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.frozen import with_parts
from nmm.geometry.geometry import Geometry
from nmm.stepping.step.trial import Attempt


@dataclass(frozen=True)
class LaidAnew:
    """Blocks as the classical update has laid them: vertices (P, 2) in m, stress (E, 3) so far."""

    points: Floats
    stress: Floats


@dataclass(frozen=True)
class CarriedState:
    """All that is carried; whatever else is kept may be dropped at any time.

    Attributes
    ----------
    reach
        How far contacts are sought in the next step (m).
    knows_start
        Whether the acceleration at the start of the next step is known
        (`nmm.integrators.starting`).
    pushing
        (p,) sorted keys of the contacts that pushed in the last step.
    anchored
        Whether soft springs hold bodies in statics to where they stand
        (`nmm.stepping.step.anchors`).
    laid
        Blocks that are laid anew after each step; None where they are not.
    geometry
        Blocks and cracks, where an effect has asked for others than those of the scene.
    effects
        What effects carry, by their names; empty while a stepper goes on, as they hold it.
    """

    reach: float
    knows_start: bool = False
    pushing: Ints = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    anchored: bool = False
    laid: LaidAnew | None = None
    geometry: Geometry | None = None
    effects: Mapping[str, Any] = field(default_factory=dict)

    def after(self, attempt: Attempt, reach: float, restarts: bool) -> Self:
        """Return what is carried on from an accepted step.

        ``reach`` is that of the next step; ``restarts`` says whether accelerations are forgotten
        where other contacts push (`nmm.integrators.base.Integrator.restarts_at_impact`).
        """
        if attempt.solved is None or not restarts:
            return with_parts(self, reach=reach, knows_start=True)
        pushing = attempt.solved.pushing
        struck = not np.array_equal(pushing, self.pushing)
        return with_parts(self, reach=reach, knows_start=not struck, pushing=pushing)
