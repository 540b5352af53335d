"""What audits read, what they find, and the sentence that says it."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from nmm.stepping.audits.table import THRESHOLDS

if TYPE_CHECKING:
    from nmm.assembly.state import State
    from nmm.formulation import Formulation
    from nmm.scene.model import Scene
    from nmm.stepping.drive.verdict import RunVerdict
    from nmm.stepping.reports.recorder import Recorder
    from nmm.stepping.step.stepper import Stepper


@dataclass(frozen=True)
class EndedRun:
    """A run at its end.

    Attributes
    ----------
    scene, formulation
        What was asked for.
    stepper, recorder
        What solved it, and what it counted.
    start, state
        The first state and the last accepted one.
    verdict
        How it ended, before its audit.
    condition
        Estimate of the condition number of the last system.
    """

    scene: "Scene"
    formulation: "Formulation"
    stepper: "Stepper"
    recorder: "Recorder"
    start: "State"
    state: "State"
    verdict: "RunVerdict"
    condition: float | None

    @property
    def dynamic(self) -> bool:
        """Whether it had inertia."""
        return self.scene.inertia is not None

    @property
    def longest_step(self) -> float:
        """Length (s) of the steps, of the longest where errors chose them."""
        fixed, lengths = self.formulation.integrator.fixed_step, self.recorder.totals.lengths
        return fixed or (lengths.largest if lengths else np.inf)


@dataclass(frozen=True)
class AuditFinding:
    """A number that was measured.

    Attributes
    ----------
    name
        A key of the table.
    value
        Beside its threshold.
    where
        What is off, where, and by how much, in words.
    remedy
        What to do.
    mild
        Whether it only warns, whatever the value.
    told
        Whether another finding says the same in words.
    """

    name: str
    value: float
    where: str
    remedy: str
    mild: bool = False
    told: bool = False

    @property
    def warns(self) -> bool:
        """Whether it is worth a warning."""
        return not self.told and not self.value <= THRESHOLDS[self.name].warns

    @property
    def fails(self) -> bool:
        """Whether the answer is not to be relied on."""
        bound = THRESHOLDS[self.name].fails
        return bound is not None and not (self.mild or self.told) and not self.value <= bound

    @property
    def sentence(self) -> str:
        """The warning."""
        return f"{self.where}; {self.remedy} (audit {self.name})"


Findings = Iterator[AuditFinding]


def percent(share: float) -> str:
    """Return a share in words of three digits."""
    return f"{100 * share:.3g} %" if np.isfinite(share) else "not a finite number"
