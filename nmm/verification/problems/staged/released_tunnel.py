"""A tunnel whose wall is released in part before it is lined."""

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.problems.staged.columns import ends
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

RADIUS, THICK, EXTENT, CORNERS = 3.0, 0.3, 12.0, 96
PRESSURE, MODULUS, POISSON = 4e6, 1e9, 0.3
LINING, LINING_POISSON = 30e9, 0.2
SHARE = 0.5
BEHIND = 0.01
"""Of the monitor in the ground, from the wall (m)."""


def circle(radius: float) -> Floats:
    """Corners of a polygon of the circle's area."""
    angle = np.arange(CORNERS) * 2 * np.pi / CORNERS
    out = radius * np.sqrt(2 * np.pi / CORNERS / np.sin(2 * np.pi / CORNERS))
    return np.asarray(out * np.stack([np.cos(angle), np.sin(angle)], axis=1))


def shear_modulus() -> float:
    """Return that of the ground (Pa)."""
    return MODULUS / 2 / (1 + POISSON)


def ring_pressure() -> float:
    """Return what presses on the ring in the end (Pa).

    Of what is left at the wall, ``(1 - SHARE) PRESSURE``, ring and ground carry shares by
    their stiffness against a way of the wall, of the ground ``2 G / a``.
    """
    inner = RADIUS - THICK
    plane, ratio = LINING / (1 - LINING_POISSON**2), LINING_POISSON / (1 - LINING_POISSON)
    squares = RADIUS**2 + inner**2, RADIUS**2 - inner**2
    ring = plane / RADIUS / (squares[0] / squares[1] - ratio)
    ground = 2 * shear_modulus() / RADIUS
    return (1 - SHARE) * PRESSURE * ring / (ring + ground)


class ReleasedTunnel(SceneCase):
    """Half of what the core exerted is gone as the ring is put in, free of stress; then the rest.

    Ground beyond the disc is a bed of ``2 G / r``, exact for the same pressure all round.
    """

    name = "ST1c"
    title = "A tunnel lined after half of its release"
    source = "Lame 1852: ring and ground as springs; Panet and Guenot 1982: shares"
    formulations = ("quads",)
    cover: ClassVar = {"size": 0.5}

    def scene(self) -> str:
        """Return the ground with its core, without it, and with the ring in its place."""
        rim, hole = circle(EXTENT), circle(RADIUS)
        bed = 2 * shear_modulus() / EXTENT
        tables = [
            text.material("rock", MODULUS, POISSON, None),
            text.material("concrete", LINING, LINING_POISSON, None),
            text.interface("any", 30.0, more={"bonded": True}),
            text.block("ground", "rock", rim) + f"holes = [{hole.tolist()}]\n",
            text.block("core", "rock", hole),
            text.block("ring", "concrete", hole) + f"holes = [{circle(RADIUS - THICK).tolist()}]\n",
            *(
                f'[[initial_stresses]]\nblock = "{name}"\nstress = [{-PRESSURE}, {-PRESSURE}, 0]\n'
                for name in ("ground", "core")
            ),
        ]
        for n, face in enumerate(zip(rim, np.roll(rim, -1, axis=0), strict=True)):
            at = f'segment = {np.array(face).tolist()}\nblock = "ground"\n'
            tables += [
                f'[[foundations]]\nname = "beyond {n}"\n{at}normal_stiffness = {bed!r}\n'
                f"shear_stiffness = {bed / 100!r}\n",
                f'[[loads]]\nname = "far {n}"\nkind = "pressure"\n{at}pressure = {PRESSURE}\n',
            ]
        tables += [
            '[[stages]]\nname = "in place"\nblocks = ["ground", "core"]\n',
            f'[[stages]]\nname = "dug"\nremove = ["core"]\nrelease = {SHARE}\n',
            '[[stages]]\nname = "lined"\nadd = ["ring"]\nrelease = 1.0\n',
            text.monitor("wall", (RADIUS + BEHIND, 0.0), "ground"),
        ]
        return text.scene('title = "Released tunnel"\nplane = "strain"\n', tables)

    def measure(self, run: "Run") -> Checks:
        _, dug, lined = ends(run, 3)
        out = 1e3 * way(run, "wall")[:, 0]
        behind, free = RADIUS / (RADIUS + BEHIND), PRESSURE / 2 / shear_modulus() * RADIUS
        pressure = ring_pressure()
        final = (1 - pressure / PRESSURE) * free
        elements = run.manifold.elements
        ring = run.manifold.element_region == 2
        x, y = elements.centroids[ring].T
        c, s = x / np.hypot(x, y), y / np.hypot(x, y)
        xx, yy, xy = run.stress[ring].T
        hoop = xx * s**2 + yy * c**2 - 2 * xy * s * c
        mean = float(np.average(hoop, weights=elements.areas[ring]))
        cells = "cells of a sixth of the radius"
        return {
            "wall before the ring (mm)": Check(
                float(out[dug]), -1e3 * SHARE * free * behind, 2e-3, cells
            ),
            "wall in the end (mm)": Check(float(out[lined]), -1e3 * final * behind, 2e-3, cells),
            "mean hoop stress of the ring (MPa)": Check(
                mean / 1e6, -_mean_hoop(pressure) / 1e6, 5e-3, "the ring is half a cell thick"
            ),
        }


def _mean_hoop(pressure: float) -> float:
    """Mean over the ring of Lame's hoop stress under a pressure from outside (Pa)."""
    inner = RADIUS - THICK
    area = (RADIUS**2 - inner**2) / 2
    whole = area + inner**2 * np.log(RADIUS / inner)
    return float(pressure * RADIUS**2 / (RADIUS**2 - inner**2) * whole / area)
