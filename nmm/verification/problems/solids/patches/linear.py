"""Patch tests of one strain: covers must give it exactly, on any cut mesh (Taylor 1986)."""

from typing import ClassVar

from nmm.formulation import Formulation
from nmm.verification.base import MESHES, Checks
from nmm.verification.continuum import (
    Problem,
    edge_support,
    everywhere,
    load,
    pin,
)
from nmm.verification.problems.solids.patches.body import PRINTED, HoledPatch, uniform


class HeldPatch(HoledPatch):
    """Exact displacements all around a body give one stress in every element, cut ones too."""

    name = "A1 displacements"
    title = "Linear patch test, displacements given"
    source = "Hooke's law in plane stress for strains (1, -0.2, 0.5) 1e-3"
    formulations: ClassVar[tuple[str, ...]] = (
        *MESHES,
        *("manifold degree 2", "quads", "splines", "multipliers", "multipliers degree 2"),
    )

    def problem(self, formulation: Formulation) -> Problem:
        """Hold the whole boundary."""
        model = self.body(formulation).model
        place = everywhere(model, 10)
        return Problem(model, [edge_support(model, formulation, place, uniform().displacement)])

    def checks(self, formulation: str) -> Checks:
        return self.compared(formulation, 2e-9, PRINTED)


class MeshlessPatch(HeldPatch):
    """Moving least squares pass the patch test up to their quadrature.

    Their weights are rational and have jumps in higher derivatives within cells, which no rule of
    points integrates exactly.
    """

    name = "A1 meshless"
    title = "Linear patch test of moving least squares"
    formulations = ("meshless",)
    size = 0.2

    def checks(self, formulation: str) -> Checks:
        reason = "measured 2.3e-4 of a stress of about 1: quadrature"
        found = self.compared(formulation, 1e-3, reason)
        del found["largest error of stress (Pa)"]
        return found


class PulledPatch(HoledPatch):
    """Exact tractions all around and three pins that carry nothing give the stress too."""

    name = "A1 tractions"
    title = "Linear patch test, tractions given"
    source = "Hooke's law in plane stress for strains (1, -0.2, 0.5) 1e-3"
    formulations = (*MESHES, "manifold degree 2", "quads")

    def problem(self, formulation: Formulation) -> Problem:
        """Load the whole boundary."""
        model = self.body(formulation).model
        pins = [pin(model, [0.0, 0.0]), pin(model, [2.0, 0.0], (False, True))]
        return Problem(model, pins, [load(model, everywhere(model, 10), uniform().traction)])

    def checks(self, formulation: str) -> Checks:
        return self.compared(formulation, 2e-9, PRINTED)
