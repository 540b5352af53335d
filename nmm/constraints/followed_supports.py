"""Supports on the next model: what stays holds as it did, what goes leaves what it exerted."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.constraints.imposition import Imposition
from nmm.constraints.interface import nearest
from nmm.constraints.laid_springs import exerting_the_same, free_where, spring_rate, stretch_of
from nmm.effects.motion.reactions import Reactions

if TYPE_CHECKING:
    from nmm.effects.change import Change


def followed(
    old: Iterable[tuple[Imposition, Floats]], new: Sequence[Imposition], state: State
) -> list[Imposition]:
    """Return the ``new`` supports as the ``old`` ones, each with its jump (m, 2), held the model.

    Those without an old one of their name hold the material as it is in ``state``.
    """
    known = {tie.interface.name: (tie, jump) for tie, jump in old}
    found = []
    for tie in new:  # supports: a handful
        interface, before = tie.interface, known.get(tie.interface.name)
        anchor = interface.motion(state)
        stretch = np.zeros_like(anchor)
        if before is not None:
            last, jump = before
            positions = interface.first.position, last.interface.first.position
            had = np.broadcast_to(last.interface.anchor, jump.shape)
            stretch, at, beyond, past = (
                nearest(*positions, one) for one in (stretch_of(last), had, jump, spring_rate(last))
            )
            anchor = exerting_the_same(at, beyond, past, spring_rate(tie))
        laid = free_where(tie, stretch == 0)
        found.append(replace(laid, interface=replace(interface, anchor=anchor)))
    return found


def with_those_gone(change: "Change") -> "Change":
    """Return the change to a scene whose supports are those that it takes away."""
    stay = {one.name for one in change.setup.scene.supports}
    gone = tuple(one for one in change.before.scene.supports if one.name not in stay)
    scene = change.setup.scene.model_copy(update={"supports": gone})
    return replace(change, setup=replace(change.setup, scene=scene))


def exerted(
    ties: Sequence[Imposition],
    pulls: Sequence[tuple[Floats, Floats]],
    state: State,
    before: Sequence[Imposition],
) -> list[Reactions]:
    """Return what each support exerts; multipliers are those of the supports ``before``.

    ``pulls`` are forces (m, 2) in N at the points of each, and (n,) what it does besides.
    """
    known, found = {tie.interface.name: tie for tie in before}, []
    for tie, (pull, beside) in zip(ties, pulls, strict=True):
        old, place = known[tie.interface.name], tie.interface.first
        if tie.shared is not None and len(old.interface) == len(tie.interface):
            pull = pull + old.point_forces(state, np.zeros_like(pull))
        found.append(Reactions(place.elements, place.position, tie.interface.held * pull, beside))
    return found
