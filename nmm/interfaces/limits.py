"""Largest forces at contacts, which an interface law gives and contact enforcement keeps."""

from dataclasses import dataclass

from integration.arrays import Floats


@dataclass(frozen=True)
class Limits:
    """Bounds of the contact forces of a step.

    The admissible forces are ``N <= tension`` and ``|T| <= cohesion + friction * max(-N, 0)``;
    a contact with ``tension == 0`` that is open carries nothing. The limits are fixed within a
    solution (no softening); the interface law decides between two solutions which bonds break.
    ``inf`` is allowed: the contact then never opens or slides.

    Attributes
    ----------
    tension
        (m,) largest pull (N), >= 0.
    cohesion
        (m,) shear resistance without compression (N), >= 0.
    friction
        (m,) tangent of the friction angle.
    """

    tension: Floats
    cohesion: Floats
    friction: Floats
