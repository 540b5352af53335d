"""Quantities with units at the door of scenes."""

import functools
import math
import subprocess
import sys
from typing import Any

import pytest

from nmm.scene.fields import quantity
from nmm.scene.units import COMMON, EXAMPLES, UnitError, convert


@functools.cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


ENTRIES = [(unit, name) for unit, names in COMMON.items() for name in names]


@pytest.mark.parametrize(("unit", "name"), ENTRIES)
def test_the_table_agrees_with_pint(unit: str, name: str) -> None:
    expected = _registry().Quantity(2.5, name).to(unit).magnitude
    # pint multiplies chains of factors in floating point: a few ulp.
    assert convert(f"2.5 {name}", unit) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(("unit", "text"), EXAMPLES.items())
def test_examples_of_the_manual_agree_with_pint(unit: str, text: str) -> None:
    number, name = text.split(maxsplit=1)
    expected = _registry().Quantity(float(number), name).to(unit).magnitude
    assert convert(text, unit) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("27.5 GPa", "Pa", 27.5e9),
        ("300mm", "m", 0.3),
        ("1e-1 km", "m", 100.0),
        ("-4.7 MPa", "Pa", -4.7e6),
        ("37 deg", "rad", math.radians(37)),
        ("25 kN/m^3", "N/m^3", 25e3),
        (".5 s", "s", 0.5),
    ],
)
def test_common_units_give_the_nearest_double(text: str, unit: str, value: float) -> None:
    assert convert(text, unit) == value


def test_a_rare_unit_goes_through_pint() -> None:
    assert convert("1 inch", "m") == pytest.approx(0.0254, rel=1e-15)
    assert convert("2 kN m", "any") == pytest.approx(2000.0, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "unit", "part"),
    [
        ("25 kN/m^3", "kg/m^3", "dimension"),
        ("27.5 Gpa", "Pa", 'did you mean "GPa"'),
        ("27.5", "Pa", "without quotes"),
        ("twenty MPa", "Pa", "27.5 GPa"),
        ("1 parsnip", "m", "no unit"),
        ("1 sec.", "s", "'sec.' is no unit"),
        ("1 inch'", "m", "no unit"),
        ("1 inch; 2", "m", "no unit"),
        ("1 m m", "m", "dimension"),
        ("37 %", "rad", "% names no angle"),
        ("2 Hz", "rad/s", "Hz names no angle"),
        ("10 rpm", "1/s", "rpm names an angle"),
        ("5 deg", "1", "plain number"),
    ],
)
def test_wrong_units_are_refused_with_a_remedy(text: str, unit: str, part: str) -> None:
    if unit == "1":
        assert convert(text, unit) == pytest.approx(math.radians(5))  # an angle is a number
        return
    with pytest.raises(UnitError, match=part):
        convert(text, unit)


def test_reading_common_units_imports_none_of_the_heavy_libraries() -> None:
    code = (
        "import sys, nmm.scene as s; s.Scene; s.build_scene({'plane': 'strain', 'thickness': '1 m',"
        "'materials': {'a': {'young_modulus': '1 GPa', 'poisson_ratio': 0.2}}, 'blocks': ["
        "{'material': 'a', 'vertices': [[0, 0], [1, 0], [0, 1]]}]});"
        "print([m for m in ('numpy', 'scipy', 'shapely', 'matplotlib', 'pint', 'numba')"
        " if m in sys.modules])"
    )
    answer = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert answer.stdout.strip() == "[]"


def test_the_largest_number_is_one_that_is_taken() -> None:
    # 10**30 lies below the nearest double of 1e30.
    assert quantity("Pa").func(1e30) == 1e30  # type: ignore[call-arg]
