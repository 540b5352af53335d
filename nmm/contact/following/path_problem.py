"""Balance of a step along a path, and an iterate of it."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csc_array, diags_array, vstack

from integration.arrays import Floats
from nmm.contact.laws.tractions import ContactForces
from nmm.contact.points.contact_rows import ContactRows
from nmm.controls.path_equation import PathEquation

# Out-of-balance force over the largest one below which iterations without gain are rounding.
ROUNDED = 1e-8
# Share of gaps and slips by which bonds at their limit are loaded further, for their tangents.
LOADED_FURTHER = 1e-6
# Share of what the forces of a step would press into a contact spring up to which faces touch.
TOUCHING = 1e-3

# From gaps and slips (m,) to forces.
Law = Callable[[Floats, Floats], ContactForces]
# From an increment (n,) to the force (n,) that it meets beyond the matrix, and its slope.
Bent = Callable[[Floats], tuple[Floats, Callable[[], csc_array]]]


@dataclass(frozen=True)
class PathStep:
    """An iterate of a step, or its solution.

    Attributes
    ----------
    increment
        (n,) unknowns.
    change
        Of the load factor.
    contacts
        Response of the contacts.
    gap, slip
        (m,) at the end (m).
    rest
        (n,) out-of-balance force (N).
    residual
        Its size over that of the largest force.
    short
        Residual of the path equation over its target.
    iterations
        Linear systems solved.
    slope
        Makes the matrix (n, n) of what bends beyond the line; None where nothing does.
    """

    increment: Floats
    change: float
    contacts: ContactForces
    gap: Floats
    slip: Floats
    rest: Floats
    residual: float
    short: float = 0.0
    iterations: int = 0
    slope: Callable[[], csc_array] | None = None

    @property
    def converged(self) -> bool:
        """Whether forces are in balance where the path equation wants them."""
        return self.residual <= ROUNDED and self.short <= ROUNDED

    @property
    def lacking(self) -> str:
        """What it lacks of a solution, in words."""
        if self.residual <= ROUNDED < self.short:
            return f"in balance, and short of the step by {100 * self.short:.2g} %"
        return f"out of balance by {self.residual:.1e}"

    @property
    def out(self) -> float:
        """Size of the out-of-balance force (N)."""
        return float(np.linalg.norm(self.rest))


@dataclass(frozen=True)
class PathProblem:
    """Balance of a step along a path.

    Attributes
    ----------
    matrix, force
        (n, n) and (n,) of all but contacts, at the load factor of the start.
    rows
        Of the contacts.
    gap, slip
        (m,) at the start (m).
    law
        Contact forces from gaps and slips.
    scale
        Force (N) that residuals are relative to, or those of contacts and load if they are larger.
    rounding
        Contact force (N) due to rounded coordinates; a smaller residual counts as none.
    bent
        Other nonlinear forces of the step; None without any.
    stiffest
        Stiffness of the stiffest contact spring (N/m).
    """

    matrix: csc_array
    force: Floats
    rows: ContactRows
    gap: Floats
    slip: Floats
    law: Law
    scale: float
    rounding: float = 0.0
    bent: Bent | None = None
    stiffest: float = 0.0

    def at(self, path: PathEquation, increment: Floats, change: float) -> PathStep:
        """Return the iterate at an increment (n,) and a change of the load factor."""
        gap = self.gap + self.rows.normal @ increment
        slip = self.slip + self.rows.tangent @ increment
        contacts = self.law(gap, slip)
        inner = self.matrix @ increment + self.rows.push(*contacts.force.T)
        beyond, slope = (0.0, None) if self.bent is None else self.bent(increment)
        inner = inner + beyond
        rest = np.asarray(self.force + change * path.load - inner)
        pushed = float(np.linalg.norm(self.rows.push(*np.abs(contacts.force.T))))
        size = max(self.scale, pushed, abs(change) * float(np.linalg.norm(path.load)))
        out = float(np.linalg.norm(rest))
        residual = out / (size or 1.0) if out > self.rounding else 0.0
        short = abs(path.left(increment, change)) / (abs(path.target) or 1.0)
        found = PathStep(increment, change, contacts, gap, slip, rest, residual, short)
        return replace(found, slope=slope)

    def loaded_further(self, begin: PathStep) -> PathStep:
        """Return the start of a step with the tangents of contacts that are loaded further.

        A bond that softens is at its limit where a step begins, with one tangent as it opens and
        another one as it unloads. Rounding would choose, and a structure that unloads as a whole
        takes no energy however far it goes.
        """
        further = self.law((1 + LOADED_FURTHER) * begin.gap, (1 + LOADED_FURTHER) * begin.slip)
        return replace(begin, contacts=replace(begin.contacts, slopes=further.slopes))

    def touching_stick(self, begin: PathStep) -> PathStep:
        """Return the start of a step with contacts that touch without force as if they stuck.

        Friction is at its limit, zero, where nothing presses yet: by the tangents of that state a
        block that only friction holds is free to move along the face that its weight will press.
        """
        touch = TOUCHING * self.scale / (self.stiffest or 1.0)
        idle = (begin.gap <= touch) & ~begin.contacts.force.any(axis=1)
        if not (touch and idle.any()):
            return begin
        gap, slip = np.where(idle, -touch, begin.gap), np.where(idle, 0.0, begin.slip)
        pressed = self.law(gap, slip).tangent
        tangent = np.where(idle[:, None, None], pressed, begin.contacts.tangent)
        return replace(begin, contacts=replace(begin.contacts, slopes=lambda: tangent))

    def tangent(self, step: PathStep, slope: Floats | None = None) -> csc_array:
        """Return the matrix (n, n) by which forces answer a further increment.

        ``slope`` (m, 2, 2) are other tangents of the contacts than those of the step.
        """
        normal, tangent = self.rows.normal, self.rows.tangent
        slope = step.contacts.tangent if slope is None else slope
        matrix = self.matrix if step.slope is None else csc_array(self.matrix + step.slope())
        if not len(slope):
            return matrix
        parts = [
            diags_array(slope[:, one, 0]) @ normal + diags_array(slope[:, one, 1]) @ tangent
            for one in (0, 1)
        ]
        return csc_array(matrix + vstack([normal, tangent]).T @ vstack(parts))
