"""Tension-compression asymmetric springs, split into two parallel contacts.

A spring of share ``s`` of the stiffness ``k`` that pulls and presses, and one of ``(1 - s) k`` that
only presses, are ``s k gap`` open and ``k gap`` pressed: a convex law, so that no enforcement has
to guess which of the two it is. The shear force stays with the first, whose friction is raised by
``1 / s`` to count the pressure of both.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.sparse import csr_array, vstack

from integration.arrays import Floats, Ints
from nmm.contact.problem.step_problem import OPEN, STICK, Limits, StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform

# Shear stiffness of the second contact, which carries no shear: a positive number is expected.
FAINT = 1e-9
# Least share of the first contact, whose friction counts the pressure of both by it.
TRACE = 1e-12


@dataclass(frozen=True)
class AsymmetricSprings(Transform):
    """Contacts that are softer open than pressed.

    Attributes
    ----------
    index
        (k,) contacts.
    share
        (k,) of their stiffness that is left when they open.
    """

    index: Ints
    share: Floats

    def apply(self, problem: StepProblem) -> StepProblem:
        """Return the problem with the second contacts added at its end."""
        at, none = self.index, np.zeros(len(self.index))
        share = np.maximum(self.share, TRACE)
        whole, pressed = problem.normal_stiffness[at], problem.normal_force[at] < 0
        force = np.where(pressed, problem.normal_force[at], 0.0)
        first, friction, left = (
            column.copy()
            for column in (problem.normal_stiffness, problem.limits.friction, problem.normal_force)
        )
        first[at], friction[at] = share * whole, friction[at] / share
        left[at] -= (1 - share) * force
        limits = problem.limits
        pairs: dict[str, tuple[Any, Any]] = {
            "gap": (problem.gap, problem.gap[at]),
            "slip": (problem.slip, none),
            "normal_stiffness": (first, (1 - share) * whole),
            "shear_stiffness": (problem.shear_stiffness, FAINT * problem.shear_stiffness[at]),
            "state": (problem.state, np.where(pressed, STICK, OPEN)),
            "normal_force": (left, (1 - share) * force),
            "shear_force": (problem.shear_force, none),
            "compliant": (problem.own_stiffness, np.ones(len(at), dtype=bool)),
        }
        bounds = ((limits.tension, none), (limits.cohesion, none), (friction, none))
        normal_rows, tangent_rows = (csr_array(vstack([part, part[at]])) for part in problem.rows)
        joined: dict[str, Any] = {name: np.concatenate(pair) for name, pair in pairs.items()}
        return replace(
            problem,
            normal_rows=normal_rows,
            tangent_rows=tangent_rows,
            limits=Limits(*map(np.concatenate, bounds)),
            **joined,
        )

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        m = problem.n_contacts
        normal = answer.normal_force[:m].copy()
        normal[self.index] += answer.normal_force[m:]
        return replace(
            answer,
            normal_force=normal,
            shear_force=answer.shear_force[:m],
            gap=answer.gap[:m],
            slip=answer.slip[:m],
            state=answer.state[:m],
        )
