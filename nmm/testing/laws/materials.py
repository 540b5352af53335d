"""What every material law must keep: checked on a law of one's own in one line."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.materials.base import History, Law, Response
from nmm.testing.claims import claim

# Points of a check, each with a path of its own of so many steps.
POINTS, STEPS = 200, 4
# Differences of stresses are taken over this share of the strain; their error beside the tangent,
# in elastic stiffnesses, is some 1e-7 of rounding and as much of curvature.
NEAR, CLOSE = 1e-6, 1e-4
CELL = 1e-3
"""Size of the cells (m) in which laws are checked that ask for one."""
# Share of the points that may lie on a kink of the law, where no tangent is right.
KINKS = 0.05


def check_law(
    law: Law,
    planes: Sequence[str] = ("stress", "strain"),
    strains: Sequence[float] = (1e-5, 1e-4, 1e-3, 1e-2),
    step: float = 1.0,
    seed: int = 0,
) -> None:
    """Check a material law along random paths.

    Its elastic matrix is symmetric and positive, matter to which nothing has happened has no stress
    and the elastic tangent, tangents are the finite differences of the stress, points know nothing
    of each other, nothing given is changed, variables keep their names and widths, and no step
    gives energy that was not stored: all but the last to rounding.

    Parameters
    ----------
    law
        The law.
    planes
        Planes it is made for.
    strains
        Sizes of the strains to try; let some go beyond what the law bears elastically.
    step
        Length of each step of the paths (s).

    Raises
    ------
    AssertionError
        Saying what is not kept, where and by how much.
    """
    law = _InCells(law) if law.sized else law
    for plane in planes:
        _stiffness(law, plane)
        for size in strains:
            random = np.random.default_rng(seed)
            _path(law, plane, size, step, random)


@dataclass(frozen=True)
class _InCells(Law):
    """A law that asks for the size of cells, in cells of one size."""

    law: Law

    @property
    def modulus(self) -> float:
        return self.law.modulus

    @property
    def symmetric(self) -> bool:
        return self.law.symmetric

    def stiffness(self, plane: str) -> Floats:
        return self.law.stiffness(plane)

    def variables(self, plane: str) -> History:
        return self.law.variables(plane)

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        return self.law.update(strain, self._here(history, strain), plane, step)

    def energy(self, stress: Floats, history: History, plane: str) -> Floats:
        return self.law.energy(stress, self._here(history, stress), plane)

    def _here(self, history: History, points: Floats) -> History:
        return {**history, "cell_size": np.full((len(points), 1), CELL)}


def start_of(law: Law, plane: str, points: int) -> dict[str, Floats]:
    """Return the internal variables (points, h) of matter that nothing has happened to."""
    given = law.variables(plane)
    for name, one in given.items():
        claim(np.ndim(one) == 1, f"variables: {name} of shape {np.shape(one)}, expected (h,)")
    return {name: np.tile(one, (points, 1)) for name, one in given.items()}


def answered(law: Law, strain: Floats, history: History, plane: str, step: float) -> Response:
    """Return what a law answers, be it a plain tuple."""
    return Response(*law.update(strain, history, plane, step))


def differences(
    law: Law, strain: Floats, history: History, plane: str, step: float, near: float
) -> Floats:
    """Return the derivatives (m, 3, 3) of the stress by central differences over ``near``."""
    found = np.empty((len(strain), 3, 3))
    for axis in range(3):
        way = near * np.eye(3)[axis]
        ends = [answered(law, strain + sign * way, history, plane, step).stress for sign in (1, -1)]
        found[:, :, axis] = (ends[0] - ends[1]) / (2 * near)
    return found


def _stiffness(law: Law, plane: str) -> None:
    matrix = np.asarray(law.stiffness(plane), dtype=float)
    claim(
        bool(matrix.shape == (3, 3)),
        f"stiffness in plane {plane}: shape {matrix.shape}, not (3, 3)",
    )
    off = float(np.abs(matrix - matrix.T).max() / np.abs(matrix).max())
    claim(off < 1e-12, f"stiffness in plane {plane}: {off:.1e} off from symmetric")
    least = float(np.linalg.eigvalsh(matrix)[0])
    claim(
        bool(least > 0), f"stiffness in plane {plane}: smallest eigenvalue {least:.3g}, not above 0"
    )
    start = start_of(law, plane, 1)
    rest = answered(law, np.zeros((1, 3)), start, plane, 0.0)
    unit = float(np.abs(matrix).max())
    claim(np.abs(rest.stress).max() < 1e-12 * unit, f"plane {plane}: stress without strain")
    off = float(np.abs(rest.tangent[0] - matrix).max() / unit)
    claim(off < 1e-9, f"plane {plane}: the first tangent is {off:.1e} off from `stiffness`")


def _path(law: Law, plane: str, size: float, step: float, random: np.random.Generator) -> None:
    """Strain all points at random, step by step, and judge each step."""
    where = f"plane {plane}, strains of {size:g}"
    unit = float(np.abs(law.stiffness(plane)).max())
    history: History = start_of(law, plane, POINTS)
    strain = np.zeros((POINTS, 3))
    stress = answered(law, strain, history, plane, 0.0).stress
    stored = law.energy(stress, history, plane)
    for _ in range(STEPS):
        before = {name: value.copy() for name, value in history.items()}
        then = strain + size * random.normal(size=(POINTS, 3))
        found = answered(law, then, history, plane, step)
        for name, value in before.items():
            claim(
                bool(np.array_equal(value, history[name])), f"{where}: update changed {name} it got"
            )
        _shapes(found, before, where)
        _alone(law, then, history, found, (plane, step, where))
        near = NEAR * size
        wrong = differences(law, then, history, plane, step, near) - found.tangent
        off = np.abs(wrong).max(axis=(1, 2)) / unit
        bad = float((off > CLOSE).mean())
        if law.symmetric:
            odd = np.abs(found.tangent - np.swapaxes(found.tangent, 1, 2)).max() / unit
            claim(
                bool(odd < 1e-9),
                f"{where}: tangents are {odd:.1e} off from symmetric: correct them, or say so by "
                "`symmetric`",
            )
        claim(
            bad <= KINKS,
            f"{where}: the tangent is no derivative at {100 * bad:.0f} % of the points, by up to "
            f"{off.max():.1e} of the elastic stiffness",
        )
        energy = law.energy(found.stress, found.history, plane)
        claim(np.isfinite(energy).all(), f"{where}: energy is not finite")
        _loss(law, (strain, stress, stored), then, history, (plane, step, where))
        strain, stress, stored, history = then, found.stress, energy, found.history


def _shapes(found: Response, before: History, where: str) -> None:
    claim(found.stress.shape == (POINTS, 3), f"{where}: stress of shape {found.stress.shape}")
    claim(found.tangent.shape == (POINTS, 3, 3), f"{where}: tangent {found.tangent.shape}")
    claim(
        bool(set(found.history) == set(before)),
        f"{where}: variables {sorted(found.history)}, not {sorted(before)} as `variables` says",
    )
    for name, value in before.items():
        shape = np.shape(found.history[name])
        claim(shape == value.shape, f"{where}: {name} of shape {shape}, not {value.shape}")
    finite = [found.stress, found.tangent, *found.history.values()]
    claim(
        bool(all(np.isfinite(one).all() for one in finite)), f"{where}: numbers that are not finite"
    )


def _alone(
    law: Law, strain: Floats, history: History, found: Response, at: tuple[str, float, str]
) -> None:
    """A point answers alike whichever points are asked with it."""
    plane, step, where = at
    some = np.arange(POINTS)[::-7]
    own = {name: value[some] for name, value in history.items()}
    answer = answered(law, strain[some], own, plane, step)
    scale = float(np.abs(found.stress).max()) or 1.0
    off = float(np.abs(answer.stress - found.stress[some]).max()) / scale
    claim(off < 1e-12, f"{where}: points know of each other: stresses differ by {off:.1e}")


def _loss(
    law: Law,
    start: tuple[Floats, Floats, Floats],
    then: Floats,
    history: History,
    at: tuple[str, float, str],
) -> None:
    """A path in small steps between two strains gives no energy beyond what was stored."""
    plane, step, where = at
    strain, stress, stored = start
    parts, work = 50, np.zeros(POINTS)
    first, way = strain, (then - strain) / parts
    energy = stored
    for _ in range(parts):
        found = answered(law, first + way, history, plane, step / parts)
        work += ((stress + found.stress) / 2 * way).sum(axis=1)
        first, stress, history = first + way, found.stress, found.history
        energy = law.energy(stress, history, plane)
    # Work by trapezia is off by some 1e-4 of the largest energies where the law has a kink.
    scale = float(np.maximum(np.abs(work), energy).max())
    given = float((energy - stored - work).max())
    claim(
        given <= 1e-3 * scale,
        f"{where}: a path gives back {given / scale:.1e} of its energy beyond what was stored: "
        "correct the stress, or `energy`, which returns what is stored at a stress",
    )
