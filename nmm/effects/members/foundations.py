"""The effect: elastic foundations along edges of blocks (Winkler 1867)."""

from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from integration.contraction import summed
from integration.plane_vectors import counterclockwise
from nmm.assembly.places import Place, on_segment
from nmm.assembly.state import State
from nmm.effects.base import Setup
from nmm.effects.members.ends import MemberEnds, nowhere
from nmm.effects.members.fibres import Fibres
from nmm.effects.members.linked import Linked
from nmm.effects.members.links import Links
from nmm.effects.members.member_set import Members
from nmm.errors import SceneError
from nmm.materials.uniaxial import Uniaxial

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.scene.tables.members import FoundationTable

# Least degree of the quadrature along an edge; and that where the pressure may end on the edge,
# whose end is then found to a twentieth of its length.
LEAST_ORDER, LIFTING_ORDER = 4, 40


class Foundations(Linked):
    """All ``[[foundations]]`` of a scene: springs across and along edges, at quadrature points.

    Their directions are fixed. Where a block lifts off, springs are in tension.
    """

    name = "foundations"

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[foundations]]``."""
        parts = [(one, _place(setup, one)) for one in setup.scene.foundations]
        sides = [side for one, place in parts for side in _sides(one, place, setup)]
        places = tuple(2 * len(place) for _, place in parts)
        position = np.concatenate([place.position for place, *_ in sides])
        elements = np.concatenate([place.elements for place, *_ in sides])
        direction = np.concatenate([axis for _, axis, _, _ in sides])
        links = Links(
            MemberEnds.at(setup, position, np.full(len(position), -1)),
            MemberEnds.at(setup, position, elements),
            direction,
            small=True,
        )
        laws = [law for place, _, law, _ in sides for _ in range(len(place))]
        area = np.concatenate([area for *_, area in sides])
        names = tuple(one.name for one, _ in parts)
        axial = Fibres.of(laws, np.ones(len(area)), area)
        return cls(setup, Members.without_slip(names, places, links, axial))

    def history(self, state: State) -> dict[str, float]:
        """Return the resultant (N) on the block of each, and its part across the edge (tension)."""
        members, row = self.members, dict[str, float]()
        force, along = self._answer(state).axial.force, members.links.lines(state).along
        for (name, side), of in _sides_of(members).items():  # a handful of foundations
            if side == "across":
                row[f"{name}:force"] = float(summed(force[of]))
            x, y = summed(-force[of, None] * along[of]).tolist()
            row[f"{name}:x"] = row.get(f"{name}:x", 0.0) + x
            row[f"{name}:y"] = row.get(f"{name}:y", 0.0) + y
        return row

    def _offset_on(self, members: Members, change: "Change") -> Floats:
        """See `Linked`: that of the nearest point of the edge; nan on new material."""
        from scipy.spatial import cKDTree

        old, new = self.members.links.second, members.links.second
        offset, before = np.full(len(new), np.nan), _sides_of(self.members)
        for side, here in _sides_of(members).items():  # a handful of foundations
            if (there := before.get(side)) is not None:
                _, nearest = cKDTree(old.position[there]).query(new.position[here])
                offset[here] = self._offset[there][nearest]
        known = np.isin(new.element, change.parentage.elements.child)
        return np.where(known, offset, np.nan)


def _sides_of(members: Members) -> dict[tuple[str, str], slice]:
    """Return the numbers of the links of each foundation, across its edge and along it."""
    ends = np.cumsum(members.places)
    return {
        (name, side): slice(end - count // 2 * left, end - count // 2 * (left - 1))
        for name, count, end in zip(members.names, members.places, ends, strict=True)
        for left, side in ((2, "across"), (1, "along"))
    }


def _place(setup: Setup, table: "FoundationTable") -> Place:
    manifold = setup.model.manifold
    least = LEAST_ORDER if table.carries == "both" else LIFTING_ORDER
    order = max(least, 2 * manifold.degree)
    regions = setup.regions(table.block)
    place = on_segment(manifold, np.array(table.segment), regions, order)
    if not len(place):
        raise SceneError(nowhere(setup, "foundations", table.name, table.segment[0], table.block))
    return place


def _sides(
    table: "FoundationTable", place: Place, setup: Setup
) -> list[tuple[Place, Floats, Uniaxial, Floats]]:
    """Place, directions (m, 2), law and area (m,) (m2) across and along the edge."""
    assert place.normal is not None
    across = -place.normal
    along = counterclockwise(across)
    area = place.weight * setup.model.thickness
    normal = Uniaxial(table.normal_stiffness, pulls=table.carries == "both")
    shear = Uniaxial(table.shear_stiffness)
    return [(place, across, normal, area), (place, along, shear, area)]
