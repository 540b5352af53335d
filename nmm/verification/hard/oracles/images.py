"""A scene and its images have one history: every column of it, in its unit, is compared."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.verification.base import Check, Checks, holds
from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.cases.transforms import listed_anew, mirrored, shifted, turned
from nmm.verification.hard.cases.units import Units, factor, in_units, units_of
from nmm.verification.hard.oracles.motion import ran

if TYPE_CHECKING:
    from nmm.stepping.run import Run

UNITS_OF_COLUMNS = {
    r"time|load_factor|bonded|broken|splitting:.*|.*:share": "1",
    r".*_energy|energy:.*|external_work|.*_loss|(damping_)?loss:.*|heat:(taken:.*|stored)": "J",
    r"heat:(lowest|highest)": "K",
    r"reaction:.*|.*:force|water pressures:.*|foundations:.*": "N",
    r"monitor:.*|viscous boundaries:.*|.*:slip|.*growth|.*:length|.*opening|.*:aperture": "m",
    r"penetration|(fracture|cohesive zones):.*:[xy]": "m",
    r"fracture:.*:K_I+": "Pa m^0.5",
    r"fracture:.*:G": "J/m^2",
    r"fracture:energy": "J",
    r"joint flow:pressure|seepage:(lowest|highest)": "Pa",
    r"seepage:(taken:.*|stored)|joint flow:inflow:.*": "m^3",
}
"""Units of the columns whose names match; the others say how the answer was found."""

PLACES = re.compile(r"(fracture|cohesive zones):.*:[xy]")
VECTORS = re.compile(
    r"(monitor|viscous boundaries):.*:u[xy]|(reaction|water pressures|foundations):.*:[xy]"
)

HELD_TO = 1e-8
"""Of the largest number of a unit and family; residuals are held to 1e-8 too."""
STRAIN = 1e-12
"""Strain below which motions, forces and energies are rounding."""
SPRING = 1e4
"""Stiffness of springs that hold supports, over that of the material."""
NEUTRAL = "neutral equilibrium"
"""What a run says of bodies whose place its loads do not determine."""
FAR_TO = 1e-6
"""The same after a shift by 1e4 m, where coordinates are rounded to 2e-12 m."""


@dataclass(frozen=True)
class Image:
    """A scene seen from elsewhere.

    Attributes
    ----------
    scene
        Its tables.
    turn, by
        A place (2,) lies at ``turn @ place + by`` there, a vector is ``turn @ vector``.
    units
        What numbers are multiplied by, by their units.
    """

    scene: Document
    turn: Floats = field(default_factory=lambda: np.eye(2))
    by: Floats = field(default_factory=lambda: np.zeros(2))
    units: Units = field(default_factory=lambda: units_of(1.0, 1.0))


def _shifted(*by: float) -> Callable[[Document], Image]:
    return lambda scene: Image(shifted(scene, (by[0], by[1])), by=np.array(by))


def _turned(angle: float) -> Callable[[Document], Image]:
    c, s = np.cos(angle), np.sin(angle)
    return lambda scene: Image(turned(scene, angle), turn=np.array([[c, -s], [s, c]]))


def _in_units(length: float, force: float) -> Callable[[Document], Image]:
    return lambda scene: Image(in_units(scene, length, force), units=units_of(length, force))


IMAGES: dict[str, Callable[[Document], Image]] = {
    "mm, N, s": _in_units(1e3, 1.0),
    # A power of two changes no digit: what differs knows a length or a force of its own.
    "powers of two": _in_units(2.0**9, 2.0**-7),
    "order": lambda scene: Image(listed_anew(scene, 3)),
    "shift": _shifted(1e4, 0.0),
    "shift up": _shifted(-0.7e4, 1.3e4),
    "mirror": lambda scene: Image(mirrored(scene), turn=np.diag([-1.0, 1.0])),
    "turn by 37 deg": _turned(np.deg2rad(37.0)),
    "turn by 90 deg": _turned(np.pi / 2),
    "turn by 180 deg": _turned(np.pi),
}
"""How scenes are seen."""


def seen_alike(scene: Document, ways: tuple[str, ...], allowed: Mapping[str, float]) -> Checks:
    """Run a scene and the images that are named, and compare their histories.

    What is not ``allowed`` to differ by more is held to `HELD_TO`, coordinates of 1e4 sizes to
    what rounding leaves of them.
    """
    first = ran(scene).run
    checks: Checks = {"ran": holds(bool(first.summary.steps), first.summary.sentence)}
    for way in ways if first.summary.steps else ():
        image = IMAGES[way](scene)
        to = FAR_TO if np.any(image.by) else HELD_TO
        checks[way] = compared(first, ran(image.scene).run, image, allowed.get(way, to))
    return checks


def compared(first: "Run", other: "Run", image: Image, to: float = HELD_TO) -> Check:
    """Compare the history of a run with that of an image.

    Of bodies that are told to be in neutral equilibrium no place is compared; of paths at rest
    that were cut into other increments only their ends are.
    """
    one, there = first.history, other.history
    words = f"{first.summary.sentence}; its image: {other.summary.sentence}"
    if first.summary.status != other.summary.status or set(one) != set(there):
        return holds(False, words)
    rows, timed = slice(None), {"inertia", "duration"} & set(image.scene)
    if len(one["time"]) != len(there["time"]):
        if timed:
            return holds(False, f"{len(one['time'])} steps, its image {len(there['time'])}")
        rows = slice(-1, None)
    units = {_unit(name) for name in one} - {None, "m" if NEUTRAL in words else None}
    known = [name for name in one if _unit(name)]
    wanted = {name: _there(name, first, image) for name in known}
    sizes, least = _sizes(wanted), _least(other, image, to)
    worst, where = 0.0, "none"
    for name in (name for name in known if _unit(name) in units):
        column = wanted[name]
        size = max(sizes[_family(name)], least.get(_unit(name) or "", 0.0)) or 1.0
        off = np.nanmax(np.abs(there[name][rows] - column[rows]), initial=0.0) / size
        worst, where = (float(off), name) if off > worst else (worst, where)
    return Check(worst, 0.0, to, f"rounding; the worst column is {where}", 1.0)


def _least(run: "Run", image: Image, to: float) -> dict[str, float]:
    """Return what rounding makes of nothing, by unit: strains of `STRAIN` over the whole scene.

    Places are no nearer than their own rounding, whatever share ``to`` of them is asked for.

    Of far places it makes the rounding of their coordinates over its size, and springs of supports
    store it.
    """
    tables = image.scene["materials"].values()
    modulus = max(float(table["young_modulus"]) for table in tables)
    size, thick = run.stepper.size, float(image.scene.get("thickness", 1.0))
    strain = max(STRAIN, 4 * np.finfo(float).eps * float(np.abs(image.by).max()) / size)
    force = modulus * strain * size * thick
    stored = SPRING * force * strain * size if strain > STRAIN else force * strain * size
    place = max(strain, 4 * np.finfo(float).eps / to) * size
    return {"m": place, "N": force, "J": stored}


def _sizes(columns: Mapping[str, Floats]) -> dict[tuple[str, str], float]:
    """Return the largest number of each family; forces are as large as energies over ways."""
    sizes: dict[tuple[str, str], float] = {}
    for name, column in columns.items():
        largest = float(np.nanmax(np.abs(column), initial=0.0))
        sizes[_family(name)] = max(sizes.get(_family(name), 0.0), largest)
    way = sizes.get(("m", ""), 0.0)
    least = sizes.get(("J", ""), 0.0) / way if way else 0.0
    return {one: max(size, least) if one[0] == "N" else size for one, size in sizes.items()}


def _unit(column: str) -> str | None:
    found = (unit for names, unit in UNITS_OF_COLUMNS.items() if re.fullmatch(names, column))
    return next(found, None)


def _family(column: str) -> tuple[str, str]:
    """Return the unit of a column, and what it is compared with of that unit."""
    unit = _unit(column) or ""
    if PLACES.fullmatch(column):
        return unit, "place"
    return unit, "" if unit in ("J", "m") else column.split(":")[0]


def _there(name: str, run: "Run", image: Image) -> Floats:
    """Return what a column of a run is in an image."""
    h, times = run.history, factor(_unit(name) or "1", image.units)
    if not (VECTORS.fullmatch(name) or PLACES.fullmatch(name)):
        return np.asarray(times * h[name])
    axis = "xy".index(name[-1])
    vector = np.stack([h[name[:-1] + one] for one in "xy"])
    turned_vector = (image.turn @ vector)[axis]
    return np.asarray(times * turned_vector + (image.by[axis] if PLACES.fullmatch(name) else 0.0))
