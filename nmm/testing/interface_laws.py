"""What every interface law is held to."""

import numpy as np

from integration.arrays import Floats
from nmm.interfaces.base import InterfaceLaw
from nmm.testing.claims import claim, close, finite

ROUNDING = 1e-12


def check_interface_law(law: InterfaceLaw, stiffness: float = 1e12, seed: int = 0) -> None:
    """Hold an interface law to what every one promises.

    Limits are not negative, grow with the length of a contact, and do not grow with damage;
    friction is that of an angle below 90 degrees; contacts do not know of one another; what is
    overloaded stays so under more load, and pressure alone overloads nothing. A law that softens
    never heals, its secant falls with damage from one to zero, and what pulling a bond apart takes
    is its fracture energy.

    Parameters
    ----------
    law
        The law.
    stiffness
        Of the bond's spring (Pa/m), for laws that soften.

    Raises
    ------
    AssertionError
        Naming the property that is not kept, by how much, and what was tolerated.
    """
    name, random = type(law).__name__, np.random.default_rng(seed)
    length, damage = random.uniform(0.1, 2.0, 50), np.sort(random.uniform(0, 1, 50))
    damage[[0, -1]] = 0.0, 1.0
    _limits(law, name, length, damage)
    _overload(law, name, length, random)
    if law.softens:
        _softening(law, name, damage, stiffness)


def _limits(law: InterfaceLaw, name: str, length: Floats, damage: Floats) -> None:
    found = law.limits(length, damage, 1.0)
    double = law.limits(2 * length, damage, 1.0)
    thick = law.limits(length, damage, 2.0)
    one = law.limits(length[7:8], damage[7:8], 1.0)
    even = law.limits(np.ones(50), damage, 1.0)
    for key in ("tension", "cohesion", "friction"):
        values = getattr(found, key)
        claim(values.shape == length.shape, f"{name}: {key} limit of shape {values.shape}")
        claim(not np.isnan(values).any() and values.min() >= 0, f"{name}: {key} limit below zero")
        ended = np.isfinite(values)
        factor = 1.0 if key == "friction" else 2.0
        for what, other in (("length", double), ("thickness", thick)):
            twice = getattr(other, key)[ended]
            size = ROUNDING * float(values[ended].max(initial=1.0))
            close(f"{name}: {key} limit of twice the {what}", twice, factor * values[ended], size)
        alone = getattr(one, key)[np.isfinite(values[7:8])]
        close(f"{name}: {key} limit of a contact alone", alone, values[7:8][ended[7:8]], 0.0)
        if key != "friction":
            falls = np.diff(np.nan_to_num(getattr(even, key), posinf=1e300))
            grown = float(falls.max())
            claim(grown <= 0, f"{name}: {key} limit grows by {grown:.3g} N with damage")
    finite(f"{name}: friction", law.friction(damage))


def _overload(law: InterfaceLaw, name: str, length: Floats, random: np.random.Generator) -> None:
    pull, shear = np.abs(random.normal(size=(2, len(length)))) * 1e6
    zero = np.zeros(len(length))
    pressed = law.overload(-pull, zero, length, 1.0)
    claim(pressed.max() <= 1, f"{name}: pressure alone overloads a bond, {pressed.max():.3g} times")
    rises = np.stack([law.overload(f * pull, f * shear, length, 1.0) for f in (0.5, 1.0, 2.0)])
    fall = float(-np.diff(np.nan_to_num(rises, posinf=1e300), axis=0).min())
    claim(fall <= 0, f"{name}: overload falls by {fall:.3g} as pull and shear grow")
    both = law.overload(pull, shear, length, 1.0), law.overload(pull, -shear, length, 1.0)
    claim(np.array_equal(*both), f"{name}: overload depends on the sign of shear")


def _softening(law: InterfaceLaw, name: str, damage: Floats, stiffness: float) -> None:
    spring, none = np.full(len(damage), stiffness), np.zeros(len(damage))
    secant = law.secant(damage, spring)
    close(f"{name}: secant of an intact and a broken bond", secant[[0, -1]], [1.0, 0.0], ROUNDING)
    claim(np.diff(secant).max() <= 0, f"{name}: the secant grows with damage")
    for opening, sliding in ((none, none), (none + 1e-6, none), (none, none + 1e-6)):
        after = law.damaged(damage, opening, sliding, spring)
        healed = float((damage - after).max())
        claim(healed <= 0, f"{name}: damage falls by {healed:.3g}")
        claim(after.max() <= 1, f"{name}: damage {after.max():.3g} beyond one")
    _energy(law, name, stiffness)


def _energy(law: InterfaceLaw, name: str, stiffness: float) -> None:
    """Pull a bond apart and integrate its force by trapezia."""
    assert law.fracture_energy is not None
    reach = 4.0 * law.fracture_energy / law.tensile_strength
    opening = np.linspace(0, reach + law.tensile_strength / stiffness, 20001)
    ones = np.ones(len(opening))
    damage = law.damaged(0 * ones, opening, 0 * ones, stiffness * ones)
    peak = law.limits(ones, damage, 1.0).tension
    force = np.minimum(stiffness * opening * law.secant(damage, stiffness * ones), peak)
    work = float(np.sum((force[1:] + force[:-1]) / 2 * np.diff(opening)))
    what = f"{name}: work of pulling a bond apart over its fracture energy"
    # The spring's own stretch is within one of 20000 parts; trapezia over its kinks leave as much.
    close(what, work / law.fracture_energy, 1.0, 2e-3)
