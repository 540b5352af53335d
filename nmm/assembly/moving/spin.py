"""What spin does to strained bodies through a step."""

from dataclasses import dataclass

from integration.arrays import Floats


@dataclass(frozen=True)
class SpinOfStep:
    """Means of a step, by which moments and the pull outwards do the work that rotation gains.

    Its energy is ``J0 w^2 / 2 - w^2 s`` (`nmm.effects.inertia`). A step from ``w0, s0`` to
    ``w1, s1`` gains of it what moments do that turn the body by the mean spin less ``slower``,
    ``2 w s / J0`` of the means of both ends, and a pull by the mean square of the spin takes from
    it what it does on the stretch:

        w1^2 s1 - w0^2 s0 = (w1 - w0) (w0 + w1) (s0 + s1) / 2 + (w0^2 + w1^2) / 2 (s1 - s0)

    Attributes
    ----------
    squared
        (B,) mean square of the spin (rad2/s2).
    slower
        (B,) by how much slower than their mean spin strained bodies turn (rad/s).
    """

    squared: Floats
    slower: Floats
