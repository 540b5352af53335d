"""What the tables of supports declare: where they hold, whether bodies turn, ground that jumps."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.model import Model
from nmm.constraints.imposition import Method
from nmm.constraints.interface import Interface
from nmm.effects.acting_place import acting_place
from nmm.effects.base import Setup
from nmm.effects.motion.ground import Ground

if TYPE_CHECKING:
    from nmm.scene.actions import SupportTable

# Of the size of a body: points of one coordinate.
SAME_COORDINATE = 1e-6
# Degree of polynomials that points along edges of blocks integrate exactly.
BLOCK_ORDER = 4


def declared(setup: Setup, support: "SupportTable", method: Method) -> Interface:
    """Return where and how the table of a support holds a model."""
    model = setup.model
    order = BLOCK_ORDER if method.size is None else method.order(model)
    place = acting_place(setup, "supports", support, order)
    ground = Ground.of(setup, support, place)
    held = np.array(("x" in support.fix, "y" in support.fix))
    area = place.weight * model.thickness
    return Interface(place, None, area, support.name, held, ground)


def lets_turn(model: Model, interfaces: Sequence[Interface]) -> bool:
    """Whether a body can rotate although points of it are held.

    It may not where points of different y are held along x, or of different x along y.
    """
    size = np.sqrt(model.manifold.body_area)
    reached, held = (np.zeros(len(size), dtype=bool) for _ in range(2))
    for axis in (0, 1):
        along = [one for one in interfaces if one.held[axis] and len(one)]
        if not along:
            continue
        body = np.concatenate([one.first.points.body for one in along])
        other = np.concatenate([one.first.position[:, 1 - axis] for one in along])
        low, high = np.full(len(size), np.inf), np.full(len(size), -np.inf)
        np.minimum.at(low, body, other)
        np.maximum.at(high, body, other)
        reached[body] = True
        held |= high - low > SAME_COORDINATE * size
    return bool((reached & ~held).any())


def sudden_starts(setup: Setup, interfaces: Sequence[Interface]) -> str:
    """Tell jumps of the ground, from where the run begins; empty without any."""
    pairs = zip(setup.scene.supports, interfaces, strict=True)
    driven = [(s, one) for s, one in pairs if s.motion or s.history or s.field is not None]
    if setup.scene.inertia is None or setup.start.time > 0 or not driven:
        return ""
    from nmm.effects.motion.sudden_starts import sudden_start

    told = (sudden_start(setup, table, one.first, one.displacement) for table, one in driven)
    return "; ".join(filter(None, told))
