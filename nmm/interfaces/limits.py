"""Largest forces at contacts: what an interface law tells contact enforcement."""

from dataclasses import dataclass

from integration.arrays import Floats


@dataclass(frozen=True)
class Limits:
    """Given numbers that no contact force of this step may exceed.

    The admissible forces are ``N <= tension`` and ``|T| <= cohesion + friction * max(-N, 0)``;
    a contact with ``tension == 0`` that is open carries nothing. Within a step the limits stand
    (force at a limit, no softening); what breaks for good is for the interface law to decide
    between two solutions. ``inf`` is allowed: the contact then never opens or slides.

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
