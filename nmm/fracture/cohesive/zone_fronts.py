"""Fronts of cohesive zones: the ends of cracks, of zones that go on from them, and of nuclei.

They follow from the geometry alone: the cracks of the scene come first, then the zones in the order
in which they began, each from where it began to where it has come.
"""

from collections.abc import Sequence

import numpy as np

from nmm.fracture.growth.fronts import CrackFronts
from nmm.geometry.geometry import Geometry


def zone_fronts(geometry: Geometry, names: Sequence[str]) -> CrackFronts:
    """Return the fronts of a geometry whose first cracks are those of the scene, with their names.

    A zone that begins where a crack of the scene ends takes its front over; what begins elsewhere
    is a nucleus with two fronts.
    """
    own = CrackFronts.of(names)
    ends = own.points(geometry.cracks)
    crack, last, nuclei = own.crack.copy(), own.last.copy(), []
    for number in range(len(names), len(geometry.cracks)):  # a handful of zones
        at = np.flatnonzero((ends == geometry.cracks[number][0]).all(axis=1))
        crack[at], last[at] = number, True
        if not len(at):
            nuclei.append(number)
    born = CrackFronts.of([f"nucleus {count}" for count in range(1, len(nuclei) + 1)])
    begun = np.array(nuclei, dtype=np.int64)[born.crack]
    return CrackFronts((*own.name, *born.name), np.append(crack, begun), np.append(last, born.last))
