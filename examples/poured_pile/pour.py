"""Scene of loose Voronoi cells that drop into a box and come to rest, of any number of them.

python examples/poured_pile/pour.py 100000 > pile_100000.toml

Cells of 1 m2 in the mean start a thousandth of their size apart, so that all of them meet anew.
"""

import sys
from math import sqrt

import shapely
from shapely.affinity import scale

from integration.polygons import Polygons
from nmm.geometry.tessellation.voronoi import tessellate

GAP = 1e-3
"""Share of its size by which each cell is shrunk."""
DEEPEST = 25.0
"""Depth of the pile (m)."""

HEAD = """# {count} loose blocks drop into a box and come to rest: written by pour.py
title = "Pile of {count} poured"
plane = "strain"
duration = "0.4 s"

[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = "2000 kg/m^3"

[interfaces.rough]
friction_angle = "31 deg"

[[supports]]
name = "floor"
block = "floor"
fix = ["x", "y"]

[[supports]]
name = "left"
block = "left"
fix = ["x", "y"]

[[supports]]
name = "right"
block = "right"
fix = ["x", "y"]

[gravity]
[inertia]
[contact]

# A run that is stopped goes on from the last checkpoint: nmm run --resume RUN. Frames are held in
# memory too: five of them.
[output]
every_time = "0.1 s"
checkpoint = {{ every_steps = 20 }}

[formulation.integrator]
type = "shi"
step = "2 ms"
kinetic_factor = 0.95

# Soft springs: blocks overlap by weight over modulus, half a millimetre under 25 m of rock.
[formulation.contact]
normal_penalty = 1.0
"""
BLOCK = """
[[blocks]]
{name}material = "rock"
vertices = [{corners}]
"""


def scene(count: int) -> str:
    """Return the text of a scene of so many cells."""
    height = min(DEEPEST, sqrt(count))
    width, top = count / height, 1.2 * height
    box = {
        "floor": shapely.box(-1.0, -1.0, width + 1.0, 0.0),
        "left": shapely.box(-1.0, 0.0, 0.0, top),
        "right": shapely.box(width, 0.0, width + 1.0, top),
    }
    region = Polygons.from_shapely([shapely.box(0.0, 0.0, width, height)])
    cells = tessellate(region, count, seed=1).to_shapely()
    loose = [scale(one, 1 - GAP, 1 - GAP, origin=one.centroid) for one in cells]
    held = [_block(one, f'name = "{name}"\n') for name, one in box.items()]
    return HEAD.format(count=count) + "".join([*held, *map(_block, loose)])


def _block(outline: shapely.Polygon, name: str = "") -> str:
    corners = ", ".join(f"[{x:.6f}, {y:.6f}]" for x, y in list(outline.exterior.coords)[:-1])
    return BLOCK.format(name=name, corners=corners)


if __name__ == "__main__":
    print(scene(int(sys.argv[1])), end="")
