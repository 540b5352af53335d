"""Faces between porous blocks whose water is not said to press on them."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.places import along_segment
from nmm.effects.base import Setup

if TYPE_CHECKING:
    from nmm.scene.tables.water import WaterPressureTable


def total_contact(setup: Setup) -> str:
    """Warn that friction and bonds between porous blocks act on total stress; empty if not.

    The pressure of pores is a stress within blocks. Contact takes all that presses on a face, which
    is that of the grains (Terzaghi) only where water of the joint is given to press on both sides.
    """
    scene, manifold = setup.scene, setup.model.manifold
    if scene.contact is None or scene.joint_flow is not None:
        return ""
    if manifold.n_bodies < 2 or any(_between(setup, one) for one in scene.water_pressures):
        return ""
    return (
        "blocks with water in their pores meet in [contact] where no water presses on their faces: "
        "friction and bonds there are those of total stress, and carry too much where water stands "
        "in the joint; let it press on both faces by [[water_pressures]] along the joint without "
        "block, or by [joint_flow]"
    )


def _between(setup: Setup, water: "WaterPressureTable") -> bool:
    """Whether a water pressure acts in joints, or wherever it is told to: around blocks, in cracks.

    On both faces of a joint edges run both ways.
    """
    if water.segment is None:
        return True
    line, edges = np.array(water.segment), setup.model.manifold.boundary
    edge = along_segment(setup.model.manifold, line)[0]
    way = (edges.end[edge] - edges.start[edge]) @ (line[1] - line[0])
    return bool((way > 0).any() and (way < 0).any())
