"""What members tell of a state: largest forces and slips for the history, segments for frames."""

from collections.abc import Sequence

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.state import State
from nmm.effects.members.chains.chains import ChainAnswer
from nmm.effects.members.member_set import Members
from nmm.quantity import MemberSegments

# Relative difference below which forces differ by rounding alone, as at both ends of a bar.
ALIKE = 1e-6


def largest(members: Members, found: ChainAnswer) -> dict[str, float]:
    """Return the largest axial force (N) and the largest slip (m) of each member."""
    row = _largest(members.names, members.owner, found.axial.force, "force")
    if len(found.slip):
        row |= _largest(members.names, members.slip_owner, found.slip, "slip")
    return row


def segments(members: Members, state: State, found: ChainAnswer) -> MemberSegments:
    """Return the links as segments with their forces and mean slips."""
    slip = np.append(found.slip, 0.0)  # -1 is a fixed end
    mean = (slip[members.chains.left] + slip[members.chains.right]) / 2
    place = members.links.place(state)
    return MemberSegments(place, members.owner, members.names, found.axial.force, mean)


def _largest(names: Sequence[str], owner: Ints, values: Floats, what: str) -> dict[str, float]:
    """Return the value (m,) of the largest magnitude of each member by its column.

    Of magnitudes that differ by rounding the first along the member is taken.
    """
    sizes, most = np.abs(values), np.zeros(len(names))
    np.maximum.at(most, owner, sizes)
    large = np.flatnonzero(sizes >= (1 - ALIKE) * most[owner])[::-1]
    largest = np.zeros(len(names))
    largest[owner[large]] = values[large]
    return {f"{name}:{what}": float(one) for name, one in zip(names, largest, strict=True)}
