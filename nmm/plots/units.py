"""Units of what is drawn: the prefix that makes numbers easy to read."""

from math import floor, log10

import numpy as np

from integration.arrays import Floats

PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}

UNITS = {
    "time": "s",
    "penetration": "m",
    "kinetic_energy": "J",
    "strain_energy": "J",
    "contact_energy": "J",
    "support_energy": "J",
    "external_work": "J",
    "friction_loss": "J",
    "integration_loss": "J",
    "contact_loss": "J",
}
"""Units of history columns; columns not named here are pure numbers."""

FAMILIES = {"monitor": "m", "reaction": "N", "energy": "J", "damping_loss": "J"}
"""Units of columns such as `monitor:tip:uy`, by what stands before the first colon."""


def unit_of(column: str) -> str:
    """Return the SI unit of a history column, empty for a pure number."""
    family, colon, _ = column.partition(":")
    return FAMILIES.get(family, "") if colon else UNITS.get(column, "")


def words_of(column: str) -> str:
    """Return a history column's name as words: `monitor:tip:uy` becomes "uy of tip"."""
    family, _, rest = column.partition(":")
    if family not in ("monitor", "reaction"):
        return column.replace("_", " ").replace(":", " ")
    name, _, component = rest.rpartition(":")
    return f"{component} of {name}" if family == "monitor" else f"{family} {component} of {name}"


def prefixed(values: Floats, unit: str) -> tuple[float, str]:
    """Return the factor and the prefixed unit that bring the largest value to 1 ... 1000."""
    finite = np.abs(values[np.isfinite(values)])
    largest = float(finite.max(initial=0.0))
    if not unit or largest == 0.0:
        return 1.0, unit
    power = int(np.clip(3 * floor(log10(largest) / 3 + 1e-9), -9, 9))
    if unit == "s" and power > 0:
        power = 0
    return 10.0**-power, PREFIXES[power] + unit


def label(words: str, unit: str) -> str:
    """Return an axis label: words, and the unit in brackets if there is one."""
    return f"{words}  ({unit})" if unit else words
