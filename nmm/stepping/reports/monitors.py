"""Points whose displacement a scene asks for."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.assembly.material_points import MaterialPoints
from nmm.assembly.places import at_point
from nmm.assembly.state import State
from nmm.effects.base import Setup
from nmm.errors import GeometryError


@dataclass(frozen=True)
class Monitor:
    """A point whose displacement is recorded."""

    name: str
    points: MaterialPoints
    start: Floats


def monitors(setup: Setup, all_there: bool = True, zero: State | None = None) -> list[Monitor]:
    """Return the monitors of a scene; of a stage those that are on its blocks.

    They count from the state ``zero``, or from the start.

    Raises
    ------
    GeometryError
        When a monitor lies on no material.
    """
    found, begin = [], zero or setup.start
    for item in setup.scene.monitors:  # a handful
        place = at_point(setup.model.manifold, np.array(item.point), setup.regions(item.block))
        if not len(place) and not all_there:
            continue
        if not len(place):
            raise GeometryError(
                f"monitor {item.name}: {item.point}: expected a point of the material: move it "
                "onto a block"
            )
        first = place.points.take(np.array([0]))
        start = first.place(begin.frames, begin.deformation)[0]
        found.append(Monitor(item.name, first, start))
    return found


def monitored(all_of_them: Iterable[Monitor], state: State) -> dict[str, float]:
    """Return the displacement (m) of monitors by their columns of the history."""
    row = {}
    for one in all_of_them:  # a handful
        way = one.points.place(state.frames, state.deformation)[0] - one.start
        row[f"monitor:{one.name}:ux"], row[f"monitor:{one.name}:uy"] = way
    return row
