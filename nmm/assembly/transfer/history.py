"""Internal variables transferred to the material points of the next model."""

from collections.abc import Mapping

import numpy as np

from covers.change.parentage import Parentage
from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.stress_points import StressPoints


def carried_history(
    old: Model,
    new: Model,
    kin: Parentage,
    history: Mapping[str, Floats],
    declared: Mapping[str, Floats],
) -> dict[str, Floats]:
    """Return the history (Q, h) by name: each point has that of the nearest old one of its region.

    Nothing is averaged, so that stress stays on the yield surface that it was on. Points of bodies
    without parents start as ``declared``.
    """
    if new.matter is None:
        return {}
    if old.matter is None:
        return dict(declared)
    nearest = nearest_points(old, old.matter.points, new, new.matter.points)
    body = new.manifold.element_body[new.matter.points.rule.owner]
    known = (nearest >= 0) & ~kin.new_bodies[body]
    found = {}
    for name in dict.fromkeys((*history, *declared)):
        had = history.get(name, np.zeros((len(old.matter.law), 1)))
        fresh = declared.get(name, np.zeros((len(nearest), had.shape[1])))
        width = max(had.shape[1], fresh.shape[1])
        had, fresh = (np.pad(one, ((0, 0), (0, width - one.shape[1]))) for one in (had, fresh))
        found[name] = np.where(known[:, None], had[np.maximum(nearest, 0)], fresh)
    return found


def nearest_points(old: Model, before: StressPoints, new: Model, after: StressPoints) -> Ints:
    """Nearest old material point (Q,) of the same region, -1 without any."""
    from scipy.spatial import KDTree

    size = new.manifold.elements.extent
    places = []
    for model, known in ((old, before), (new, after)):
        rule = known.rule
        # Regions lie further apart than any two points of one.
        region = 10 * size * model.manifold.element_region[rule.owner]
        places.append(np.column_stack([rule.points, region]))
    _, found = KDTree(places[0]).query(places[1], distance_upper_bound=5 * size)
    return np.where(found < len(places[0]), found, -1)
