"""Workspace for factors that is used again: fresh memory costs as much as the numbers put into it.

A factor of a thousand bricks takes 6 MB. The allocator returns as much to the system at once, and
the next factorisation pays for every page of it again.
"""

from collections import deque
from typing import Any

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats

SPARE_NUMBERS = 2**25
"""Most numbers that are kept without a user, 256 MB."""
SPARE: deque[Floats] = deque()


class Workspace:
    """At least ``size`` numbers of any value, used by others once nobody holds it.

    They are of double precision, or ``single``.

    Those who use ``numbers`` must hold it for as long. Threads may take and leave workspaces at
    the same time: a deque is changed in one piece.
    """

    def __init__(self, size: int, single: bool = False) -> None:
        self._room = _taken((size + 1) // 2 if single else size)
        self.numbers: npt.NDArray[Any] = self._room.view(np.float32) if single else self._room

    def __del__(self) -> None:
        SPARE.append(self._room)
        while SPARE and sum(map(len, tuple(SPARE))) > SPARE_NUMBERS:
            SPARE.popleft()


def _taken(size: int) -> Floats:
    for _ in range(len(SPARE)):
        try:
            found = SPARE.popleft()
        except IndexError:  # another thread took the last one
            break
        if size <= len(found) <= 2 * size + 64:
            return found
        SPARE.append(found)
    return np.empty(size)
