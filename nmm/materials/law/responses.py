"""What stress-strain laws return for material points."""

from collections.abc import Mapping
from typing import NamedTuple

from integration.arrays import Floats

History = Mapping[str, Floats]
"""Internal variables of material points by name, each (m, h)."""


class Response(NamedTuple):
    """Response of a law at m material points.

    Attributes
    ----------
    stress
        (m, 3) Pa: xx, yy, xy.
    tangent
        (m, 3, 3) derivative of the stress by the strain (Pa).
    history
        Internal variables after the step, those that `Law.variables` names.
    """

    stress: Floats
    tangent: Floats
    history: History


class FiniteResponse(NamedTuple):
    """Response of a law at m Green strains.

    Attributes
    ----------
    energy
        (m,) J/m3 of the volume as it was.
    stress
        (m, 3) second Piola-Kirchhoff stress (Pa): xx, yy, xy.
    tangent
        (m, 3, 3) its derivative by the Green strain (xx, yy, 2 xy), Pa.
    """

    energy: Floats
    stress: Floats
    tangent: Floats
