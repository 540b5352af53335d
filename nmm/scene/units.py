"""Quantities with units, converted to SI at the door.

The units that scenes use most are converted from a table in decimal arithmetic, so that
"300 mm" and 0.3 are the same double and give the same scene hash; every other unit is
converted by pint, which is imported only then (0.3 s and more).
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pint

_UNIT = re.compile(r"(?:[\w\s*/^()%‰°℃·-]|(?<=\d)\.(?=\d))+")
"""What units are written with: pint passes over other marks, and reads "s." as s."""
_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")

# SI unit -> unit -> factor; a test compares every entry with pint.
COMMON: dict[str, dict[str, str]] = {
    "m": {"m": "1", "um": "1e-6", "mm": "1e-3", "cm": "1e-2", "km": "1e3"},
    "s": {"s": "1", "ms": "1e-3", "min": "60", "h": "3600"},
    "rad": {"rad": "1", "deg": "deg", "mrad": "1e-3"},
    "N": {"N": "1", "kN": "1e3", "MN": "1e6"},
    "Pa": {
        **{"Pa": "1", "kPa": "1e3", "MPa": "1e6", "GPa": "1e9"},
        **{"N/m^2": "1", "kN/m^2": "1e3", "MN/m^2": "1e6", "N/mm^2": "1e6", "kN/mm^2": "1e9"},
    },
    "kg/m^3": {"kg/m^3": "1", "g/cm^3": "1e3", "t/m^3": "1e3"},
    "N/m^3": {"N/m^3": "1", "kN/m^3": "1e3", "MN/m^3": "1e6"},
    "Pa/m": {"Pa/m": "1", "kPa/m": "1e3", "MPa/m": "1e6", "GPa/m": "1e9", "MPa/mm": "1e9"},
    "J/m^2": {"J/m^2": "1", "kJ/m^2": "1e3", "N/m": "1", "N/mm": "1e3"},
    "Pa m^0.5": {"Pa m^0.5": "1", "kPa m^0.5": "1e3", "MPa m^0.5": "1e6"},
    "J": {"J": "1", "mJ": "1e-3", "kJ": "1e3"},
    "m/s": {"m/s": "1", "mm/s": "1e-3", "cm/s": "1e-2", "km/h": str(Decimal("1") / Decimal("3.6"))},
    "m/s^2": {"m/s^2": "1", "mm/s^2": "1e-3"},
    "1/s": {"1/s": "1", "Hz": "1"},
    "rad/s": {"rad/s": "1", "deg/s": "deg"},
    "N m": {"N m": "1"},
    "N m^2": {"N m^2": "1", "kN m^2": "1e3", "MN m^2": "1e6"},
    "K": {"K": "1"},
    "K/m": {"K/m": "1", "K/mm": "1e3"},
    "1/K": {"1/K": "1"},
    "1/m": {"1/m": "1"},
    "Pa s": {"Pa s": "1", "mPa s": "1e-3"},
    "W/m^2": {"W/m^2": "1", "kW/m^2": "1e3"},
    "W/m^3": {"W/m^3": "1", "kW/m^3": "1e3"},
    "W/m/K": {"W/m/K": "1"},
    "W/m^2/K": {"W/m^2/K": "1", "kW/m^2/K": "1e3"},
    "J/kg/K": {"J/kg/K": "1", "kJ/kg/K": "1e3"},
    "N/m": {"N/m": "1", "kN/m": "1e3", "MN/m": "1e6", "N/mm": "1e3", "kN/mm": "1e6"},
    "N s/m": {"N s/m": "1", "kN s/m": "1e3", "MN s/m": "1e6"},
    "kg": {"kg": "1", "t": "1e3", "g": "1e-3"},
    "m^2": {"m^2": "1", "mm^2": "1e-6", "cm^2": "1e-4"},
    "1": {},
}
EXAMPLES: dict[str, str] = {
    **{"m": "100 mm", "s": "10 ms", "rad": "37 deg", "N": "10 kN", "Pa": "27.5 GPa"},
    **{"kg/m^3": "2400 kg/m^3", "N/m^3": "25 kN/m^3", "Pa/m": "10 GPa/m", "J/m^2": "100 J/m^2"},
    **{"Pa m^0.5": "1.2 MPa m^0.5"},
    "J": "0.1 J",
    **{"m/s": "3 m/s", "m/s^2": "9.81 m/s^2", "rad/s": "30 deg/s", "1/s": "2 Hz"},
    **{"K": "80 K", "K/m": "10 K/m", "1/K": "1e-5 1/K", "W/m/K": "2.5 W/m/K"},
    **{"1/m": "1e-5 1/m", "Pa s": "1 mPa s"},
    **{"W/m^2": "200 W/m^2", "W/m^3": "500 W/m^3", "W/m^2/K": "10 W/m^2/K"},
    **{"J/kg/K": "900 J/kg/K"},
    **{"N/m": "10 MN/m", "N s/m": "5 kN s/m", "kg": "200 kg", "m^2": "490 mm^2"},
    "N m^2": "3.8 kN m^2",
}


class UnitError(ValueError):
    """A text is no quantity of the wanted dimension; has the two parts of the report."""

    def __init__(self, expected: str, remedy: str) -> None:
        self.expected = expected
        self.remedy = remedy
        super().__init__(f"expected {expected}: {remedy}")


def convert(text: str, unit: str) -> float:
    """Return the value of a quantity written as text, in the SI unit `unit`.

    Parameters
    ----------
    text
        Number and unit, for example "27.5 GPa".
    unit
        A key of `COMMON`, or "any" for the SI value of whatever dimension.

    Raises
    ------
    UnitError
        No number, no unit, an unknown unit or another dimension.
    """
    match = _QUANTITY.fullmatch(text)
    wanted = "a number" if unit in ("any", "1") else f"a number in {unit}"
    if match is None:
        raise UnitError(f"{wanted}, or a text of number and unit", _advice(unit))
    number, name = match.groups()
    if re.match(r",\d", name):
        raise UnitError(wanted, f"decimals follow a point: write {number}.{name[1:]}")
    if not name:
        raise UnitError(f"{wanted}, or a text of number and unit", f"write {number} without quotes")
    factor = COMMON.get(unit, {}).get(name.replace("**", "^"))
    if factor is None:
        return _by_pint(number, name, unit)
    return (
        math.radians(float(number)) if factor == "deg" else float(Decimal(number) * Decimal(factor))
    )


def _by_pint(number: str, name: str, unit: str) -> float:
    import pint

    registry = _registry()
    expected = "a quantity" if unit == "any" else f"a quantity that converts to {unit}"
    unknown = UnitError(expected, f"{name!r} is no unit; {_similar(name, unit)}")
    if _UNIT.fullmatch(name) is None:
        raise unknown
    try:
        quantity = registry.Quantity(float(number), name)
        si = quantity.to_base_units() if unit == "any" else quantity.to(unit)
    except pint.DimensionalityError as error:
        found = str(error.dim1).strip() or "no dimension"
        remedy = f"{name} has the dimension {found}; {_advice(unit)}"
        raise UnitError(expected, remedy) from None
    except Exception:  # pint raises tokenizer, attribute and type errors on malformed units
        raise unknown from None
    if unit not in ("any", "1"):
        _refuse_other_angle(quantity, name, unit, expected)
    return float(si.magnitude)


def _refuse_other_angle(
    quantity: pint.Quantity[float], name: str, unit: str, expected: str
) -> None:
    """Refuse ratios for angles and angular rates for frequencies, of the same dimension to pint.

    A slope of 37 % is not 0.37 rad, and 2 Hz are 4 pi rad/s; a stiffness may be by angle or not.
    """
    one, other = (
        dict(each.to_base_units().unit_items()).get("radian", 0)
        for each in (quantity, _registry().Quantity(1.0, unit))
    )
    if one != other and float(one) >= 0:  # type: ignore[arg-type]
        what = "an angle" if one else "no angle"
        raise UnitError(expected, f"{name} names {what}; {_advice(unit)}")


@cache
def _registry() -> pint.UnitRegistry[float]:
    """Return the units of pint, which take 0.2 s to read."""
    import pint

    return pint.UnitRegistry()


def _similar(name: str, unit: str) -> str:
    lowered = {known.lower(): known for known in COMMON.get(unit, {})}
    close = lowered.get(name.lower())
    return f'did you mean "{close}"?' if close else _advice(unit)


def _advice(unit: str) -> str:
    example = EXAMPLES.get(unit)
    return f'write for example "{example}"' if example else "write a plain number"
