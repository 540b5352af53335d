"""Crack tips with cracks or edges so near beside them that cells do not resolve what is left."""

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Ints
from nmm.fracture.surroundings import nearest_points

# Cells between a tip and a crack beside it from which on K is right to a percent: tips of three to
# ten long parallel cracks are 0.3 % off with two, 0.8 with 1.43 and up to 2.1 with one.
BESIDE_CRACK = 1.5
# The same beside an edge: 0.2 % with 0.75 and up to 3.4 with half a cell.
BESIDE_EDGE = 0.6
# Cosine of the angle to straight ahead within which a tip is about to meet what it is near to.
AHEAD = np.cos(np.pi / 4)


def crowding(cut: CutCells, tips: Ints) -> float:
    """Return how much too near to a tip something lies beside it: above 1 where K suffers.

    It is the distance that K asks for over the least there is, of cracks and edges of the body that
    do not lie ahead of one of ``tips`` (k,).
    """
    edges, most = cut.boundary, 0.0
    for tip in tips.tolist():  # a handful of tips
        others = edges.body == cut.element_body[cut.tips.element[tip]]
        others &= edges.crack != cut.tips.crack[tip]
        point, ahead = cut.tips.point[tip], cut.tips.direction[tip]
        way = nearest_points(point, edges.start[others], edges.end[others]) - point
        away = np.hypot(*way.T)
        beside = way @ ahead < AHEAD * away
        asked = np.where(edges.crack[others] < 0, BESIDE_EDGE, BESIDE_CRACK)
        share = asked[beside] * cut.tip_cell_width[tip] / away[beside]
        most = max(most, float(share.max(initial=0.0)))
    return most
