"""How much of a stiffness against changes of volume is held by pressures, and which these are."""

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Floats
from nmm.assembly.projected_volumes.patches import pressures
from nmm.assembly.projected_volumes.pressures import Pressures
from nmm.errors import FormulationError

# Volume is resisted in every point up to this many shear moduli, by pressures beyond: a Poisson
# ratio of 1/3 in plane strain. No material in plane stress goes beyond.
DRAINED = 2.0


def excess(elasticity: Floats) -> Floats:
    """Return the stiffness (E,) against changes of volume beyond what points resist (Pa)."""
    lateral, shear = elasticity[:, 0, 1], elasticity[:, 2, 2]
    return np.asarray(np.maximum(lateral - DRAINED * shear, 0.0))


def held_pressures(manifold: Manifold, beyond: Floats, projected: bool) -> Pressures | None:
    """Return the pressures that hold volumes by ``beyond`` (E,), the `excess`; None without any.

    Raises
    ------
    FormulationError
        Projected volumes with weights that are negative somewhere.
    """
    if not beyond.any():
        return None
    found = pressures(manifold, beyond, int(projected))
    if found is None and projected:
        raise FormulationError(
            '[cover] volumetric: "projected": the weights of this cover are negative '
            "somewhere, so that patches have no measure: expected weights >= 0: use type = "
            '"triangles", "quads" or "bspline", or volumetric = "full"'
        )
    return found
