"""Ends of members: material points of bodies, or fixed points of the ground."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np
import shapely

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.applied_forces import AppliedForces
from nmm.assembly.kept import kept_of_place
from nmm.assembly.material_points import MaterialPoints, material_points
from nmm.assembly.places import NEAR
from nmm.assembly.state import Frames, State
from nmm.effects.base import Setup
from nmm.errors import Fault, SceneError
from nmm.scene.tables.members import GROUND

if TYPE_CHECKING:
    from nmm.scene.tables.members import TwoEndedTable

# Distance before an edge, in reaches, at which only the block on that side is within reach.
BEFORE = 10.0


@dataclass(frozen=True)
class MemberEnds:
    """Points on bodies or on the ground.

    Attributes
    ----------
    points
        m material points; those for ends on the ground are not used.
    on_block
        (m,) 1 on a body, 0 on the ground.
    position
        (m, 2) reference places (m).
    element
        (m,) element of each; -1 on the ground.
    """

    points: MaterialPoints
    on_block: Floats
    position: Floats
    element: Ints

    @classmethod
    def at(cls, setup: Setup, position: Floats, elements: Ints) -> Self:
        """Return ends at positions (m, 2) (m) in elements (m,); -1 is the ground."""
        on_block, manifold = elements >= 0, setup.model.manifold
        # Covers need not contain points of the ground: a point of a body takes their place.
        reached = np.where(on_block[:, None], position, manifold.elements.points[0])
        points = material_points(manifold, np.maximum(elements, 0), reached)
        return cls(points, on_block.astype(float), position, elements)

    def __len__(self) -> int:
        return len(self.on_block)

    @kept_of_place
    def way(self, state: State) -> Floats:
        """Return the displacements (m, 2) (m)."""
        return self.on_block[:, None] * self.points.moved(state.frames, state.deformation)

    def pushed(self, force: Floats) -> AppliedForces:
        """Return the forces (m, 2) (N) of the ends on bodies."""
        kept = self.element >= 0
        return AppliedForces.at(self.element[kept], self.position[kept], force[kept])

    def along(self, frames: Frames, directions: Floats) -> Floats:
        """Rows (m, L) of the motion along global directions (m, 2), in the axes of the bodies."""
        return self.on_block[:, None] * self.points.along(frames, directions)

    def arm(self, before: State, after: State) -> Floats:
        """Lever arms (m, 2) at the middle of a step, minus those at its start (m)."""
        body, frames = self.points.body, before.frames
        way = (self.way(before) + self.way(after)) / 2
        centre = (frames.centre[body] + after.frames.centre[body]) / 2
        first = frames.to_global(body, self.points.arm)
        return np.asarray(self.on_block[:, None] * (self.position + way - centre - first))


def ends_of(
    setup: Setup, key: str, members: "Sequence[TwoEndedTable]"
) -> tuple[MemberEnds, MemberEnds]:
    """Return the first and the second ends of the members of ``[[key]]``.

    Raises
    ------
    SceneError
        Ends that lie on no material, a line each.
    """
    faults, found = [], []
    for side in (0, 1):
        position = np.array([one.points[side] for one in members])
        named = [one.blocks and one.blocks[side] for one in members]
        elements = _elements(setup, position, named)
        for member, block, element in zip(members, named, elements, strict=True):  # for faults
            if element < 0 and block != GROUND:
                faults.append(nowhere(setup, key, member.name, member.points[side], block))
        found.append(MemberEnds.at(setup, position, elements))
    if faults:
        raise SceneError(*faults)
    return found[0], found[1]


def nowhere(
    setup: Setup, key: str, name: str, point: tuple[float, float], block: str | None
) -> Fault:
    """Return the fault of a member of ``[[key]]`` with an end at which there is no block."""
    place = setup.scene.source.of_name(key, name)
    x, y = np.array(point) + setup.origin
    there = "no block" if block is None else f'no block "{block}"'
    remedy = 'move it, name "ground" for it, or leave the member out of the stage'
    return Fault(place, f'"{name}": {there} at [{x:g}, {y:g}]', "an end on a block", remedy)


def _elements(setup: Setup, position: Floats, named: Sequence[str | None]) -> Ints:
    """Elements (m,) at positions (m, 2) on the named blocks; -1 on the ground."""
    found = np.full(len(position), -1)
    for name in dict.fromkeys(named):  # blocks that are named
        if name != GROUND:
            at = np.flatnonzero([one == name for one in named])
            found[at] = elements_at(setup, position[at], setup.regions(name))
    return found


def elements_at(setup: Setup, position: Floats, regions: Bools | None = None) -> Ints:
    """Return an element (m,) at each position (m, 2); -1 where there is none.

    ``regions`` (N,) are the input regions to look in; None for all.
    """
    manifold, reach = setup.model.manifold, _reach(setup)
    tree = shapely.STRtree(manifold.elements.to_shapely())
    place, element = tree.query(shapely.points(position), predicate="dwithin", distance=reach)
    if regions is not None:
        kept = regions[manifold.element_region[element]]
        place, element = place[kept], element[kept]
    found = np.full(len(position), np.iinfo(np.int64).max)
    np.minimum.at(found, place, element)
    return np.where(found == np.iinfo(np.int64).max, -1, found)


def elements_along(setup: Setup, position: Floats, way: Floats) -> Ints:
    """Return an element (m,) at each position (m, 2), as `elements_at` does.

    On an edge between blocks it is that of the block that ``way`` (2,) leaves.
    """
    back = BEFORE * _reach(setup) * way / np.hypot(*way)
    before = elements_at(setup, position - back)
    return np.where(before >= 0, before, elements_at(setup, position))


def _reach(setup: Setup) -> float:
    """Return the distance from material within which a point counts as on it (m)."""
    return NEAR * setup.model.manifold.elements.extent
