"""What every interface law must keep: checked on a law of one's own in one line."""

import numpy as np

from integration.arrays import Bools, Floats
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.history import KEPT, History
from nmm.interfaces.response import Traction
from nmm.testing.claims import claim, close

# Points of a check, each with a path of its own of so many steps.
POINTS, STEPS = 100, 5
# Tractions are differenced over this share of the size of a path; beside the spring, their error is
# some 1e-8 of rounding and the curvature of the law.
NEAR, CLOSE = 1e-6, 1e-5
# Share of the points that may lie on a kink of the law, where no tangent is right.
KINKS = 0.05

Springs = tuple[Floats, Floats]


def check_interface_law(
    law: InterfaceLaw,
    sizes: tuple[float, ...] = (1e-7, 1e-6, 1e-5, 1e-4),
    stiffness: tuple[float, float] | None = None,
    seed: int = 0,
) -> None:
    """Check an interface law along random paths of gap and slip, bonded or not.

    A contact that nothing has happened to carries nothing at rest, limits are not negative,
    tractions keep within them, tangents are the finite differences of the tractions and not all
    zero, points know nothing of each other, nothing given is changed, columns keep their names and
    shapes, and those that grow grow. What is overloaded stays so under more load, and pressure
    alone overloads nothing. Pulling a bond of a given fracture energy apart takes that.

    Parameters
    ----------
    law
        The law.
    sizes
        Gaps and slips to try (m); let some go beyond what the law bears elastically.
    stiffness
        Of normal and shear spring (Pa/m); the law's own by default, or 1e12 where it has none.

    Raises
    ------
    AssertionError
        Saying what is not kept, where and by how much.
    """
    normal, shear = stiffness or (law.normal_stiffness or 1e12, law.shear_stiffness or 1e12)
    springs = np.full(POINTS, normal), np.full(POINTS, shear)
    _overload(law, np.random.default_rng(seed))
    for holds in {law.bonded, False}:
        start = law.initial(np.full(POINTS, holds))
        _at_rest(law, start, springs)
        for size in sizes:
            _path(law, start, springs, size, np.random.default_rng(seed))
    if law.fracture_energy and "damage" in law.columns:
        _energy(law, normal)


def differences(
    law: InterfaceLaw, history: History, there: Floats, springs: Springs, near: float
) -> Floats:
    """Return the derivatives (m, 2, 2) of tractions by gap and slip ``there`` (m, 2), centrally."""
    found = np.empty((len(there), 2, 2))
    for axis, shift in enumerate(near * np.eye(2)):
        moved = [there + sign * shift for sign in (1, -1)]
        ends = [law.update(history, one[:, 0], one[:, 1], springs) for one in moved]
        found[:, :, axis] = (ends[0].traction - ends[1].traction) / (2 * near)
    return found


def _at_rest(law: InterfaceLaw, start: History, springs: Springs) -> None:
    name, none = type(law).__name__, np.zeros(POINTS)
    before = {column: values.copy() for column, values in start.items()}
    found = law.update(start, none, none, springs)
    claim(not found.traction.any(), f"{name}: traction where nothing has happened")
    for column, values in before.items():
        claim(np.array_equal(values, start[column]), f"{name}: update changed {column} it got")
        claim(np.array_equal(values, found.history[column]), f"{name}: {column} changed at rest")
    limits = law.response(start, springs[0]).limits
    for limit in ("tension", "cohesion", "friction"):
        least = float(np.min(getattr(limits, limit)))
        claim(least >= 0, f"{name}: {limit} {least:.3g}: expected none below zero")


def _path(
    law: InterfaceLaw,
    history: History,
    springs: Springs,
    size: float,
    random: np.random.Generator,
) -> None:
    """Move all points at random, step by step, and judge each step."""
    where, there = f"{type(law).__name__}, gaps and slips of {size:g} m", np.zeros((POINTS, 2))
    steepest = 0.0
    for _ in range(STEPS):
        there = there + size * random.normal(size=(POINTS, 2))
        before = {name: column.copy() for name, column in history.items()}
        found = law.update(history, there[:, 0], there[:, 1], springs)
        for name, column in before.items():
            claim(np.array_equal(column, history[name]), f"{where}: update changed {name} it got")
        _columns(law, before, found, where)
        _within(law, found, springs, where)
        _alone(law, history, there, found, springs, where)
        unit = max(float(spring.max()) for spring in springs)
        wrong = differences(law, history, there, springs, NEAR * size) - found.tangent
        off = np.abs(wrong).max(axis=(1, 2)) / unit
        bad = float((off > CLOSE).mean())
        claim(
            bad <= KINKS,
            f"{where}: the tangent is no derivative at {100 * bad:.0f} % of the points, by up to "
            f"{off.max():.1e} of the spring",
        )
        steepest = max(steepest, float(np.abs(found.tangent).max()))
        history = found.history
    claim(steepest > 0, f"{where}: nothing on the path has any stiffness")


