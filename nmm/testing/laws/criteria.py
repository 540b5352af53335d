"""What every criterion of crack growth is held to."""

import numpy as np

from nmm.fracture.criteria.base import Criterion
from nmm.testing.claims import claim, close, finite

# Of angles and of ratios of intensities; Newton's method leaves rounding.
EXACT = 1e-10
# Widest kink of cracks that open: 90 degrees lie beyond every criterion in use.
WIDEST = np.pi / 2


def check_criterion(criterion: Criterion, seed: int = 0, number: int = 200) -> None:
    """Hold a criterion to what every one promises.

    Opening alone leads straight on with its own intensity; kinks do not depend on the size of the
    intensities, which their equivalent follows; sliding the other way mirrors the kink; positive
    sliding never turns it counter-clockwise; tips know nothing of each other; what slides needs no
    more opening than what does not; pure sliding, and a little of it, have finite kinks.

    Raises
    ------
    AssertionError
        Saying what is not kept and by how much.
    """
    rng = np.random.default_rng(seed)
    mix = np.linspace(1e-9, np.pi / 2, number)
    one, two = np.cos(mix), np.sin(mix)
    kappa = 3 - 4 * rng.uniform(0.0, 0.45, number)
    found = criterion.kink(one, two, kappa)
    finite("angles", found.angle)
    finite("equivalent intensities", found.equivalent)
    straight = criterion.kink(np.array([2.5]), np.zeros(1), kappa[:1])
    close("kink of opening alone", straight.angle, 0.0, EXACT)
    close("equivalent intensity of opening alone", straight.equivalent, 2.5, EXACT)
    claim(bool((found.angle <= 0).all()), "positive sliding: a kink that is not clockwise")
    claim(bool((np.abs(found.angle) < WIDEST).all()), "a kink of more than 90 degrees")
    mirrored = criterion.kink(one, -two, kappa)
    close("kink of sliding the other way", mirrored.angle, -found.angle, EXACT)
    close("its equivalent intensity", mirrored.equivalent, found.equivalent, EXACT)
    size = np.geomspace(1e-6, 1e9, number)
    scaled = criterion.kink(size * one, size * two, kappa)
    close("kink of intensities of another size", scaled.angle, found.angle, EXACT)
    close("their equivalent", scaled.equivalent / size, found.equivalent, EXACT)
    order = rng.permutation(number)
    mixed = criterion.kink(one[order], two[order], kappa[order])
    close("kinks of tips in another order", mixed.angle, found.angle[order], EXACT)
    least = float((found.equivalent - one).min())
    claim(least >= -EXACT, f"sliding lowers the equivalent intensity by {-least:.3g}")
