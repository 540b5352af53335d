"""What a contact point does at the end of a step, as enforcements find it and frames store it."""

from enum import IntEnum


class ContactState(IntEnum):
    """Open, sticking or sliding; joined by an intact bond, or open where a bond has broken."""

    OPEN = 0
    STICK = 1
    SLIDE = 2
    BONDED = 3
    BROKEN = 4


NAMES = tuple(state.name.lower() for state in ContactState)
"""Of the states in the history, in their order."""
