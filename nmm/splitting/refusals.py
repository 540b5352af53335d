"""What blocks cannot split by, told before anything runs."""

import numpy as np

from nmm.effects.base import Setup
from nmm.errors import Fault, FormulationError, SceneError
from nmm.geometry.tessellation.cover_types import block_cover
from nmm.splitting.division import sizes


def refuse(setup: Setup) -> None:
    """Refuse what can never split.

    Raises
    ------
    SceneError
        A smallest block larger than all blocks of the material, or no interface between pieces.
    FormulationError
        Blocks that are divided and glued already.
    """
    scene, place = setup.scene, setup.scene.source.place
    blocks = block_cover(setup.formulation.cover)
    if blocks is not None and blocks.divides:
        raise FormulationError(
            f'[cover] type: "{setup.formulation.cover.type}" with [splitting]: expected blocks '
            'that are whole, or meshes: use type = "block", or remove [splitting]'
        )
    regions = setup.geometry.regions
    names = list(scene.materials)
    for name, table in scene.splitting.items():  # a handful of materials
        own = np.flatnonzero(np.asarray(regions.material) == names.index(name))
        largest = float(sizes(regions.polygons.take(own).to_shapely()).max(initial=0.0))
        if table.smallest_block > largest:
            at, value = place("splitting", name, "smallest_block"), f"{table.smallest_block:g} m"
            expected = f"less than the largest block of the material, {largest:.4g} m"
            raise SceneError(Fault(at, value, expected, "lower it, or remove the table"))
        scene.interface(name, name)
