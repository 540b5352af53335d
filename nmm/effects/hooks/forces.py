"""Hooks of the forces, matrices and constraints of effects in a step."""

from integration.arrays import Floats
from integration.sparse import csc_array, csr_array
from nmm.assembly.state import State
from nmm.effects.given.resistance import Resistance
from nmm.effects.given.steps import Instant, Span, StepForce


class ForceHooks:
    """Forces of an effect; vectors and matrices are in the n unknowns, in the axes of bodies."""

    @property
    def steady(self) -> bool:
        """Whether in dynamics the force depends on the state alone, not on the time."""
        return True

    def force(self, state: State, end: Instant) -> Floats:
        """Force (n,) that acts through the step from ``state`` to ``end``."""
        raise NotImplementedError

    @property
    def dead(self) -> bool:
        """Whether the force keeps its direction in space on points that move with the bodies.

        In time it then acts where bodies are half way through a step (`nmm.effects.half_way`).
        """
        return False

    def matrix(self, state: State) -> csc_array:
        """Symmetric matrix (n, n) added to the stiffness in the step from ``state``.

        It is minus the derivative of the force by the unknowns.
        """
        raise NotImplementedError

    def damping(self, state: State) -> csc_array:
        """Symmetric matrix (n, n) of a force against the velocity, in dynamics.

        The integrator weighs this force as it weighs elastic ones, and books the energy it takes.
        """
        raise NotImplementedError

    def added_mass(self, state: State) -> csc_array:
        """Symmetric matrix (n, n) added to the mass in the step.

        It stores no energy: what it takes or gives is booked as lost.
        """
        raise NotImplementedError

    @property
    def nonlinear(self) -> bool:
        """Whether `step_force` differs from its linearisation by `force` and `matrix`."""
        return True

    @property
    def limited(self) -> bool:
        """Whether its force has a limit, as of yielding, which `matrix` does not show."""
        return False

    def resistance(self, state: State) -> Resistance:
        """Return the forces that it can exert near ``state``, whatever moves, in limit analysis.

        They take the place of `force` and `matrix` there; without it what `matrix` resists is held.
        """
        raise NotImplementedError

    @property
    def symmetric(self) -> bool:
        """Whether the tangent of `step_force` is; contact takes the symmetric part of others."""
        return True

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """Return the weighted force through a step, from one state to a trial of its end.

        It replaces `force` and `matrix`, its linearisation at the start. ``after`` has the memory
        of ``before``.

        Raises
        ------
        SolveError
            There is no such force; the step is then cut.
        """
        raise NotImplementedError

    def work_correction(self, before: State, after: State, increment: Floats, span: Span) -> float:
        """Work (J) of the rise of its force on the increment (n,), minus the true one.

        The true work is done on the paths of its points.
        """
        raise NotImplementedError

    def border(self, state: State, end: Instant) -> tuple[csr_array, Floats] | None:
        """Constraints ``rows @ d = sides`` on the step's unknowns (k, n), (k,); None without any.

        They are imposed by Lagrange multipliers, in a bordered matrix.
        """
        raise NotImplementedError

    def keep(self, multipliers: Floats) -> Floats:
        """Take the leading multipliers, those of these constraints; return the others."""
        raise NotImplementedError
