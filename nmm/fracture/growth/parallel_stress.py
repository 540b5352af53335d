"""The stress along a crack at its tip, and what it does to a piece of finite length.

A piece of length ``l`` that leaves at an angle ``t`` ends with the shear

    K_II(t) = cos(t / 2) (K_I sin t + K_II (3 cos t - 1)) / 2 - T sqrt(8 l / pi) sin t cos t

to first order (Cotterell and Rice 1980; Amestoy and Leblond 1992 for the term of the parallel
stress T). Where T presses, a deviation is driven back, by the more the longer the piece: an angle
from K_I and K_II alone then overshoots, and the path goes to and fro however short pieces are. The
angle at whose end no shear is left does not.
"""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import MaterialPoints, State, material_points

# Halvings that find an angle to rounding.
HALVINGS = 60


def parallel_stress(model: Model, state: State, tips: Ints, stiff: Floats, behind: float) -> Floats:
    """Return the stress T (k,) along cracks at their tips (Pa): E' times the mean strain of faces.

    On the faces K_I strains nothing along the crack, and K_II both the other way, so that their
    mean is that of T; faces are taken as free.

    Parameters
    ----------
    tips
        (k,) numbers among ``model.cut.tips``.
    stiff
        (k,) E' about each (Pa).
    behind
        Length over which the strain is taken (m); the crack is straight there.
    """
    found = np.zeros(len(tips))
    for number, tip in enumerate(tips):  # a handful of tips
        points = _faces_behind(model, int(tip), behind)
        way = model.cut.tips.direction[tip]
        along = points.rows.apply(state.deformation) @ way
        found[number] = stiff[number] * (along[0] - along[1:].mean()) / behind
    return found


def at_end_of_piece(
    angle: Floats, opening: Floats, sliding: Floats, parallel: Floats, length: float
) -> Floats:
    """Return kinks (n,) of pieces at whose ends no shear is left (rad).

    They lie between straight on and the ``angle`` (n,) that intensities alone ask for; cracks that
    are not open, and those under parallel tension, keep theirs.
    """
    driven = (opening > 0) & (parallel < 0)
    part = np.where(driven, -parallel, 0.0) * np.sqrt(8 * length / np.pi)

    def shear(t: Floats) -> Floats:
        by_kink = np.cos(t / 2) / 2 * (opening * np.sin(t) + sliding * (3 * np.cos(t) - 1))
        return np.asarray(by_kink + part * np.sin(t) * np.cos(t))

    low, high = np.zeros_like(angle), angle.copy()
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        # Straight on the shear is that of the tip.
        before = np.sign(shear(middle)) == np.sign(sliding)
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return np.where(driven, high, angle)


def _faces_behind(model: Model, tip: int, behind: float) -> MaterialPoints:
    """Return the tip and the places on both faces that lie ``behind`` it (m)."""
    tips, edges = model.cut.tips, model.cut.boundary
    end = tips.point[tip]
    place = end - behind * tips.direction[tip]
    face = np.flatnonzero(edges.crack == tips.crack[tip])
    start, way = edges.start[face], edges.end[face] - edges.start[face]
    share = ((place - start) * way).sum(axis=1) / (way**2).sum(axis=1)
    off = np.hypot(*(start + np.clip(share, 0, 1)[:, None] * way - place).T)
    side = way @ tips.direction[tip] > 0
    both = [face[np.flatnonzero(on)[np.argmin(off[on])]] for on in (side, ~side)]
    element = np.array([tips.element[tip], *edges.element[both]])
    return material_points(model.manifold, element, np.array([end, place, place]))
