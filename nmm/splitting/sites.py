"""Where the strength of blocks is checked: at their centroids, or in each element."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.splitting.centres import at_centres
from nmm.splitting.division import ranks

Where = Literal["centroid", "elements"]


@dataclass(frozen=True)
class Sites:
    """Places at which the strength of the bodies of a material is checked.

    Attributes
    ----------
    weights
        (s, E) of the elements in the stress at each.
    body
        (s,) its body.
    point
        (s, 2) where it lies in the reference (m).
    remote
        (s,) how far that is from the middle of the body (m).
    """

    weights: csr_array
    body: Ints
    point: Floats
    remote: Floats

    @classmethod
    def of(cls, model: Model, where: Where, bodies: Bools) -> "Sites":
        """Return the sites of some bodies (B,)."""
        manifold = model.manifold
        middle, body = manifold.body_centroid, manifold.element_body
        if where == "centroid":
            own = np.flatnonzero(bodies)
            return cls(at_centres(model)[own], own, middle[own], np.zeros(len(own)))
        own = np.flatnonzero(bodies[body])
        one = (np.ones(len(own)), (np.arange(len(own)), own))
        point = manifold.elements.centroids[own]
        remote = np.hypot(*(point - middle[body[own]]).T)
        return cls(csr_array(one, shape=(len(own), len(body))), body[own], point, remote)

    def in_order(self, use: Floats) -> Ints:
        """Return the sites body by body, those first that use most of its strength (s,).

        Of those that use as much it is the one nearest to the middle, so that what is symmetric
        does not hang on the numbers of elements.
        """
        return np.lexsort((self.remote, ranks(use), self.body))
