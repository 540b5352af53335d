"""The effect: bars (rock bolts, cables, anchors, reinforcement), bonded or anchored at ends."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.effects.base import Setup
from nmm.effects.members.chains.chains import Chains
from nmm.effects.members.ends import MemberEnds, elements_along, elements_at, nowhere
from nmm.effects.members.fibres import Fibres
from nmm.effects.members.linked import Linked
from nmm.effects.members.links import Links
from nmm.effects.members.member_set import Members
from nmm.errors import NmmError, SceneError
from nmm.interfaces.bond_slip import BOND_LAWS, BondLaw
from nmm.materials.uniaxial import Uniaxial
from nmm.scene.tables.members import GROUND

if TYPE_CHECKING:
    from nmm.scene.tables.bars import BarTable

# Plastic strain at which hardening ends, beyond all that occur.
FAR = 1e3


@dataclass(frozen=True)
class BarNodes:
    """A bar as a row of nodes at ``position`` (k, 2) in ``elements`` (k,), -1 for the ground.

    Attributes
    ----------
    place
        (k,) number of each among all nodes that the bar could have: its place of memory.
    share
        (k,) length of bar whose bond acts at each (m); 0 where it cannot slip.
    """

    elements: Ints
    position: Floats
    place: Ints
    share: Floats


class BarMembers(Linked):
    """All ``[[bars]]`` of a scene.

    A bonded bar is divided into pieces, whose midpoints move with the block that they lie in, but
    for a slip along the bar. Between blocks there is no bond. A midpoint on a joint belongs to the
    block on the side of the bar's first point.
    """

    name = "bars"

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[bars]]``."""
        bars = setup.scene.bars
        nodes_of = [bar_nodes(setup, one) for one in bars]
        nodes = np.array([len(one.place) for one in nodes_of])
        first = np.delete(np.arange(nodes.sum()), np.cumsum(nodes) - 1)  # of each link
        position, elements, share = (
            np.concatenate([getattr(one, name) for one in nodes_of])
            for name in ("position", "elements", "share")
        )
        ends = [MemberEnds.at(setup, position[at], elements[at]) for at in (first, first + 1)]
        links = Links.of(ends[0], ends[1], setup.small)
        of_node = np.repeat(np.arange(len(bars)), nodes)
        slips = np.flatnonzero(share > 0)
        number = np.full(len(share), -1)
        number[slips] = np.arange(len(slips))
        chains = Chains(
            _axial(bars, of_node[first], links.length),
            _bond(setup, of_node[slips], share[slips]),
            number[first],
            number[first + 1],
        )
        places = np.array([setup.formulation.bars.pieces + 2] * len(bars))
        begin = np.concatenate([[0], np.cumsum(places)[:-1]])
        place = np.concatenate([one.place for one in nodes_of]) + begin[of_node]
        members = Members(
            tuple(one.name for one in bars),
            tuple(places.tolist()),
            links,
            chains,
            of_node[first],
            place[first],
            place[slips],
        )
        return cls(setup, members)

    @property
    def about(self) -> str:
        chains = self.members.chains
        return f"{len(chains.axial)} links, {len(chains.bond)} points of bond"


def bar_nodes(setup: Setup, bar: "BarTable") -> BarNodes:
    """Return the nodes of a bar: its anchored ends, and the bonded midpoints of its pieces.

    Raises
    ------
    SceneError
        An end is anchored where its block is not, or the bond lies in no block.
    """
    first, last = np.array(bar.points)
    pieces = setup.formulation.bars.pieces
    middle = (np.arange(pieces) + 0.5) / pieces
    share = np.concatenate([[0.0], middle, [1.0]])
    position = first + share[:, None] * (last - first)
    elements, inside = np.full(pieces + 2, -1), np.zeros(pieces + 2, dtype=bool)
    if bar.bond is not None:
        elements[1:-1] = elements_along(setup, position[1:-1], last - first)
        inside = elements >= 0
    blocks = bar.blocks or (None, None)
    for at, end, block in zip((0, -1), bar.anchorage, blocks, strict=True):
        if end == "fixed" and block != GROUND:
            elements[at] = elements_at(setup, position[[at]], setup.regions(block))[0]
            if elements[at] < 0:
                raise SceneError(nowhere(setup, "bars", bar.name, bar.points[at], block))
        inside[at] = end != "free"
    if inside.sum() < 2 or (elements[inside] < 0).all():
        raise SceneError(nowhere(setup, "bars", bar.name, bar.points[0], None))
    place = np.flatnonzero(inside)
    length = float(np.hypot(*(last - first))) / pieces
    bonded = (place > 0) & (place <= pieces)
    return BarNodes(elements[place], position[place], place, np.where(bonded, length, 0.0))


def _axial(bars: "tuple[BarTable, ...]", owner: Ints, length: Floats) -> Fibres:
    """Axial laws of links (m,) of bars, in terms of stress and strain."""
    area = np.array([bar.section * bar.number for bar in bars])
    start = np.array([bar.pretension / bar.section for bar in bars])
    laws = [_steel(bar) for bar in bars]
    return Fibres.of([laws[one] for one in owner], length, area[owner], start[owner])


def _bond(setup: Setup, owner: Ints, share: Floats) -> Fibres:
    """Laws of the bond at points (p,), each of the length ``share`` of its bar (m)."""
    bars = setup.scene.bars
    around = np.array([_perimeter(bar) * bar.number for bar in bars])
    laws = [None if bar.bond is None else _bond_law(setup, bar).uniaxial for bar in bars]
    own = [law for law in (laws[one] for one in owner) if law is not None]
    return Fibres.of(own, np.ones(len(owner)), around[owner] * share)


def _bond_law(setup: Setup, bar: "BarTable") -> BondLaw:
    """Return the bond-slip law of a bar.

    Raises
    ------
    SceneError
        Its name is unknown, or its constants do not fit; with the line of the bar.
    """
    table = bar.bond
    assert table is not None
    names = ("stiffness", "strength", "slips", "residual_strength", "exponent")
    given: dict[str, Any] = {name: getattr(table, name) for name in names}
    known = {name: one for name, one in given.items() if one is not None}
    try:
        law: BondLaw = BOND_LAWS.make(table.law, {}, **known)
    except NmmError as error:
        place = setup.scene.source.of_name("bars", bar.name)
        raise SceneError(*(f"{place}.bond: {fault}" for fault in error.faults)) from None
    return law


def _steel(bar: "BarTable") -> Uniaxial:
    pushes = bar.carries == "both"
    if bar.yield_stress is None:
        return Uniaxial(bar.young_modulus, pushes=pushes)
    hard = bar.yield_stress + FAR * bar.hardening_modulus
    return Uniaxial(bar.young_modulus, (0.0, FAR), (bar.yield_stress, hard), pushes=pushes)


def _perimeter(bar: "BarTable") -> float:
    if bar.perimeter is not None or bar.diameter is None:
        return bar.perimeter or 0.0
    return float(np.pi * bar.diameter)
