"""What a stage is solved on where events have changed blocks or cracks in those before it."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from nmm.geometry.geometry import Geometry
from nmm.model.build import setup_of

if TYPE_CHECKING:
    from nmm.effects.base import Setup
    from nmm.model.staging.stages import Staged


def begun_with(staged: "Staged", now: Geometry) -> "Setup":
    """Return what effects of a stage are built from, after one that ended with a geometry ``now``.

    Blocks that are there go on in their pieces and with their cracks, which have grown; those that
    arrive are as drawn.
    """
    setup, stage = staged.setup, staged.stage
    drawn = setup.geometry
    if not now.in_pieces and _same_cracks(drawn, now):
        return setup
    asked, here = drawn.regions, now.regions
    regions = here.only(np.isin(here.numbers, asked.numbers))
    arriving = ~np.isin(asked.numbers, here.numbers)
    if arriving.any():
        regions = regions.beside(asked.only(arriving))
    regions = replace(regions, material=setup.region_material[regions.numbers])
    blocks = setup.region_name, setup.region_material
    geometry = replace(now, regions=regions)
    begun = setup_of(stage.scene, stage.formulation, geometry, setup.origin, blocks=blocks)
    return replace(begun, acting=setup.acting)


def present_setup(stages: "Sequence[Staged]", left: Sequence[Geometry | None]) -> "Setup":
    """Return the setup with which the stage begins after those that were ``left``.

    Each of them was left with a geometry, None where no event had changed it.
    """
    setup = stages[0].setup
    for staged, geometry in zip(stages[1:], left, strict=False):  # a handful of stages
        setup = begun_with(staged, setup.geometry if geometry is None else geometry)
    return setup


def _same_cracks(one: Geometry, other: Geometry) -> bool:
    pairs = zip(one.cracks, other.cracks, strict=False)
    same = all(np.array_equal(a, b) for a, b in pairs)
    return len(one.cracks) == len(other.cracks) and same
