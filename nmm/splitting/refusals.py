"""Errors of the scene by which blocks cannot split, reported before the run."""

import numpy as np

from nmm.effects.base import Setup
from nmm.errors import Fault, FormulationError, SceneError
from nmm.geometry.tessellation.cover_types import piece_glue
from nmm.splitting.division import sizes


def refuse(setup: Setup) -> None:
    """Refuse blocks that can never split.

    Raises
    ------
    SceneError
        A smallest block larger than all blocks of the material, or no interface between pieces.
    FormulationError
        Pieces of blocks that are glued for good.
    """
    scene, place = setup.scene, setup.scene.source.place
    if piece_glue(setup.formulation.cover) is not None:
        raise FormulationError(
            '[cover.options] bond: "elastic" with [splitting]: pieces that are glued for good '
            'cannot split: expected pieces that may part: use bond = "interface"'
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
