"""Counts that the cost of a run depends on, and the terms that seconds and memory grow with."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats

if TYPE_CHECKING:
    from nmm.stepping.simulation import Simulation


@dataclass(frozen=True)
class Size:
    """Counts that the cost of a run depends on.

    Attributes
    ----------
    elements, unknowns
        Of the manifold.
    entries
        Entries of all element matrices, ``sum L^2``.
    edges
        Boundary edges that contact is searched among; 0 without contact.
    steps
        Steps or load increments. Contact passes are not told beforehand; their usual number is in
        the coefficients.
    """

    elements: int
    unknowns: int
    entries: int
    edges: int
    steps: float

    @property
    def kind(self) -> str:
        """Runs with and without contact are fitted apart."""
        return "contact" if self.edges else "alone"

    def preparation(self) -> Floats:
        """Terms of the seconds of geometry, covers and effects."""
        return np.array([1.0, self.elements, self.entries, self.edges])

    def running(self) -> Floats:
        """Terms of the seconds of the run: once, and for each step.

        Factors of a plane mesh in nested dissection take ``N^1.5`` operations (George 1973).
        """
        n, s = float(self.unknowns), self.steps
        return np.array([1.0, s, s * self.entries, s * n, s * n**1.5, s * self.edges])

    def storage(self) -> Floats:
        """Terms of the memory; factors of a plane mesh hold ``N log N`` numbers (George 1973)."""
        n = float(self.unknowns)
        return np.array([1.0, self.elements, self.entries, n * np.log2(n + 2), self.edges])


def size_of(simulation: "Simulation", steps: float) -> Size:
    """Count what a compiled scene will cost."""
    manifold = simulation.stepper.model.manifold
    entries = sum(
        group.unknowns.shape[0] * group.unknowns.shape[1] ** 2 for group in manifold.groups
    )
    edges = len(manifold.boundary.start) if simulation.scene.contact is not None else 0
    return Size(len(manifold.elements), manifold.n_unknowns, int(entries), edges, steps)


def steps_of(simulation: "Simulation") -> float | None:
    """Return the number of steps of a run; None when the load at failure, or errors decide."""
    scene, formulation = simulation.scene, simulation.formulation
    if scene.inertia is not None and scene.duration is not None:
        step = formulation.integrator.fixed_step
        return None if step is None else float(np.ceil(scene.duration / step))
    if scene.loading is None:
        return 1.0
    if scene.loading.until == "failure":
        return None
    return float(np.ceil(float(scene.loading.until) / formulation.loading.increment))
