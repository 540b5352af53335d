"""Pieces of scene files that benchmarks share."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from integration.arrays import Floats

G = 9.81
"""Acceleration of gravity in all benchmarks (m/s2)."""

Corner = tuple[float, float]


def rectangle(low: Corner, high: Corner) -> Floats:
    """Corners (4, 2) of a rectangle, counter-clockwise from its lower left."""
    (a, b), (c, d) = low, high
    return np.array([(a, b), (c, b), (c, d), (a, d)])


def turned(points: Floats, angle: float) -> Floats:
    """Return points turned about the origin by an angle in radians."""
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(points @ np.array([[c, s], [-s, c]]))


def block(name: str, material: str, vertices: Sequence[Corner] | Floats) -> str:
    """Table of a block; vertices are written so that they are read back to the last digit."""
    return (
        f'[[blocks]]\nname = "{name}"\nmaterial = "{material}"\n'
        f"vertices = {np.asarray(vertices, dtype=float).tolist()}\n"
    )


def material(
    name: str, modulus: float = 20e9, poisson: float = 0.2, density: float | None = 2600.0
) -> str:
    """Table of an elastic material; stiff rock by default: E / (rho g H) is 8e5 at 1 m."""
    weight = "" if density is None else f"density = {density!r}\n"
    return f"[materials.{name}]\nyoung_modulus = {modulus!r}\npoisson_ratio = {poisson!r}\n{weight}"


def interface(
    name: str,
    friction: float,
    between: tuple[str, str] | None = None,
    more: Mapping[str, float | bool] | None = None,
) -> str:
    """Table of an interface; ``friction`` is its angle in degrees, ``more`` its other keys."""
    pair = "" if between is None else f'between = ["{between[0]}", "{between[1]}"]\n'
    rest = "".join(f"{key} = {str(value).lower()}\n" for key, value in (more or {}).items())
    return f'[interfaces.{name}]\nfriction_angle = "{friction!r} deg"\n{pair}{rest}'


def fixed_block(name: str) -> str:
    """Table of a support that fixes a whole block."""
    return f'[[supports]]\nname = "hold {name}"\nblock = "{name}"\nfix = ["x", "y"]\n'


def fixed_edge(name: str, segment: Sequence[Sequence[float]] | Floats, axes: str = "xy") -> str:
    """Table of a support of a straight edge, along some axes."""
    return f'[[supports]]\nname = "{name}"\nsegment = {_places(segment)}\nfix = {list(axes)}\n'


def fixed_point(name: str, point: Sequence[float] | Floats, axes: str = "xy") -> str:
    """Table of a support of a point, along some axes."""
    return f'[[supports]]\nname = "{name}"\npoint = {_places(point)}\nfix = {list(axes)}\n'


def pulled_edge(
    name: str, segment: Sequence[Sequence[float]] | Floats, traction: Sequence[float] | Floats
) -> str:
    """Table of a traction (Pa) on a straight edge."""
    return (
        f'[[loads]]\nname = "{name}"\nkind = "edge"\nsegment = {_places(segment)}\n'
        f"traction = {_places(traction)}\n"
    )


def _places(points: Sequence[float] | Sequence[Sequence[float]] | Floats) -> list[Any]:
    """Coordinates as a file has them, read back to the last digit."""
    return list(np.asarray(points, dtype=float).tolist())


def monitor(name: str, point: Corner | Floats, block: str) -> str:
    """Table of a monitor."""
    where = [float(value) for value in point]
    return f'[[monitors]]\nname = "{name}"\npoint = {where}\nblock = "{block}"\n'


def pins(places: Mapping[str, Corner], name: str = "pin") -> list[str]:
    """Tables of supports that keep points of blocks from moving sideways."""
    return [
        f'[[supports]]\nname = "{name} {block}"\npoint = {list(point)}\nblock = "{block}"\n'
        'fix = ["x"]\n'
        for block, point in places.items()
    ]


def scene(head: str, tables: Iterable[str]) -> str:
    """Return a whole scene file."""
    return "\n".join([head, *tables])


def box(name: str, low: Corner, size: Corner, material: str = "rock") -> str:
    """Table of an upright rectangular block with its lower left corner at ``low``."""
    return block(name, material, rectangle(low, (low[0] + size[0], low[1] + size[1])))


def floor(friction: float = 30.0) -> list[str]:
    """Tables of a held floor of rock, 4 m wide with its top at y = 0, and of all contacts."""
    return [interface("contact", friction), box("floor", (-2, -1), (4, 1)), fixed_block("floor")]


def weighty(step: float | None = None, duration: float = 0.2, penalty: float = 100.0) -> str:
    """Head of a scene in plane stress with gravity and contact: statics without a ``step`` (s)."""
    time = "" if step is None else f"duration = {duration!r}\n[inertia]\n"
    rule = "" if step is None else f"[formulation.integrator]\nstep = {step!r}\n"
    return (
        f'plane = "stress"\n{time}[gravity]\n[contact]\n'
        f"[formulation.contact]\nnormal_penalty = {penalty!r}\n{rule}"
    )
