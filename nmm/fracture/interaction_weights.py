"""The interaction integral as factors at quadrature points, which hold for every displacement."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats, Ints


@dataclass(frozen=True)
class InteractionWeights:
    """Factors of displacement gradients and stresses at quadrature points, for both modes.

    Attributes
    ----------
    owner, points
        (m,) elements, and (m, 2) points in them.
    gradient
        (m, 2 modes, 2, 2) factors of the displacement gradient, without the stress of projected
        pressures.
    stress
        (m, 2 modes, 2, 2) factors of stresses that do not follow from the displacement.
    """

    owner: Ints
    points: Floats
    gradient: Floats
    stress: Floats

    @property
    def pressure(self) -> Floats:
        """(m, 2 modes) factors of a pressure."""
        return np.asarray(np.trace(self.stress, axis1=2, axis2=3))


@dataclass(frozen=True)
class ForceWeights:
    """Factors of body forces and of the gradient of added stresses at quadrature points.

    Attributes
    ----------
    owner, points
        (m,) elements, and (m, 2) points in them.
    force
        (m, 2 modes, 2) factors of the body force.
    slope
        (m, 2 modes, 2, 2) factors of the derivative of added stress along the direction ahead.
    """

    owner: Ints
    points: Floats
    force: Floats
    slope: Floats
