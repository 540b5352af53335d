"""A step without contact: one linear system, and the motion of the bodies."""

from dataclasses import replace

from nmm.errors import SolveError
from nmm.model.discretisation import CurrentDiscretisation
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.linear.equations import Equations
from nmm.stepping.step.linear.linear_system import LinearSystem
from nmm.stepping.step.mover import Mover
from nmm.stepping.step.trial import Attempt

TRUSTED = 1e-4
"""Largest residual of a linear step, as a share of its load: beyond it no digit that matters is
known of soft motions. The summary has the residual, and warns of it from 1e-6 on."""


class FreeStepSolver:
    """Solves steps without contact."""

    def __init__(
        self, current: CurrentDiscretisation, mover: Mover, system: LinearSystem, clock: Clock
    ) -> None:
        self._current, self._mover, self._system, self._clock = current, mover, system, clock

    def attempt(self, equations: Equations) -> Attempt:
        """Solve a step.

        Raises
        ------
        SolveError
            Where the load moves a part that nothing holds, or rounding leaves a residual above
            `TRUSTED`.
        """
        with self._clock.phase("solve"):
            solution = self._system.solve(equations)
        if not solution.residual <= TRUSTED:
            raise SolveError(
                f"linear system of {len(solution.increment)} unknowns: rounding leaves a residual "
                f"of {solution.residual:.1e} of the load: expected at most {TRUSTED:.0e}: "
                "stiffnesses differ by more than numbers can hold; look for springs or bodies far "
                "stiffer than others, slivers, and parts that hardly hang together"
            )
        result = replace(
            self._mover.after(equations, solution.increment), residual=solution.residual
        )
        if solution.apart is None:
            self._refuse_adrift(result.motion)
            return result
        end, moved = equations.end, solution.moved(self._current.model, equations.state)
        moved = replace(moved, time=end.time, load_factor=end.load_factor)
        return replace(result, state=moved)

    def _refuse_adrift(self, motion: float) -> None:
        """Refuse a static step that moves a loose part out of the domain."""
        size = self._current.model.manifold.elements.extent
        if motion > size and self._system.adrift():
            raise SolveError(
                f"points move by {motion:.3g} m: expected a supported system: the matrix is nearly "
                "singular and the load moves a part that nothing holds; add supports, contacts or "
                "inertia",
                singular=True,
            )
