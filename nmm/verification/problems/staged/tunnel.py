"""A round tunnel that is excavated in stressed elastic ground."""

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

RADIUS, EXTENT, CORNERS = 2.0, 8.0, 96
PX, PY = 5e6, 10e6
MODULUS, POISSON = 10e9, 0.25
POINTS = {"crown": (2.0, 90.0), "side": (2.0, 0.0), "haunch": (2.0, 45.0), "above": (4.0, 90.0)}
"""Radius (m) and angle (degrees) of the monitors."""


def kirsch(radius: float, degrees: float) -> Floats:
    """Displacement (2,) along and across the radius by what the excavation releases (m)."""
    shear, share = MODULUS / 2 / (1 + POISSON), RADIUS**2 / radius**2
    turn = 2 * np.radians(degrees)
    size = RADIUS**2 / radius / (4 * shear)
    out = -size * (PX + PY + (PX - PY) * (4 * (1 - POISSON) - share) * np.cos(turn))
    across = size * (PX - PY) * (2 * (1 - 2 * POISSON) + share) * np.sin(turn)
    return np.array([out, across])


def kirsch_field() -> str:
    """Return the same as expressions of x and y along them."""
    shear = MODULUS / 2 / (1 + POISSON)
    size = f"({RADIUS**2 / (4 * shear)!r}/hypot(x,y))"
    share, turn = f"({RADIUS**2!r}/(x*x+y*y))", "(2*atan2(y,x))"
    out = f"(-{size}*({PX + PY!r}+({PX - PY!r})*({4 * (1 - POISSON)!r}-{share})*cos{turn}))"
    across = f"({size}*({PX - PY!r})*({2 * (1 - 2 * POISSON)!r}+{share})*sin{turn})"
    x = f"({out}*x-{across}*y)/hypot(x,y)"
    y = f"({out}*y+{across}*x)/hypot(x,y)"
    return f'["{x}", "{y}"]'


def wall() -> Floats:
    """Corners of a polygon of the circle's area."""
    angle = np.arange(CORNERS) * 2 * np.pi / CORNERS
    radius = RADIUS * np.sqrt(2 * np.pi / CORNERS / np.sin(2 * np.pi / CORNERS))
    return np.asarray(radius * np.stack([np.cos(angle), np.sin(angle)], axis=1))


class Tunnel(SceneCase):
    """The core leaves a square of ground whose rim is led as the ground beyond would lead it."""

    name = "ST1"
    title = "A tunnel excavated in ground under unequal stresses"
    source = "Kirsch 1898: what excavation adds to the stressed ground"
    formulations = ("manifold", "quads")
    cover: ClassVar = {"size": 0.4}

    def scene(self) -> str:
        """Return the ground with its core, in place, and without."""
        e = EXTENT
        rim = text.rectangle((-e, -e), (e, e))
        hole = wall()
        tables = [
            text.material("rock", MODULUS, POISSON, None),
            text.interface("any", 30.0, more={"bonded": True}),
            text.block("ground", "rock", rim) + f"holes = [{hole.tolist()}]\n",
            text.block("core", "rock", hole),
            f'[[initial_stresses]]\nblock = "all"\nstress = [{-PX}, {-PY}, 0]\n',
        ]
        for kind in ("fixed", "led"):
            field = f"field = {kirsch_field()}\n" if kind == "led" else ""
            for number, ends in enumerate(zip(rim, np.roll(rim, -1, axis=0), strict=True)):
                tables.append(
                    text.fixed_edge(f"{kind} {number}", np.array(ends).tolist()) + f"{field}"
                )
            names = [f"{kind} {number}" for number in range(4)]
            change = (
                'name = "in place"\n' if kind == "fixed" else 'name = "dug"\nremove = ["core"]\n'
            )
            tables.append(f"[[stages]]\n{change}supports = {names}\n".replace("'", '"'))
        for name, (radius, degrees) in POINTS.items():
            angle = np.radians(degrees)
            r = radius + 1e-3
            tables.append(text.monitor(name, (r * np.cos(angle), r * np.sin(angle)), "ground"))
        return text.scene('title = "Tunnel"\nplane = "strain"\n', tables)

    def measure(self, run: "Run") -> Checks:
        largest = float(np.abs(kirsch(2.0, 90.0)).max())
        checks = {}
        for name, (radius, degrees) in POINTS.items():
            moved = way(run, name)
            x, y = 1e3 * (moved[-1] - moved[0])
            angle = np.radians(degrees)
            c, s = np.cos(angle), np.sin(angle)
            exact = 1e3 * kirsch(radius, degrees)
            for what, found, wanted in zip(
                ("outwards", "across"), (c * x + s * y, c * y - s * x), exact, strict=True
            ):
                checks[f"{name} {what} (mm)"] = Check(
                    float(found), float(wanted), 2e-3, "96 corners, cells of a fifth", 1e3 * largest
                )
        return checks
