"""Domains about crack tips that cells are too coarse for."""

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Floats, Ints

# Radii over the widest cell within a domain from which intensities are right to half a percent.
# With a centre crack on graded covers that grow by 0.15, 0.4, 0.8 and 1.3 they are 2.6, 1.8, 0.9
# and 0.6, and intensities 0.1, 0.3, 1.1 and 2.3 % too small; uniform cells have four.
CELLS_ACROSS = 1.6


def coarse_domains(cut: CutCells, tips: Ints, radii: Floats, origin: Floats) -> str:
    """Return a warning about domains of tips (k,) within so few cells; empty where there are none.

    ``radii`` (k,) are those of the domains (m), ``origin`` (2,) of the cut's coordinates.
    """
    width, said = cut.cell_width[cut.element_cell], []
    for tip, radius in zip(tips.tolist(), radii.tolist(), strict=True):  # a handful of tips
        point = cut.tips.point[tip]
        within = np.hypot(*(cut.elements.centroids - point).T) < radius
        widest = float(width[within].max(initial=0.0))
        x, y = point + origin
        if radius < CELLS_ACROSS * widest:
            said.append(f"[{x:.4g}, {y:.4g}] {radius:.3g} m beside cells of {widest:.3g} m")
    if not said:
        return ""
    return (
        f"domains of intensities hold few cells: about {', '.join(said)}: they are 1 to 20 % off; "
        "take smaller cells, a graded cover with a growth of 0.4 at most, or a larger radius"
    )
