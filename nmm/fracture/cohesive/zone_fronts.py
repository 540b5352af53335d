"""Fronts of cohesive zones: the ends of cracks, of zones that extend them, and of nuclei.

They follow from the geometry alone: its first polylines are the cracks of the scene, then come the
zones in the order in which they began, each from its start to its front.
"""

from collections.abc import Sequence

import numpy as np

from nmm.fracture.growth.fronts import CrackFronts
from nmm.geometry.geometry import Geometry


def zone_fronts(geometry: Geometry, names: Sequence[str]) -> CrackFronts:
    """Return the fronts of a geometry; ``names`` are those of the cracks of the scene.

    A zone that begins at the end of a crack of the scene takes over its front; one that begins
    elsewhere is a nucleus with two fronts.
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
