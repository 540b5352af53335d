"""Start of the interior point on its central path, about unknowns that are known already.

At given unknowns the products of slack and flow alone say what springs carry: of a normal force
``N'`` uncut, ``p - k w = t - N'`` and ``p w = kappa`` (Chen, Harker 1993; Kanzow 1996). So nothing
but the balance of forces is left to the path, which begins at a product as small as that balance is
good. Slack and flow of another product, as those of a last step, lose most paths.
"""

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration.interior.complementarity import Complementarity, InteriorIterate

BESIDE = 1e-9
"""Least slack beside a bound that is hardly any, in forces that a spring of ``product`` has."""


def central_start(sides: Complementarity, increment: Floats, product: float) -> InteriorIterate:
    """Return the point at unknowns (n,) at which every product of slack and flow is ``product``.

    Of the two sides of a shear force the nearer one alone says how large it is; what the farther
    adds, about ``product`` over the whole bound, is left to the first step.

    Parameters
    ----------
    sides
        Of springs; it has no exact contacts, whose forces do not follow from unknowns.
    increment
        (n,) unknowns.
    product
        Of slack and flow (J), above zero.
    """
    springs, limits = sides.springs, sides.springs.problem.limits
    normal, shear = springs.trial(increment)
    pull = np.where(sides.active[0], limits.tension, 0.0)
    open_slack = _slack(pull - normal, product * springs.stiffness[0])
    opened = product / open_slack
    normal = np.where(sides.active[0], pull - open_slack, normal)
    bound = sides.bound(normal, open_slack, opened)
    square = product * springs.stiffness[1]
    near = _slack(bound - np.abs(shear), square)
    near = np.maximum(np.minimum(near, bound), BESIDE * np.sqrt(square))
    far = np.maximum(2 * bound - near, near)
    held = np.sign(shear) * np.maximum(bound - near, 0.0)
    held = np.where(sides.smooth, 0.0, np.where(sides.active[1], held, shear))
    ahead, back = np.where(shear >= 0, (near, far), (far, near))
    slack = np.stack([open_slack, ahead, back])
    return InteriorIterate(increment, normal, held, slack, product / slack)


def _slack(free: Floats, square: Floats) -> Floats:
    """Positive roots ``x`` (m,) of ``x - square / x = free``, to rounding whatever the sign."""
    length = np.sqrt(free**2 + 4 * square)
    return np.where(free > 0, free + length, 4 * square / (length - np.minimum(free, 0.0))) / 2
