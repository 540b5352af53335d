"""From which points of the interior point's path Newton's method on springs is tried."""

import numpy as np

from nmm.contact.iteration.interior.complementarity import Complementarity, InteriorIterate


class Settling:
    """Tells when hardly a contact changes its state any more from point to point of a path.

    Newton's method on springs from there mostly ends it. Where it does not, the next try waits
    until a quarter as many contacts change, and others than then: from the states that it was tried
    from it only does the same again.

    Parameters
    ----------
    share
        Part (-) of the contacts that may change.
    """

    def __init__(self, share: float) -> None:
        self._share = share
        self._last = self._tried = np.zeros(0, dtype=bool)

    def seen(self, sides: Complementarity, point: InteriorIterate) -> bool:
        """Whether so few have changed since the point before."""
        now = np.concatenate(sides.springs.states(point.increment))
        changed = int((now != self._last).sum()) if len(self._last) else len(now)
        self._last = now
        if changed > self._share * len(now) or np.array_equal(now, self._tried):
            return False
        self._share, self._tried = 0.25 * changed / len(now), now
        return True
