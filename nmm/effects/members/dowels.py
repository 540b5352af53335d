"""The effect: dowel action of bars across joints that slide.

On both sides of a joint the bar is a long beam on an elastic foundation of stiffness ``k`` for each
length. A sliding ``w`` of the joint gives the shear force, and the largest moment at
``pi / (4 l)`` from the joint,

    V = k w / (4 l),    M = e^(-pi/4) sin(pi/4) V / l,    l = (k / (4 E I))^(1/4)

(Winkler 1867; Hetenyi 1946). The force acts between the two bodies at the joint.
"""

from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats, Ints
from integration.plane_vectors import counterclockwise
from nmm.assembly.state import State
from nmm.effects.base import Setup
from nmm.effects.members.chains.chains import Chains
from nmm.effects.members.chains.layout import NONE
from nmm.effects.members.crossings import JointsCrossed
from nmm.effects.members.ends import MemberEnds
from nmm.effects.members.fibres import Fibres
from nmm.effects.members.linked import Linked
from nmm.effects.members.links import Links
from nmm.effects.members.member_set import Members
from nmm.materials.uniaxial import Uniaxial
from nmm.scene.tables.members import DOWEL

if TYPE_CHECKING:
    from nmm.scene.tables.bars import BarTable

# Places of memory of a bar: at most one joint in each of so many parts of it.
PLACES = 200


class Dowels(Linked):
    """The bars of a scene that have a ``[bars.dowel]``, at the joints that they cross.

    A dowel is a link of length ``1 / l`` across the bar, so long that an opening of the joint turns
    it by little.
    """

    name = "dowels"

    def __init__(self, setup: Setup, members: Members, decay: Floats) -> None:
        super().__init__(setup, members)
        self._decay = decay

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[bars]]``."""
        bars = [one for one in setup.scene.bars if one.dowel is not None]
        manifold = setup.model.manifold
        ends = np.array([one.points for one in bars])
        found = [
            JointsCrossed.of(manifold, first, last, one.thickness)
            for one, (first, last) in zip(bars, ends, strict=True)
        ]
        crossed = JointsCrossed.joined(found)
        owner = np.repeat(np.arange(len(bars)), [len(one.share) for one in found])
        decay = np.array([_decay(one) for one in bars])
        laws = [_law(bars[one], decay[one]) for one in owner]
        number = np.array([one.number for one in bars])[owner]
        members = Members(
            tuple(one.name + DOWEL for one in bars),
            (PLACES,) * len(bars),
            _links(setup, crossed, ends[owner], 1 / decay[owner]),
            Chains.without_slip(Fibres.of(laws, np.ones(len(owner)), number)),
            owner,
            _places(owner, crossed.share),
            NONE,
        )
        return cls(setup, members, decay)

    @property
    def about(self) -> str:
        return f"{len(self.members.owner)} joints crossed"

    def history(self, state: State) -> dict[str, float]:
        """Return the largest shear force (N) and bending moment (N m) of each bar."""
        found = super().history(state)
        lever = np.exp(-np.pi / 4) * np.sin(np.pi / 4) / self._decay
        forces = [found[f"{name}:force"] for name in self.members.names]
        names = [name.removesuffix(DOWEL) for name in self.members.names]
        row = {f"{name}:shear": force for name, force in zip(names, forces, strict=True)}
        return row | {
            f"{name}:moment": force * arm
            for name, force, arm in zip(names, forces, lever.tolist(), strict=True)
        }


def _links(setup: Setup, crossed: JointsCrossed, ends: Floats, length: Floats) -> Links:
    """Return links of lengths (m,) across bars with ``ends`` (m, 2, 2), at their crossings."""
    first, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    middle = first + crossed.share[:, None] * along
    across = counterclockwise(along) / np.hypot(*along.T)[:, None]
    half = length[:, None] / 2 * across
    low = MemberEnds.at(setup, middle - half, crossed.before)
    high = MemberEnds.at(setup, middle + half, crossed.after)
    return Links.of(low, high, setup.small)


def _decay(bar: "BarTable") -> float:
    """Return ``l`` of a bar (1/m)."""
    assert bar.dowel is not None
    return float((bar.dowel.bedding_stiffness / (4 * bar.bending_stiffness)) ** 0.25)


def _law(bar: "BarTable", decay: float) -> Uniaxial:
    assert bar.dowel is not None
    stiffness, limit = bar.dowel.bedding_stiffness / (4 * decay), bar.dowel.yield_force
    flowed, yields = ((), ()) if limit is None else ((0.0,), (limit,))
    return Uniaxial(stiffness, flowed, yields)


def _places(owner: Ints, share: Floats) -> Ints:
    """Return the place of memory (m,) of each crossing, by its place on the bar."""
    place = owner * PLACES + np.minimum((share * PLACES).astype(np.int64), PLACES - 1)
    # Of two crossings in one part the later takes the next place; crossings increase along each
    # bar.
    rise = np.arange(len(place))
    return np.asarray(np.maximum.accumulate(place - rise) + rise)
