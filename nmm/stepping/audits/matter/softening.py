"""Matter that softens: cells too large under pressure, and bands that lean against their rows."""

import math

import numpy as np

from integration.arrays import Floats, Ints
from integration.rules import PointRule
from nmm.assembly.matter import Matter
from nmm.assembly.model import Model
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings


def softening(run: EndedRun) -> Findings:
    """Audit sizes of cells under the pressure at the end, and bands that cross cells askew.

    Only a row of cells takes the energy of a band. Leans are told in the mean over all that
    softened, by its flow; elements that are no whole cells are not counted, nor is what softened
    before the last stage.
    """
    model = run.stepper.model
    matter, before, after = model.matter, run.start.history, run.state.history
    if not isinstance(matter, Matter) or not matter.softens:
        return
    names = "plastic_strain", "accumulated_plastic_strain"
    if not all(name in before and before[name].shape == after[name].shape for name in names):
        return
    strain, flow = (after[name] - before[name] for name in names)
    flow = flow * np.array([law.sized for law in matter.laws])[matter.law, None]
    yield _under_pressure(matter.size_share(after) * (flow[:, 0] > 0), matter.points.rule)
    elements, means = matter.points.means(np.hstack([strain[:, :3], flow]))
    share = np.zeros(len(model.cut.element_whole))
    share[elements] = means[:, 3] * model.element_area[elements]
    of_cell = model.cut.element_whole[elements] & (share[elements] > 0)
    if not of_cell.any():
        return
    elements, strains = elements[of_cell], means[of_cell, :3]
    leans = _from_rows(model, elements, _along(model, elements, strains, share))
    mean = float(np.average(leans, weights=share[elements]))
    yield AuditFinding(
        "softening_across_cells",
        mean,
        f"bands that soften cross rows of cells at {math.degrees(mean):.0f} degrees in the mean, "
        "where they are wider than a row: they take up to twice their softening energy",
        "give quads an angle along the band ([cover] angle); smaller cells mend nothing",
    )


def _under_pressure(share: Floats, rule: PointRule) -> AuditFinding:
    """Tell where cells unload faster than they soften; ``share`` (Q,) of the largest of points."""
    at = int(np.argmax(share))
    x, y = rule.points[at]
    return AuditFinding(
        "softening_under_pressure",
        float(share[at]),
        f"friction falls under pressure in a cell at ({x:.6g}, {y:.6g}) that is {share[at]:.3g} "
        "times too large to unload more slowly than it softens: points may fall to their last "
        "strength at once, and bands take more than their softening energy",
        "refine the cover there by as much",
    )


def _along(model: Model, elements: Ints, strain: Floats, share: Floats) -> Floats:
    """Return along which direction (k,) elements flow, by their strains (k, 3: xx, yy, 2 xy).

    A band keeps its length: it follows one of the two lines along which strain is nothing. It is
    the one nearer to where neighbours flow, by the mean ``exp(2 i angle)`` of these.
    """
    mean, half = strain[:, :2].mean(axis=1), (strain[:, 0] - strain[:, 1]) / 2
    radius, axis = np.hypot(half, strain[:, 2] / 2), np.arctan2(strain[:, 2] / 2, half) / 2
    away = np.arctan2(np.sqrt((radius + mean).clip(0)), np.sqrt((radius - mean).clip(0)))
    joins, centre = model.cut.joins, model.manifold.elements.centroids
    x, y = (centre[joins.second] - centre[joins.first]).T
    turned = np.exp(2j * np.arctan2(y, x)) * np.sqrt(share[joins.first] * share[joins.second])
    beside = np.zeros(len(share), dtype=complex)
    np.add.at(beside, joins.first, turned)
    np.add.at(beside, joins.second, turned)
    lines = np.stack([axis + away, axis - away])
    nearer = (beside[elements] * np.exp(-2j * lines)).real.argmax(axis=0)
    return np.asarray(lines[nearer, np.arange(len(elements))])


def _from_rows(model: Model, elements: Ints, along: Floats) -> Floats:
    """Return the angle (k,) of directions (k,) from the nearest edge of their cells."""
    cells = model.manifold.elements.take(elements)
    x, y = (cells.points[cells.next_point] - cells.points).T
    off = np.arctan2(y, x) - along[cells.polygon_of_point]
    return np.minimum.reduceat(np.abs((off + np.pi / 2) % np.pi - np.pi / 2), cells.first_point)
