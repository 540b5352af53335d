"""Stress at the centroids of bodies: the mean of the elements that touch the centroid."""

import numpy as np
import shapely
from scipy.sparse import csr_array

from nmm.assembly.model import Model

# Elements nearer to a centroid than this share of the root of the body's area touch it.
TOUCHES = 1e-9


def at_centres(model: Model) -> csr_array:
    """Return weights (B, E) of elements, by area, of those at each centroid.

    A body of one element has the mean of that; one whose centroid lies outside of it, as that of a
    ring does, the mean of all.
    """
    manifold = model.manifold
    n, body, area = manifold.n_bodies, manifold.element_body, manifold.elements.areas
    alone = np.bincount(body, minlength=n) == 1
    many = np.flatnonzero(~alone)
    number, element = np.zeros((2, 0), dtype=np.int64)
    if len(many):
        near = TOUCHES * np.sqrt(manifold.body_area[many])
        tree = shapely.STRtree(manifold.elements.to_shapely())
        middles = shapely.points(manifold.body_centroid[many])
        number, element = tree.query(middles, predicate="dwithin", distance=near)
        own = body[element] == many[number]
        number, element = many[number[own]], element[own]
    found = np.isin(np.arange(n), number)
    rest = np.flatnonzero(~found[body])
    rows, columns = np.concatenate([number, body[rest]]), np.concatenate([element, rest])
    weights = csr_array((area[columns], (rows, columns)), shape=(n, len(body)))
    total = np.asarray(weights.sum(axis=1)).ravel()
    return csr_array(weights.multiply(1 / total[:, None]))
