"""Ties between bodies on the next model: what stays is held as it was, what is new as it lies."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Self

import numpy as np

from covers.concatenate import concatenate
from integration.arrays import Floats, Ints
from nmm.assembly.state import State
from nmm.constraints.imposition import Imposition
from nmm.constraints.interface import nearest
from nmm.constraints.laid_springs import exerting_the_same, free_where, spring_rate, stretch_of

if TYPE_CHECKING:
    from nmm.effects.change import Change


def followed(
    old: Sequence[Imposition],
    new: Sequence[Imposition],
    change: "Change",
    keys: tuple[Ints, Ints],
) -> list[Imposition]:
    """Return the ``new`` ties as the ``old`` ones held; new bodies are tied free of stress.

    Springs that the change makes stiffer or softer exert what they did.

    Parameters
    ----------
    keys
        Numbers of the elements of both models: sides of one number may be the same.
    """
    state, fresh, found = change.state, change.parentage.new_bodies, []
    known = [_Held.of(keys[0], tie, change.former) for tie in old]
    for tie in new:
        interface, own = tie.interface, _Held.of(keys[1], tie, state)
        before = own.nearest(known) if known else own
        arrived = np.any([fresh[side.points.body] for side in interface.sides], 0)[:, None]
        stays = exerting_the_same(before.anchor, before.jump, before.rate, own.rate)
        anchor = np.where(arrived, interface.motion(state), stays)
        laid = free_where(tie, arrived | (before.stretch == 0))
        found.append(replace(laid, interface=replace(interface, anchor=anchor)))
    return found


@dataclass(frozen=True)
class _Held:
    """How points of a tie are held, independent of which side is the first.

    Attributes
    ----------
    keys
        (m, 2) numbers of the sides, the lower first.
    position
        (m, 2) reference place (m).
    anchor, stretch, jump
        (m, 2) of the lower side less the other: stress-free jump, stretch with which springs were
        laid, and jump beyond the stress-free one (m).
    rate
        (m, 1) springs for each length along edges (Pa/m); 0 of what is none of the kind.
    sign
        (m, 1) -1 where the first side of the interface is the other.
    """

    keys: Ints
    position: Floats
    anchor: Floats
    stretch: Floats
    jump: Floats
    rate: Floats
    sign: Floats

    @classmethod
    def of(cls, number: Ints, tie: Imposition, state: State) -> Self:
        """Read how a tie holds in a state; ``number`` (E,) is that of the elements."""
        interface = tie.interface
        keys = np.stack([number[side.elements] for side in interface.sides], axis=1)
        sign = np.where(keys[:, :1] > keys[:, 1:], -1.0, 1.0)
        anchor = np.broadcast_to(interface.anchor, (len(interface), 2))
        return cls(
            np.sort(keys, axis=1),
            interface.first.position,
            sign * anchor,
            sign * stretch_of(tie),
            sign * (interface.motion(state) - anchor),
            spring_rate(tie),
            sign,
        )

    def nearest(self, known: Sequence[Self]) -> Self:
        """Return how the first sides were held at the nearest known points of the same sides.

        Where none is known between them all is zero.
        """
        all_known = concatenate(known, {})
        both = concatenate([all_known, self], {})
        _, pair = np.unique(both.keys, axis=0, return_inverse=True)
        far = 2 * float(np.ptp(both.position, axis=0).sum())
        places = np.column_stack([both.position, far * pair.ravel()])
        count = len(all_known.position)
        old, new = np.split(pair.ravel(), [count])
        there = np.isin(new, old)[:, None]

        def of(values: Floats) -> Floats:
            return np.where(there, nearest(places[count:], places[:count], values), 0.0)

        held = all_known.anchor, all_known.stretch, all_known.jump
        anchor, stretch, jump = (self.sign * of(one) for one in held)
        rate = of(all_known.rate)
        return type(self)(self.keys, self.position, anchor, stretch, jump, rate, self.sign)