def _columns(law: InterfaceLaw, before: History, found: Traction, where: str) -> None:
    claim(
        set(found.history) == set(before),
        f"{where}: columns {sorted(found.history)}, not {sorted(before)} as `columns` says",
    )
    for name, column in {**KEPT, **law.columns}.items():
        after = np.asarray(found.history[name])
        claim(after.shape == (POINTS,), f"{where}: {name} of shape {after.shape}")
        claim(np.isfinite(after).all(), f"{where}: {name} is not finite")
        claim((after <= column.most).all(), f"{where}: {name} above {column.most}")
        fallen = float(np.max(before[name] * 1.0 - after))
        claim(not column.grows or fallen <= 0, f"{where}: {name}, which grows, fell by {fallen:g}")


def _within(law: InterfaceLaw, found: Traction, springs: Springs, where: str) -> None:
    """Tractions are finite, and admissible by what the law remembers afterwards."""
    claim(np.isfinite(found.traction).all(), f"{where}: tractions that are not finite")
    limits = law.response(found.history, springs[0]).limits
    pull, shear = found.traction.T
    largest = limits.cohesion + limits.friction * np.maximum(-pull, 0.0)
    rounding = 1e-9 * max(float(np.abs(found.traction).max()), 1.0)
    for name, over in (("pull", pull - limits.tension), ("shear", np.abs(shear) - largest)):
        most = float(over.max())
        claim(most <= rounding, f"{where}: {name} beyond its limit by {most:.3g} Pa")


def _alone(
    law: InterfaceLaw,
    history: History,
    there: Floats,
    found: Traction,
    springs: Springs,
    where: str,
) -> None:
    """A point answers alike whichever points are asked with it."""
    some: Bools = np.arange(POINTS) % 7 == 0
    own = {name: column[some] for name, column in history.items()}
    points = there[some]
    few = springs[0][some], springs[1][some]
    answer = law.update(own, points[:, 0], points[:, 1], few)
    scale = float(np.abs(found.traction).max()) or 1.0
    off = float(np.abs(answer.traction - found.traction[some]).max()) / scale
    claim(off < 1e-12, f"{where}: points know of each other: tractions differ by {off:.1e}")


def _overload(law: InterfaceLaw, random: np.random.Generator) -> None:
    name, none = type(law).__name__, np.zeros(POINTS)
    pull, shear = np.abs(random.normal(size=(2, POINTS))) * 1e6
    pressed = float(law.overload(-pull, none).max())
    claim(pressed <= 1, f"{name}: pressure alone overloads a bond, {pressed:.3g} times")
    rises = np.stack([law.overload(f * pull, f * shear) for f in (0.5, 1.0, 2.0)])
    fall = float(-np.diff(np.nan_to_num(rises, posinf=1e300), axis=0).min())
    claim(fall <= 0, f"{name}: overload falls by {fall:.3g} as pull and shear grow")
    both = law.overload(pull, shear), law.overload(pull, -shear)
    claim(np.array_equal(*both), f"{name}: overload depends on the sign of shear")


def _energy(law: InterfaceLaw, stiffness: float) -> None:
    """Pull a bond apart and integrate its force by trapezia."""
    assert law.fracture_energy is not None
    reach = 12.0 * law.fracture_energy / law.tensile_strength
    opening = np.linspace(0, reach + law.tensile_strength / stiffness, 20001)
    springs = np.full(len(opening), stiffness), np.full(len(opening), stiffness)
    whole = law.initial(np.ones(len(opening), dtype=bool))
    force = law.update(whole, opening, 0 * opening, springs).traction[:, 0]
    work = float(np.sum((force[1:] + force[:-1]) / 2 * np.diff(opening)))
    what = f"{type(law).__name__}: work of pulling a bond apart over its fracture energy"
    # The spring's own stretch is within one of 20000 parts; trapezia over its kinks leave as much.
    close(what, work / law.fracture_energy, 1.0, 2e-3)
