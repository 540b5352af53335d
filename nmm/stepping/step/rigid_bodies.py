"""Bodies of a model as the solvers know them."""

from nmm.assembly.model import Model
from nmm.solvers.rigid_apart import Bodies


def rigid_bodies(model: Model) -> Bodies:
    """Return the rigid motions of a model's bodies."""
    manifold = model.manifold
    measure = model.measure if manifold.dependent else None
    return Bodies(model.stiffness, manifold.rigid_modes, model.rigid_projection, measure)
