"""The integrator of discontinuous deformation analysis."""

from dataclasses import dataclass, field

from nmm.integrators.newmark import Newmark


@dataclass(frozen=True)
class Shi(Newmark):
    """Shi's constant acceleration over the step (1988): ``v1 = 2 d / dt - v``.

    It is Newmark (1/2, 1), in which the old acceleration drops out. Order 1, with the algorithmic
    damping ratio ``omega dt / 4``.
    """

    beta: float = field(default=0.5, init=False)
    gamma: float = field(default=1.0, init=False)
